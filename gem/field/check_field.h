// Checks of a whole field before anything runs, and the search for near pairs.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Overlaps up to this depth count as rounding: outlines may touch [m].
inline constexpr double overlap_tolerance = 1e-6;

/// Two bodies (a < b, not both fixed) and their distance; negative is the depth of their overlap [m].
struct NearPair {
  std::size_t a = 0;
  std::size_t b = 0;
  double separation = 0.0;
};

/// Every pair not farther apart than `distance` [m], sorted by a, then b. Uses a grid.
std::vector<NearPair> near_pairs(const Bodies& bodies, double distance);

/// Throws Error(scene_rejected) if bodies overlap by more than rounding and scene.floes.overlap (the message lists up
/// to 10 pairs with their depth, and the number of pairs) or a floe lies outside the channel.
void check_field(const SceneDef& scene, const Bodies& bodies);

}  // namespace gem
