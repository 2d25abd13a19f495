// The checks of a whole field before anything runs, and the search for near pairs that they share with the statistics.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Outlines may touch, and overlap by rounding up to this depth [m].
inline constexpr double overlap_tolerance = 1e-6;

/// Two bodies (a < b, not both fixed) and their distance; negative is the depth of their overlap [m].
struct NearPair {
  std::size_t a = 0;
  std::size_t b = 0;
  double separation = 0.0;
};

/// Every pair not farther apart than `distance` [m], ordered by a, then b. Found with a grid.
std::vector<NearPair> near_pairs(const Bodies& bodies, double distance);

/// Throws Error(scene_rejected) if bodies overlap (lists up to 10 pairs with depth and the count) or a floe lies
/// outside the channel.
void check_field(const SceneDef& scene, const Bodies& bodies);

}  // namespace gem
