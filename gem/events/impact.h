// Fully inelastic impact of a pair with Coulomb friction: the impulse that removes the closing velocity.
//
// An impulse (P_n, P_t) on B changes the velocity (u_n, u_t) of B relative to A at the contact:
//     u_n' = u_n + k_nn P_n + k_nt P_t,    u_t' = u_t + k_nt P_n + k_tt P_t.
//
//   frictionless     P_n = (target - u_n) / k_nn                               J = M_e V_n  (Popov 1967; Daley 1999)
//   one_step         stick (u_t' = 0) if |P_t| <= mu P_n, else slip with P_t = -mu P_n sign(u_t'): Coulomb's law for
//                    the velocity after the event
//   fixed_direction  P_t = -mu P_n sign(u_t): friction against the motion before the event, as in the reference paper.
//                    It may push a slip past zero. Where mu |k_nt| is close to k_nn it may even add energy, which the
//                    ledger shows. one_step never does.
//
//   u_n     normal velocity, < 0 closing; u_t along the normal turned left                [m/s]
//   target  normal velocity after the event: 0 for a plastic impact                       [m/s]
//   mu      friction coefficient                                                          [-]
//   k_..    compliance (mass_reduction.h)                                                 [1/kg]
//
// Valid for mu below about 1.1 for compact outlines. Above, a sliding corner may have no solution (k_nn - mu |k_nt| <=
// 0, Painleve); one_step then sticks, fixed_direction drops the friction. Neglected: restitution (the paper has none),
// and the change of the arms during the event.
#pragma once

#include "gem/base/vec2.h"
#include "gem/events/mass_reduction.h"

namespace gem {

/// Normal and tangential impulse on B [N s].
struct ContactImpulse {
  double normal = 0.0;
  double tangential = 0.0;
};

/// Normal impulse without friction; never pulls.
GEM_HD constexpr double impact_frictionless(double k_nn, double u_n, double target) {
  return u_n < target ? (target - u_n) / k_nn : 0.0;
}

namespace detail {

/// Slip with friction P_t = -direction mu P_n; returns false if friction jams the corner.
GEM_HD constexpr bool slip(const ContactCompliance& k, double u_n, double target, double mu, double direction,
                           ContactImpulse& impulse) {
  const double effective = k.nn - direction * mu * k.nt;
  if (!(effective > 0.0)) return false;
  impulse.normal = (target - u_n) / effective;
  impulse.tangential = -direction * mu * impulse.normal;
  return true;
}

GEM_HD constexpr ContactImpulse stick(const ContactCompliance& k, double u_n, double u_t, double target) {
  const double determinant = k.nn * k.tt - k.nt * k.nt;
  return {(k.tt * (target - u_n) + k.nt * u_t) / determinant, (-k.nt * (target - u_n) - k.nn * u_t) / determinant};
}

}  // namespace detail

/// Impulse of the one-step law.
GEM_HD constexpr ContactImpulse impact_one_step(const ContactCompliance& k, double u_n, double u_t, double target,
                                                double mu) {
  if (!(u_n < target)) return {};
  const ContactImpulse sticking = detail::stick(k, u_n, u_t, target);
  const double limit = mu * sticking.normal;
  if (sticking.normal >= 0.0 && sticking.tangential <= limit && sticking.tangential >= -limit) return sticking;
  // the remaining slip is opposite to the tangential impulse that sticking would have needed
  const double direction = sticking.tangential > 0.0 ? -1.0 : 1.0;
  ContactImpulse impulse;
  if (detail::slip(k, u_n, target, mu, direction, impulse)) return impulse;
  return sticking.normal > 0.0 ? sticking : ContactImpulse{impact_frictionless(k.nn, u_n, target), 0.0};
}

/// Impulse with friction against the tangential velocity before the event.
GEM_HD constexpr ContactImpulse impact_fixed_direction(const ContactCompliance& k, double u_n, double u_t,
                                                       double target, double mu) {
  if (!(u_n < target)) return {};
  ContactImpulse impulse{impact_frictionless(k.nn, u_n, target), 0.0};
  if (u_t == 0.0) return impulse;
  ContactImpulse sliding;
  if (detail::slip(k, u_n, target, mu, u_t > 0.0 ? 1.0 : -1.0, sliding)) return sliding;
  return impulse;
}

/// Work of an impulse: impulse times the mean of the velocities before and after; <= 0: energy lost [J].
GEM_HD constexpr double impulse_work(double impulse, double before, double after) {
  return 0.5 * impulse * (before + after);
}

}  // namespace gem
