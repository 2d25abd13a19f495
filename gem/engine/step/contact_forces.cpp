// Sums the impulses of the points of each contact.
#include "gem/engine/step/contact_forces.h"

#include "gem/engine/step/contact_stages.h"

namespace gem {

std::vector<ContactForce> contact_forces(const FieldState& f, Contacts contacts) {
  std::vector<ContactForce> forces;
  for (const Contact* at : contacts) {
    const Contact& contact = *at;
    if (!f.bodies.active[contact.a] || !f.bodies.active[contact.b]) continue;
    Vec2 impulse, arm;
    double weight = 0.0;
    bool acted = false;
    for (int k = 0; k < contact.count; ++k) {
      const ContactSlot& slot = contact.slot[k];
      acted = acted || slot.impulse.normal != 0.0 || slot.impulse.tangential != 0.0;
      impulse += world_impulse(contact, slot.impulse);
      arm += slot.impulse.normal * slot.arm_b;
      weight += slot.impulse.normal;
    }
    if (!acted) continue;
    arm = weight > 0.0 ? (1.0 / weight) * arm : contact.slot[0].arm_b;
    forces.push_back({contact.a, contact.b, f.bodies.position[contact.b] + arm, (1.0 / f.constants.dt) * impulse});
  }
  return forces;
}

}  // namespace gem
