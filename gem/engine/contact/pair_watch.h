// When a pair of bodies must be looked at. No corner of it can overlap while
//
//     gap - closing t - curve t^2 > stray_a + stray_b
//
//   gap, closing, curve   smallest gap of its corners, largest closing speed, half of a bound on its change in free
//                         motion [m], [m/s], [m/s2]
//   stray                 bound on how far any point of a body is from where it would be if it had stayed free [m]
#pragma once

#include "gem/engine/contact/sub_body.h"

namespace gem {

struct PairWatch {
  double gap = 1e300, closing = -1e300, curve = 0.0;
};

/// Whether no corner of a pair can overlap `t` seconds after the start of the time step.
GEM_HD GEM_INLINE bool is_apart(const PairWatch& w, double t, double stray_a, double stray_b) {
  return w.gap - t * (w.closing + w.curve * t) > stray_a + stray_b;
}

/// Takes a corner into the bound of its pair. `gap` outside the side [m]; `arm_q` from q's centroid to the corner.
GEM_HD inline void watch(PairWatch& w, const SubBody& p, const SubBody& q, Vec2 corner, Vec2 arm_q, Vec2 normal,
                         double gap, double h) {
  const Vec2 u = p.start_velocity + cross(p.start_spin, corner) - q.start_velocity - cross(q.start_spin, arm_q);
  const double far = length(arm_q), rim = length(corner), turn = magnitude(q.start_spin);
  const double kicks = length(p.kick) + length(q.kick) + magnitude(p.kick_spin) * rim + magnitude(q.kick_spin) * far;
  // twice the acceleration at the start: the speeds that it depends on change by less than that within a time step
  const double acceleration =
      2.0 * (p.start_spin * p.start_spin * rim + turn * (turn * far + 2.0 * length(u)) + kicks / h);
  w.gap = smaller(w.gap, gap);
  w.closing = larger(w.closing, kicks - dot(u, normal));
  w.curve = larger(w.curve, 0.5 * acceleration);
}

}  // namespace gem
