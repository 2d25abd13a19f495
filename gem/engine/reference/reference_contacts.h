// The contacts of one time step: what they ask for, and the impulses and repairs that answer.
#pragma once

#include "gem/engine/reference/reference_state.h"
#include "gem/engine/reference/touch.h"

namespace gem {

/// Friction, arms, velocities, targets and caps at the instant of the events.
void prepare_touches(const ReferenceRules& rules, const ReferenceState& s, std::vector<Touch>& touches);

/// Independent: each pair alone, all from the same velocities.
void resolve_alone(const ReferenceRules& rules, const ReferenceState& s, std::vector<Touch>& touches);

/// Coupled: all pairs together. Finds the position repair too and enters it in the state.
void resolve_together(const ReferenceRules& rules, ReferenceState& s, std::vector<Touch>& touches,
                      MomentQuality& quality);

/// Gives the impulses to the bodies, and marks those that leave the path of their drag.
void apply_impulses(const ReferenceRules& rules, ReferenceState& s, const std::vector<Touch>& touches);

}  // namespace gem
