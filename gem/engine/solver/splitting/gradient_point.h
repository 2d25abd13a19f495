// One contact point during the gradient iterations of an island: its numbers and its visit, for one point or for
// several side by side.
//
// All points are visited at once from the same motions. Each takes a step against its velocity, with the mass of each
// body divided among its points, so no point overshoots (coupled_visit.h). Impulses are then extrapolated along their
// last change. Impulses and motions are additions to a base, and motions come over the BodyScale of their body
// (split_point.h).
#pragma once

#include <cstdint>

#include "gem/engine/solver/splitting/split_point.h"

namespace gem {

template <class Real>
struct GradientPoint {
  Real n_a[3], n_b[3], t_a[3], t_b[3];  // Jacobian times the scales of the bodies
  Real inverse_nn, inverse_tt;          // with divided masses [kg]
  Real nn, tt, nt;                      // and their inverses [1/kg]
  Real friction;
  // of PointFrame: velocities [m/s], bounds [N s]; shift [m] and bound [kg m] of the repair
  Real excess, slip, least, most, slack_left, slack_right, repair_excess, repair_least;
  Real ahead_n, ahead_t, ahead_r;     // extrapolated additions to the base [N s], [kg m]
  Real answer_n, answer_t, answer_r;  // the additions themselves
};

/// Sets the constants of a point, and its bounds at the base. `a`, `b`: motions that the base gives. Zero masses for a
/// fixed body.
template <class Real>
GEM_HD inline void set_gradient_point(GradientPoint<Real>& q, int lane, const PointGeometry<double>& g,
                                      InverseMass of_a, InverseMass of_b, SpareFriction spare,
                                      const PointImpulse<double>& impulse, const Motion<double>& a,
                                      const Motion<double>& b) {
  set_jacobian(q, lane, g, of_a, of_b);
  PointFrame<float> frame;
  set_geometry_values(frame, g);
  set_base_values(frame, g, spare, impulse, a, b);
  set_bounds(q, lane, frame);
  lane_of(q.inverse_nn, lane) = frame.inverse_nn;
  lane_of(q.inverse_tt, lane) = frame.inverse_tt;
  lane_of(q.nn, lane) = static_cast<float>(g.nn);
  lane_of(q.tt, lane) = static_cast<float>(g.tt);
  lane_of(q.nt, lane) = frame.nt;
  lane_of(q.friction, lane) = frame.friction;
  lane_of(q.ahead_n, lane) = lane_of(q.ahead_t, lane) = lane_of(q.ahead_r, lane) = 0.0F;
  lane_of(q.answer_n, lane) = lane_of(q.answer_t, lane) = lane_of(q.answer_r, lane) = 0.0F;
}

/// A visit. `a`, `b`: motions that the extrapolated additions give. Returns the speed that the point asked for [m/s] if
/// `judged`, else 0. The additions are then extrapolated by `momentum_coefficient` times their change.
template <PointFriction law, bool judged, class Real>
GEM_HD GEM_INLINE Real visit_gradient(GradientPoint<Real>& q, const Real* a, const Real* b,
                                      float momentum_coefficient) {
  const Real n = q.excess + along(q.n_a, q.n_b, a, b);
  const Real next_n = smaller(larger(q.ahead_n - q.inverse_nn * n, q.least), q.most);
  const Real step_n = next_n - q.ahead_n;
  Real asked{};
  if constexpr (judged) asked = unless_finite(n, magnitude(step_n) * q.nn);
  q.ahead_n = next_n + momentum_coefficient * (next_n - q.answer_n);
  q.answer_n = next_n;
  if constexpr (law != PointFriction::none) {
    Real next_t = q.slack_left + q.friction * next_n;  // against the motion before the event
    if constexpr (law == PointFriction::coulomb) {
      const Real t = q.slip + along(q.t_a, q.t_b, a, b), wider = q.friction * next_n;
      next_t = q.ahead_t - q.inverse_tt * (t + q.nt * step_n);
      next_t = larger(smaller(next_t, q.slack_left + wider), -(q.slack_right + wider));
      if constexpr (judged) asked = unless_finite(t, asked);
    }
    if constexpr (judged) asked = larger(asked, magnitude(next_t - q.ahead_t) * q.tt);
    q.ahead_t = next_t + momentum_coefficient * (next_t - q.answer_t);
    q.answer_t = next_t;
  }
  return asked;
}

/// The same for the repair [m]. A repair whose step opposes its change is not extrapolated: too much repair would open
/// a gap.
template <bool judged, class Real>
GEM_HD GEM_INLINE Real visit_gradient_repair(GradientPoint<Real>& q, const Real* a, const Real* b,
                                             float momentum_coefficient) {
  const Real zero{};
  const Real r = q.repair_excess + along(q.n_a, q.n_b, a, b);
  const Real next = larger(q.ahead_r - q.inverse_nn * r, q.repair_least);
  const Real step = next - q.ahead_r, change = next - q.answer_r;
  q.ahead_r = next + pick(opposed(step, change), zero, momentum_coefficient * change);
  q.answer_r = next;
  return judged ? unless_finite(r, magnitude(step) * q.nn) : zero;
}

}  // namespace gem
