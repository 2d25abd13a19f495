// Motion of bodies apart from contacts: solo events and drift. Each function books what it gives.
#pragma once

#include "gem/engine/reference/reference_state.h"

namespace gem::reference {

/// Solo events of every floe over the time step, all those of events.h. Sets the velocities at its end without
/// contacts.
void drive_floes(const Rules& rules, State& s);

/// Half a time step of the platform's own motion: drag then mooring before the contacts, mooring then drag after them.
void move_platform_before(const Rules& rules, State& s);
void move_platform_after(const Rules& rules, State& s);

/// Leads a ship in transit before a time step.
void tow_platform(const Rules& rules, State& s);

/// A whole time step of the platform's own motion, when the contacts have changed its speed from `before`.
void move_struck_platform(const Rules& rules, State& s, const PlatformSpeed& before);

/// Moves every floe over the time step with its velocity after the contacts.
void move_floes(const Rules& rules, State& s);

/// Retires floes past the retire line.
void retire_floes(const Rules& rules, State& s);

}  // namespace gem::reference
