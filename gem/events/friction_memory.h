// Friction of a load that takes more than one time step to arrive.
//
// A coupled time step lets an open gap close and no more. So a hit takes two time steps: the first removes the closing
// speed that would carry the bodies past the gap, the second the rest. Where in the first time step the gap closes
// decides how large the two parts are. Coulomb's bound is a law of the whole hit, not of its parts:
//
//     |P_t1 + P_t2| <= mu (P_n1 + P_n2)
//
// So a point remembers for one time step how much of its load was new, and what friction it left unused:
//
//     R = max(P_n - P_n of the time step before, 0)                rise of the load                            [N s]
//     K = P_t R / P_n, within +- mu R                              friction that the rise has used             [N s]
//     left = mu R - K,  right = mu R + K                           spare friction along and against t          [N s]
//     Q = (target - u_n) / (k_nn - k_nt^2 / k_tt)                  most that the rest of the hit may take      [N s]
//     most = max(|k_nt| / k_tt - mu, 0) Q                          most friction beyond mu P_n that it can use [N s]
//     -mu P_n - min(right, most) <= P_t <= mu P_n + min(left, most)    in the next time step
//
//   P_n, P_t  impulse on B along the normal and along t, the normal turned left                    [N s]
//   u_n       normal velocity before the events of the next time step, target: its least after     [m/s]
//   k_..      compliance of the pair (mass_reduction.h)                                            [1/kg]
//   mu        friction coefficient                                                                 [-]
//
// Only a slip that a hit reverses needs spare friction: while a point sticks, P_t grows by k_nt / k_tt of P_n, and
// within mu P_n otherwise. So there is none where |k_nt| <= mu k_tt, for a steady load, or where a point does not
// close. Over any number of time steps no point takes more friction than mu times its normal impulse.
//
// Exact for a hit of one point: if the compliance does not change in the two time steps, they give the impulse of
// impact_one_step() for the whole closing speed, whatever the gap. (P_n of the one-step law grows with the target, so
// the second part never pulls.) The compliance changes by the turn of the bodies in a time step: first order in dt.
// Neglected: a hit that reaches a point through a third body, which closes no gap there; its parts have a bound each.
//
// fixed_direction: friction acts against the slip before the hit. So a point whose load has more than doubled keeps
// the direction of its friction for one time step.
//
// Source: our own. The reference paper resolves a hit in one time step, from an overlap.
#pragma once

#include "gem/base/choose.h"
#include "gem/events/impact.h"
#include "gem/events/mass_reduction.h"

namespace gem {

/// Friction beyond mu P_n that a point may use in a time step, along the tangent and against it [N s].
struct SpareFriction {
  double left = 0.0, right = 0.0;
};

/// Rise of a normal impulse from one time step to the next [N s].
GEM_HD inline double rise_of_load(double before, double now) { return now > before ? now - before : 0.0; }

/// Spare friction from the impulse of the last time step and its rise; `rise` is at most `last.normal`. `closing` is
/// the speed that the point has to lose [m/s].
GEM_HD inline SpareFriction spare_friction(double mu, ContactImpulse last, double rise, const ContactCompliance& k,
                                           double closing) {
  const double coupling = magnitude(k.nt);
  if (!(rise > 0.0 && closing > 0.0 && coupling > mu * k.tt)) return {};
  const double bound = mu * rise;
  const double used = larger(smaller(last.tangential * (rise / last.normal), bound), -bound);
  const double most = (coupling - mu * k.tt) * closing / (k.nn * k.tt - k.nt * k.nt);
  return {smaller(bound - used, most), smaller(bound + used, most)};
}

/// Friction beyond its bounds; 0 within them [N s].
GEM_HD inline double beyond_friction(double mu, ContactImpulse impulse, SpareFriction spare) {
  const double bound = mu * impulse.normal;
  return larger(larger(impulse.tangential - (bound + spare.left), -impulse.tangential - (bound + spare.right)), 0.0);
}

/// The slip that sets the direction of friction under fixed_direction: `slip` before the events [m/s], or after a hit
/// began in the last time step, one of the same sign as the slip before it.
GEM_HD inline double slip_of_hit(double slip, ContactImpulse last, double rise) {
  return 2.0 * rise > last.normal && last.tangential != 0.0 ? -last.tangential : slip;
}

}  // namespace gem
