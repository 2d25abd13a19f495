// What bodies do without touching: solo events, motion. Each function enters what it gives in the books.
#pragma once

#include "gem/engine/reference/reference_state.h"

namespace gem::reference {

/// Solo events of every floe over the time step, all that events.h lists: velocities at its end, before any contact.
void drive_floes(const Rules& rules, State& s);

/// The platform's own motion over half a time step: drag, then mooring before the contacts, the reverse after them.
void move_platform_before(const Rules& rules, State& s);
void move_platform_after(const Rules& rules, State& s);

/// Moves every floe over the time step with its velocity after the contacts.
void move_floes(const Rules& rules, State& s);

/// Floes past the retire line leave.
void retire_floes(const Rules& rules, State& s);

}  // namespace gem::reference
