// The checks that the outline of a floe or fixed body must pass.
#pragma once

#include <string>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/scene/schema/schema.h"

namespace gem {

inline constexpr double outline_edge_minimum = 1e-3;  // [m]

struct CheckedOutline {
  std::vector<Vec2> outline;  // counter-clockwise
  bool reversed = false;      // given clockwise
};

/// What an outline is compared with, and what to do where it is not convex.
struct OutlineRule {
  std::size_t corners_maximum = listed_corners_maximum;
  const char* where_concave = "split it into convex floes";
};

/// Accepts a strictly convex outline of 3 to 20 corners (or as `rule` says) in either direction. Throws
/// Error(scene_rejected) naming the body (`name`) and the vertex (counted from 0, as given) for: too few or too many
/// corners, non-finite numbers, repeated or nearly repeated corners, corners on a straight line, zero area, a corner
/// that turns inwards, self-crossing. Nothing is repaired.
CheckedOutline check_outline(const std::vector<Vec2>& outline, const std::string& name, const OutlineRule& rule = {});

/// The same for a simple outline, which may turn inwards: it must not cross or touch itself.
CheckedOutline check_simple_outline(const std::vector<Vec2>& outline, const std::string& name,
                                    std::size_t corners_maximum);

}  // namespace gem
