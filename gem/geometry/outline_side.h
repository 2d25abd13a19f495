// Which side of a convex outline a contact presses on.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// The side k of a counter-clockwise outline, from corner k to corner k + 1, that takes a contact at `point` with
/// `normal` out of the outline, both in its axes. It is the side whose normal is nearest to that of the contact among
/// those that the point lies on: as near as the nearest, give or take 1 % of the outline's radius. So a contact at a
/// corner goes to the side that faces it, and one with a face always to that face. `outline` has three corners at
/// least.
std::size_t side_of(const std::vector<Vec2>& outline, Vec2 point, Vec2 normal);

}  // namespace gem
