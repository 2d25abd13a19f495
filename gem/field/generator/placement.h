// Start positions of the floes of a generated field, with the requested gap around each floe.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/field/generator/outline_grid.h"

namespace gem {

struct Pose {
  Vec2 position;  // of the outline's origin, world [m]
  Rotation rotation;
};

/// What is to be placed, and where. Outlines are convex, counter-clockwise and centred on their centroids.
struct PlacementTask {
  std::vector<std::vector<Vec2>> outlines;   // [m]
  Box region;                                // every floe lies entirely inside
  std::vector<std::vector<Vec2>> obstacles;  // world coordinates
  double gap = 0.05;                         // [m]
  std::uint64_t seed = 1;
};

/// Random sequential placement, largest floe first: each takes the first random position that keeps the gap, without
/// turning. Empty if a floe finds no position in 20000 trials. Reaches a cover of about 0.6 with the paper's sizes.
std::optional<std::vector<Pose>> place_at_random(const PlacementTask& task);

/// Packing: places the floes shrunk, then lets them grow while overlapping pairs push each other apart and turn
/// (projected overlaps, each correction shared by inverse mass and inertia). Shapes and sizes are exactly as requested.
/// Empty if floes still overlap after the last growth step. Reaches a cover of 0.8 of the free water with the paper's
/// sizes (about 2 s for 1000 floes).
std::optional<std::vector<Pose>> pack(const PlacementTask& task);

/// Random placement, or packing if random placement fails. Throws Error(scene_rejected) if both fail.
std::vector<Pose> place(const PlacementTask& task);

}  // namespace gem
