// Cuts a convex outline along a line into two convex outlines.
#pragma once

#include <optional>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// Both parts of an outline, counter-clockwise, in the axes of the outline.
struct OutlineCut {
  std::vector<Vec2> left, right;  // of the direction of the line
  double length = 0.0;            // of the cut [m]
};

/// Cuts a convex counter-clockwise outline along the line through `point` with the unit vector `along`. A corner nearer
/// to the line than `snap` [m] becomes an end of the cut, so no new edge is shorter than that. Nothing if the line
/// misses the outline or only touches it.
std::optional<OutlineCut> cut_outline(const std::vector<Vec2>& outline, Vec2 point, Vec2 along, double snap);

}  // namespace gem
