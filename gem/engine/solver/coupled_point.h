// One contact point of a coupled time step: its constants, and the momentum that its impulses give to both bodies.
//
// The impulses of all points together satisfy
//     u_n >= target,  0 <= P_n <= cap,  (u_n - target) P_n = 0 below the cap      no overlap, fully inelastic, crushing
//     |P_t| <= mu P_n,  P_t against the remaining slip                            Coulomb
// The bounds of P_t are wider by the spare friction of the last time step: see friction_memory.h.
// In addition, and without changing velocities, the bodies get the smallest shifts that remove a share of the overlap.
//
//   u_n, u_t  velocity of B relative to A along the normal and along the normal turned left    [m/s]
//   P_n, P_t  impulse on B; the opposite acts on A                                             [N s]
//   nn tt nt  compliance with the mass of each body divided among its points                   [1/kg]
//   cap       impulse that crushes the whole face                                              [N s]
//
// The iterations are in coupled_visit.h.
#pragma once

#include <cmath>

#include "gem/base/choose.h"
#include "gem/base/macros.h"
namespace gem {

/// Friction in a coupled time step.
enum class PointFriction {
  none,
  coulomb,         ///< against the slip that remains after the events
  fixed_direction  ///< P_t = friction P_n; `friction` carries the sign
};

/// Velocity and repair shift of a body during the iterations.
template <class Real>
struct Motion {
  Real x, y, spin;              // [m/s], [rad/s]
  Real shift_x, shift_y, turn;  // [m], [rad]
};

/// Impulse and repair of a point, on B (the opposite on A).
template <class Real>
struct PointImpulse {
  Real normal, tangential;  // [N s]
  Real repair;              // [kg m]
};

/// What a point carries into the next time step.
struct PointMemory {
  PointImpulse<double> impulse = {};  // the warm start
  double rise = 0.0;                  // of the normal impulse, see friction_memory.h [N s]
};

/// Constants of a point during a time step.
template <class Real>
struct PointGeometry {
  Real normal_x, normal_y;
  Real lever_a_n, lever_a_t, lever_b_n, lever_b_t;  // arm x normal, arm x tangent [m]
  Real nn, tt, nt;
  Real target, friction, cap;
  Real repair_target;  // share of the overlap to remove [m]
};

/// What a point gives to a body: linear momentum, angular momentum about the centroid, and the same for the repair.
template <class Real>
struct Push {
  Real x, y, twist;
  Real shift_x, shift_y, turn;
};

template <class Real>
GEM_HD GEM_INLINE void add(Push<Real>& sum, Real sign, const Push<Real>& push) {
  sum.x += sign * push.x;
  sum.y += sign * push.y;
  sum.twist += sign * push.twist;
  sum.shift_x += sign * push.shift_x;
  sum.shift_y += sign * push.shift_y;
  sum.turn += sign * push.turn;
}

/// The push of impulse `p` on one side; `lever_n` and `lever_t` are the levers of that side [m].
template <class Real>
GEM_HD GEM_INLINE Push<Real> push_of(const PointGeometry<Real>& g, const PointImpulse<Real>& p, Real lever_n,
                                     Real lever_t) {
  return {p.normal * g.normal_x - p.tangential * g.normal_y,
          p.normal * g.normal_y + p.tangential * g.normal_x,
          p.normal * lever_n + p.tangential * lever_t,
          p.repair * g.normal_x,
          p.repair * g.normal_y,
          p.repair * lever_n};
}

/// Sets the compliance of the point. `mass` is the sum of both inverse masses [1/kg], `turn_a` and `turn_b` are the
/// inverse inertias [1/(kg m2)], each times the number of points on the body.
template <class Real>
GEM_HD GEM_INLINE void set_compliance(PointGeometry<Real>& g, Real mass, Real turn_a, Real turn_b) {
  g.nn = mass + turn_a * g.lever_a_n * g.lever_a_n + turn_b * g.lever_b_n * g.lever_b_n;
  g.tt = mass + turn_a * g.lever_a_t * g.lever_a_t + turn_b * g.lever_b_t * g.lever_b_t;
  g.nt = turn_a * g.lever_a_n * g.lever_a_t + turn_b * g.lever_b_n * g.lever_b_t;
}

/// Velocity and shift of a body after a push `sum`.
template <class Real>
GEM_HD GEM_INLINE Motion<Real> moved_by(const Push<Real>& sum, Real velocity_x, Real velocity_y, Real spin,
                                        Real inverse_mass, Real inverse_inertia) {
  return {velocity_x + inverse_mass * sum.x, velocity_y + inverse_mass * sum.y, spin + inverse_inertia * sum.twist,
          inverse_mass * sum.shift_x,        inverse_mass * sum.shift_y,        inverse_inertia * sum.turn};
}

/// Change of a body's kinetic energy when its impulses are scaled by s: s * linear + s^2 / 2 * quadratic.
struct EnergyChange {
  double linear, quadratic;  // [J]
};

GEM_HD inline EnergyChange energy_change(const Motion<double>& after, double velocity_x, double velocity_y, double spin,
                                         double mass, double inertia) {
  const double x = after.x - velocity_x, y = after.y - velocity_y, turned = after.spin - spin;
  return {mass * (x * velocity_x + y * velocity_y) + inertia * turned * spin,
          mass * (x * x + y * y) + inertia * turned * turned};
}

/// Scale factor for all impulses, 0 to 1, that leaves the least kinetic energy. The warm start is scaled by it:
/// impulses that stopped a heavy body in the last time step would otherwise push it back in this one. If the factor is
/// below one half, all impulses together would create energy. That happens if the iterations stop before they converge;
/// the results are then scaled too.
GEM_HD inline double best_share(const EnergyChange& sum) {
  if (!(sum.quadratic > 0.0)) return 1.0;
  return smaller(larger(-sum.linear / sum.quadratic, 0.0), 1.0);
}

/// Results of the iterations are scaled by best_share() if it is smaller than this. fixed_direction may create energy,
/// so there the energy says nothing about iterations that met their residual.
GEM_HD inline double share_limit(PointFriction law, bool residual_met) {
  return law == PointFriction::fixed_direction && residual_met ? 0.0 : 0.5;
}

}  // namespace gem
