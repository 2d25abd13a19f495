// Splits floes of a field into two pieces each.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// A crack that shall run through a floe.
struct FloeCrack {
  std::int32_t floe = 0;  // body
  Vec2 point;             // where it begins, in the axes of the floe about its centroid [m]
  Vec2 along;             // unit vector, in these axes
};

/// What became of a crack.
struct FloeSplit {
  enum class Result : std::int32_t {
    split,
    too_small,  // a piece would be smaller than allowed, a sliver, or have too many corners: the floe stays whole
    no_room     // all rows for pieces are taken: the floe stays whole
  };
  Result result = Result::too_small;
  std::int32_t floe = -1;            // body that shall split
  std::int32_t piece[2] = {-1, -1};  // bodies, left and right of the crack
  double length = 0.0;               // of the crack [m]
};

/// Largest radius over the root of the area of a piece: 1 : 8 as a rectangle. Chosen by hand; contacts of longer floes
/// are hard to resolve.
inline constexpr double piece_radius_maximum = 1.4;

/// Splits each floe of `cracks` that can be split; each is active, and named once. A piece takes the next free row. It
/// has the thickness, class and rotation of its floe, and moves as that part of the floe did: momentum, angular
/// momentum and energy do not change. The floe is retired. Returns a result for each crack.
std::vector<FloeSplit> split_floes(Bodies& bodies, const SceneDef& scene, const std::vector<FloeCrack>& cracks);

}  // namespace gem
