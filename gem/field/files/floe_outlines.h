// Makes the outlines of a floe file convex, as floes.concave says.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

/// A floe as a file has it, and where, for messages.
struct FoundFloe {
  FloeDef floe;
  std::string where;
};

/// Floes of a file.
struct ReadFloes {
  std::vector<FloeDef> floes;
  std::int64_t changed = 0;  ///< outlines that were cut or replaced by their hull
  std::int64_t made = 0;     ///< floes that were made of them
  double area_added = 0.0;   ///< by hulls [m2]
};

/// Allowed number of corners of an outline that is cut or replaced by its hull.
inline constexpr std::size_t concave_corners_maximum = 500;

/// refuse: throws Error(scene_rejected) for an outline that is not convex or has more than 20 corners.
/// cut:    convex pieces with the same area, each a floe with the thickness of the whole; not bonded to each other.
/// hull:   the convex hull.
/// In all cases throws for an outline that crosses itself, repeats a corner or has corners on a straight line.
ReadFloes convex_floes(const std::vector<FoundFloe>& found, ConcaveFloes concave);

}  // namespace gem
