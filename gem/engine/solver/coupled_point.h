// One contact point among all events of a time step: what it knows of its bodies and what its impulses give them.
//
// All points of a time step ask for impulses that together satisfy
//     u_n >= target,  0 <= P_n <= cap,  (u_n - target) P_n = 0 below the cap      no overlap, fully inelastic, crushing
//     |P_t| <= mu P_n,  P_t against the slip that is left                          Coulomb
// and, apart from the velocities, for the smallest shifts of the bodies that take back a share of the overlap.
//
//   u_n, u_t  velocity of B against A along the normal and along the normal turned left        [m/s]
//   P_n, P_t  impulse on B, the opposite on A                                                  [N s]
//   nn tt nt  compliance with the mass of each body shared out among its points                [1/kg]
//   cap       impulse that crushes the whole face                                              [N s]
//
// coupled_visit.h has the iterations that find them.
#pragma once

#include <cmath>

#include "gem/base/choose.h"
#include "gem/base/macros.h"
namespace gem {

/// Friction between the events of a coupled time step.
enum class PointFriction {
  none,
  coulomb,         ///< against the slip that is left after the events
  fixed_direction  ///< P_t = friction P_n; the sign stands in `friction`
};

/// Velocity and repair shift of a body while the iterations run.
template <class Real>
struct Motion {
  Real x, y, spin;              // [m/s], [rad/s]
  Real shift_x, shift_y, turn;  // [m], [rad]
};

/// Impulse on B (the opposite on A), and the same for the repair.
template <class Real>
struct PointImpulse {
  Real normal, tangential;  // [N s]
  Real repair;              // [kg m]
};

/// Constant during a time step.
template <class Real>
struct PointGeometry {
  Real normal_x, normal_y;
  Real lever_a_n, lever_a_t, lever_b_n, lever_b_t;  // arm x normal, arm x tangent [m]
  Real nn, tt, nt;
  Real target, friction, cap;
  Real repair_target;  // share of the overlap to take back [m]
};

/// Linear momentum, angular momentum about the centroid, and the same of the repair, as given to B.
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

/// What `p` gives to one side.
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

/// Enters how the point answers to its own impulses. `mass` is the sum of both bodies' inverse masses, `turn_a` and
/// `turn_b` are their inverse inertias, each times the number of the body's points.
template <class Real>
GEM_HD GEM_INLINE void enter_compliance(PointGeometry<Real>& g, Real mass, Real turn_a, Real turn_b) {
  g.nn = mass + turn_a * g.lever_a_n * g.lever_a_n + turn_b * g.lever_b_n * g.lever_b_n;
  g.tt = mass + turn_a * g.lever_a_t * g.lever_a_t + turn_b * g.lever_b_t * g.lever_b_t;
  g.nt = turn_a * g.lever_a_n * g.lever_a_t + turn_b * g.lever_b_n * g.lever_b_t;
}

/// Velocity and shift of a body of given inverse mass and inertia after the pushes on it.
template <class Real>
GEM_HD GEM_INLINE Motion<Real> moved_by(const Push<Real>& sum, Real velocity_x, Real velocity_y, Real spin,
                                        Real inverse_mass, Real inverse_inertia) {
  return {velocity_x + inverse_mass * sum.x, velocity_y + inverse_mass * sum.y, spin + inverse_inertia * sum.twist,
          inverse_mass * sum.shift_x,        inverse_mass * sum.shift_y,        inverse_inertia * sum.turn};
}

/// What the impulses on one body do: their work at its velocity before them, and twice the energy of the change.
struct ImpulseWork {
  double given, answered;  // [J]
};

GEM_HD inline ImpulseWork work_on_body(const Motion<double>& after, double velocity_x, double velocity_y, double spin,
                                       double mass, double inertia) {
  const double x = after.x - velocity_x, y = after.y - velocity_y, turned = after.spin - spin;
  return {mass * (x * velocity_x + y * velocity_y) + inertia * turned * spin,
          mass * (x * x + y * y) + inertia * turned * turned};
}

/// The share of a time step's impulses that leaves the least energy, at most all of them. The impulses of the last time
/// step are taken over by this share, since a heavy body that they stopped must not be thrown back by them. Below a
/// half, all of them would create energy: where the iterations stop short of an answer, this share is what they give.
GEM_HD inline double best_share(const ImpulseWork& sum) {
  if (!(sum.answered > 0.0)) return 1.0;
  return smaller(larger(-sum.given / sum.answered, 0.0), 1.0);
}

}  // namespace gem
