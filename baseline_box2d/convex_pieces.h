// Cuts a convex outline with many corners into convex pieces with few.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/base/vec2.h"

namespace gem::baseline {

/// Splits a convex counter-clockwise outline into pieces with at most `corners_maximum` (3 or more) corners each. They
/// cover it exactly: no corner is added or moved, and neighbours share a chord. The number of pieces is minimal; their
/// sizes are about equal.
std::vector<std::vector<Vec2>> convex_pieces(const std::vector<Vec2>& outline, std::size_t corners_maximum);

}  // namespace gem::baseline
