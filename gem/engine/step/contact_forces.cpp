// The forces of all contacts of a host engine.
#include "gem/engine/step/contact_forces.h"

#include "gem/engine/step/step_force.h"

namespace gem {

std::vector<ContactForce> contact_forces(const FieldState& f, Contacts contacts) {
  std::vector<ContactForce> forces;
  for (const Contact* at : contacts) {
    if (!f.bodies.active[at->a] || !f.bodies.active[at->b]) continue;
    ContactForce force;
    if (force_of(*at, f.bodies.position[at->b], f.constants.dt, force)) forces.push_back(force);
  }
  return forces;
}

void log_forces(const std::vector<ContactForce>& forces, const Bodies& b, std::int64_t step, StepLog& log) {
  for (const ContactForce& f : forces)
    log.forces.push_back({step, f, in_axes(b.position[f.a], b.rotation[f.a], f.point),
                          in_axes(b.position[f.b], b.rotation[f.b], f.point)});
}

}  // namespace gem
