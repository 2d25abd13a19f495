// How well a contact point obeys the contact laws after the events of its time step.
//
//   complementarity   |clamp(u_n - target, K_n (P_n - cap), K_n P_n)|    parts without impulse, closes only at the cap
//   cone excess       max(0, |P_t| - mu P_n)                             Coulomb's bound, with spare friction
//   work              P_n and P_t times the mean of the velocities before and after
//
//   u_n     velocity of B relative to A along the normal after the events  [m/s]
//   target  smallest u_n that the law allows                               [m/s]
//   K_n     compliance of the pair at this point alone                     [1/kg]
//   P_n P_t impulse on B along the normal and the normal turned left       [N s]
//   cap     impulse that crushes the whole face                            [N s]
// The complementarity is a speed: the change of u_n that would satisfy the normal contact law.
#pragma once

#include "gem/base/choose.h"
#include "gem/engine/step/contact.h"
#include "gem/events/events.h"

namespace gem {

struct PointQuality {
  double complementarity = 0.0;  // [m/s]
  double cone_excess = 0.0;      // [N s]
  double work = 0.0;             // work of the impulses on both bodies [J]
};

/// `velocity` is that of B relative to A at the point after the events [m/s]; `a` and `b` are the masses of A and B.
GEM_HD inline PointQuality point_quality(const Contact& contact, const ContactSlot& slot, CollisionMass a,
                                         CollisionMass b, Vec2 velocity) {
  const ContactImpulse& p = slot.impulse;
  const double after_n = dot(velocity, contact.normal);
  const double excess = after_n - slot.target;
  PointQuality q;
  if (p.normal == 0.0 && p.tangential == 0.0) {
    q.complementarity = larger(-excess, 0.0);
    return q;
  }
  const double compliance =
      inverse_effective_mass(a, slot.arm_a, contact.normal) + inverse_effective_mass(b, slot.arm_b, contact.normal);
  const double least = compliance * (p.normal - slot.cap), most = compliance * p.normal;
  q.complementarity = magnitude(larger(smaller(excess, most), least));
  q.cone_excess = beyond_friction(contact.friction, p, slot.spare);
  const double after_t = dot(velocity, turned_left(contact.normal));
  q.work =
      impulse_work(p.normal, slot.normal_before, after_n) + impulse_work(p.tangential, slot.tangential_before, after_t);
  return q;
}

}  // namespace gem
