// The force of a resolved contact, mean over its time step: the same code on host and device.
#pragma once

#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/pair_event.h"

namespace gem {

/// Sums the impulses of the points. The force acts at their mean, weighted by the normal impulses. `position_b` is the
/// position of B after the time step. Returns whether the contact acted.
GEM_HD inline bool force_of(const Contact& contact, Vec2 position_b, double dt, ContactForce& force) {
  Vec2 impulse, arm;
  double weight = 0.0;
  bool pressed = false;
  for (int k = 0; k < 2 && k < contact.count; ++k) {
    const ContactSlot& slot = contact.slot[k];
    pressed = pressed || slot.impulse.normal != 0.0 || slot.impulse.tangential != 0.0;
    impulse += world_impulse(contact, slot.impulse);
    arm += slot.impulse.normal * slot.arm_b;
    weight += slot.impulse.normal;
  }
  if (!pressed) return false;
  arm = weight > 0.0 ? (1.0 / weight) * arm : contact.slot[0].arm_b;
  force.a = contact.a;
  force.b = contact.b;
  force.point = position_b + arm;
  force.force = (1.0 / dt) * impulse;
  return true;
}

/// A point in the axes of a body, from its centroid [m].
GEM_HD inline Vec2 in_axes(Vec2 position, Rotation rotation, Vec2 point) {
  return rotate({rotation.cosine, -rotation.sine}, point - position);
}

}  // namespace gem
