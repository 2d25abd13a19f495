// The pieces of a platform: the checks that they must pass, and their joints.
#pragma once

#include <vector>

#include "gem/field/bodies.h"
#include "gem/field/check_outline.h"
#include "gem/geometry/piece_joints.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Compares a piece of a platform with the allowed outlines.
inline constexpr OutlineRule piece_rule = {platform_corners_maximum, "split it into convex pieces"};

/// Throws Error(scene_rejected) for a piece that is not convex (see check_outline()), or two that overlap by more than
/// piece_touch (gem/geometry/piece_joints.h). Messages name the pieces, counted from 0.
void check_platform_pieces(const PlatformDef& platform);

/// The joints of a platform of several pieces, by corner as in `bodies.vertex`.
std::vector<PieceCorner> corners_of_pieces(const Bodies& bodies);

}  // namespace gem
