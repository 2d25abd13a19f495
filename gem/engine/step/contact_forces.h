// What bodies press on each other with, for the record of a frame and for laws that need it.
#pragma once

#include <vector>

#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// The forces of resolved contacts: their impulses over the time step. `f` is the state after that step. A pair with
/// two points is one force, at their mean, weighted by the normal impulses.
std::vector<ContactForce> contact_forces(const FieldState& f, Contacts contacts);

/// Appends the forces of time step `step` to StepLog::forces. `b` is the state after that step.
void log_forces(const std::vector<ContactForce>& forces, const Bodies& b, std::int64_t step, StepLog& log);

}  // namespace gem
