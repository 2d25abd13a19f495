// Mosaic: floes as the cells of a power diagram, for covers that no placement of given shapes reaches.
#pragma once

#include <vector>

#include "gem/base/vec2.h"
#include "gem/field/generator/placement.h"

namespace gem {

/// A floe of a mosaic: outline about its centroid [m], and where that stands.
struct MosaicFloe {
  std::vector<Vec2> outline;
  Vec2 position;
};

struct Mosaic {
  std::vector<MosaicFloe> floes;
  double room = 0.0;  ///< smallest share of its area that a floe finds; below 1 the mosaic failed and has no floes [-]
  double reached_share = 0.0;  ///< share of the floe area that found room [-]
};

/// Floes with exactly the areas of task.outlines, whose shapes are not used. Each is the cell of a power diagram, less
/// half the gap on every side, without corners that hardly turn or stand closer than a tenth of its size, and then
/// shrunk about its centroid to its area. Floes have 3 to 12 sides. Deterministic by task.seed.
Mosaic make_mosaic(const PlacementTask& task);

}  // namespace gem
