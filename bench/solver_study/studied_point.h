// A contact point as the candidates see it: the engine's law in double precision, from impulses of zero.
#pragma once

#include "gem/engine/solver/coupled_visit.h"
#include "gem/engine/step/pair_event.h"

namespace gem::bench {

struct StudiedPoint : PointGeometry<double> {
  double inverse_nn = 0.0, inverse_tt = 0.0;

  StudiedPoint() : PointGeometry<double>{} {}
  StudiedPoint(const PointGeometry<double>& g)  // NOLINT: it is the same point
      : PointGeometry<double>(g), inverse_nn(1.0 / g.nn), inverse_tt(1.0 / g.tt) {}
};

/// How far one visit found the point from its law.
struct StudiedResidual {
  double speed = 0.0;  // largest speed that the point still asks for [m/s]
  double climb = 0.0;  // > 0: the carried-ahead impulse went against the way down
};

/// One visit; the whole point is carried ahead by `ahead` times its change.
template <PointFriction law>
StudiedResidual visit_studied(const StudiedPoint& g, const Motion<double>& a, const Motion<double>& b, double dt,
                              double per_step, double ahead, PointImpulse<double>& at, PointImpulse<double>& carried) {
  PointFrame<double> f{};
  f.normal_x = g.normal_x, f.normal_y = g.normal_y;
  f.lever_a_n = g.lever_a_n, f.lever_a_t = g.lever_a_t, f.lever_b_n = g.lever_b_n, f.lever_b_t = g.lever_b_t;
  f.inverse_nn = g.inverse_nn, f.inverse_tt = g.inverse_tt, f.nt = g.nt, f.friction = g.friction;
  f.excess = -g.target;
  f.most = g.cap;
  f.repair_excess = -g.repair_target;
  const Approach<double> w{b.x - a.x, b.y - a.y, b.shift_x - a.shift_x, b.shift_y - a.shift_y, a.spin, a.turn,
                           b.spin,    b.turn};
  const PointImpulse<double> before = at, from = carried;
  StudiedResidual residual;
  residual.speed = visit_point<law, true>(f, w, StepLength<double>{dt, per_step}, 0.0, at, carried);
  const double change_n = at.normal - before.normal, change_t = at.tangential - before.tangential;
  residual.climb = -((at.normal - from.normal) * change_n * g.nn + (at.tangential - from.tangential) * change_t * g.tt);
  carried = {at.normal + ahead * change_n, at.tangential + ahead * change_t,
             at.repair + ahead * (at.repair - before.repair)};
  return residual;
}

}  // namespace gem::bench
