// What bodies press on each other with, for the record of a frame.
#pragma once

#include <vector>

#include "gem/engine/engine.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"

namespace gem {

/// The forces of resolved contacts: their impulses over the time step. `f` is the state after that step. A pair with
/// two points is one force, at their mean, weighted by the normal impulses.
std::vector<ContactForce> contact_forces(const FieldState& f, Contacts contacts);

}  // namespace gem
