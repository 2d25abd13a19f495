// The contacts of one time step: their targets, impulses and repairs.
#pragma once

#include "gem/engine/reference/reference_state.h"
#include "gem/engine/reference/touch.h"

namespace gem::reference {

/// Sets friction, arms, velocities, targets and caps at the time of the events.
void prepare_touches(const Rules& rules, const State& s, std::vector<Touch>& touches);

/// Independent: each pair alone, all from the same velocities.
void resolve_alone(const Rules& rules, const State& s, std::vector<Touch>& touches);

/// Coupled: all pairs together. Also finds the position repair and stores it in the state.
void resolve_together(const Rules& rules, State& s, std::vector<Touch>& touches, StepQuality& quality);

/// Applies the impulses to the bodies, and marks bodies that do not follow the path of their drag.
void apply_impulses(const Rules& rules, State& s, const std::vector<Touch>& touches);

}  // namespace gem::reference
