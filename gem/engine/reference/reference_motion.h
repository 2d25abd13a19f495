// What bodies do without touching: drag, mooring, motion. Each function enters what it gives in the books.
#pragma once

#include "gem/engine/reference/reference_state.h"

namespace gem {

/// Drag of the current on every floe over the time step: velocities at its end, before any contact.
void drag_floes(const ReferenceRules& rules, ReferenceState& s);

/// The platform's own motion over half a time step: drag, then mooring before the contacts, the reverse after them.
void move_platform_before(const ReferenceRules& rules, ReferenceState& s);
void move_platform_after(const ReferenceRules& rules, ReferenceState& s);

/// Moves every floe over the time step with its velocity after the contacts.
void move_floes(const ReferenceRules& rules, ReferenceState& s);

/// Floes past the retire line leave.
void retire_floes(const ReferenceRules& rules, ReferenceState& s);

}  // namespace gem
