// The contacts of one time step: what they ask for, and the impulses and repairs that answer.
#pragma once

#include "gem/engine/reference/reference_state.h"
#include "gem/engine/reference/touch.h"

namespace gem::reference {

/// Friction, arms, velocities, targets and caps at the instant of the events.
void prepare_touches(const Rules& rules, const State& s, std::vector<Touch>& touches);

/// Independent: each pair alone, all from the same velocities.
void resolve_alone(const Rules& rules, const State& s, std::vector<Touch>& touches);

/// Coupled: all pairs together. Finds the position repair too and enters it in the state.
void resolve_together(const Rules& rules, State& s, std::vector<Touch>& touches, StepQuality& quality);

/// Gives the impulses to the bodies, and marks those that leave the path of their drag.
void apply_impulses(const Rules& rules, State& s, const std::vector<Touch>& touches);

}  // namespace gem::reference
