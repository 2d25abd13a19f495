// One contact of a time step: geometry, compliance, and the impulses of its event.
#pragma once

#include <cstdint>
#include <span>

#include "gem/base/vec2.h"
#include "gem/engine/contact_key.h"
#include "gem/events/events.h"

namespace gem {

/// One point of a contact. "Tangential" is along the normal turned left. Impulses act on B; A gets the opposite.
struct ContactSlot {
  Vec2 arm_a, arm_b;             // from the centroids [m]
  double separation = 0.0;       // < 0: overlap depth [m]
  std::int32_t feature = 0;      // id of the touching corner
  ContactCompliance compliance;  // with the platform's mass as the solver splits it [1/kg]
  double normal_before = 0.0;    // velocity of B relative to A before the events [m/s]
  double tangential_before = 0.0;
  double target = 0.0;     // smallest normal velocity after the events [m/s]
  double cap = no_cap;     // largest impulse.normal [N s]
  ContactImpulse impulse;  // [N s]
  double elastic = 0.0;    // part of impulse.normal that is elastic stress [N s]
  double repair = 0.0;     // position repair, as an impulse [N s]
  // coupled: normal impulse of the last time step, and the friction that it left to this one [N s]
  double last_normal = 0.0;
  SpareFriction spare;
};

/// A touching pair. A has the lower id; the normal points from A to B.
struct Contact {
  std::int32_t a = 0, b = 0;
  std::int32_t count = 0;
  Vec2 normal;
  double width = 0.0;   // chord or length of the facing edges [m]
  double growth = 0.0;  // chord growth with depth for one point; for two points see tilted_faces.h [-]
  double friction = 0.0;
  double largest_force = 0.0;  // compliant: normal force within the time step [N]
  ContactSlot slot[2];
};

/// The contacts of one time step, ascending in (a, b). Contacts of the platform come first.
using Contacts = std::span<Contact* const>;

}  // namespace gem
