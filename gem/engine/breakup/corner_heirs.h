// What corners of compliant contacts remember when floes split.
//
// The memory of a corner of the floe goes to a piece that has the corner, that of another body's corner in the floe to
// the piece that it is in. Both keep what is crushed and what springs, so a split changes no force by itself. The ends
// of a crack are new corners: where they overlap, they start in crushed ice, as every corner that comes in from beside.
#pragma once

#include <vector>

#include "gem/engine/engine.h"

namespace gem {

/// Hands the memory in `state` on to the pieces of floes that have split in it. `splits`: those that were made.
void hand_on_corners(EngineState& state, const std::vector<FloeSplit>& splits);

}  // namespace gem
