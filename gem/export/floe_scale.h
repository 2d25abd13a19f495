// Makes a frame of floes a valid start: floes that overlap are drawn smaller.
#pragma once

#include <vector>

#include "gem/export/floe_record.h"

namespace gem {

/// For each floe the factor, at most 1, by which its outline about the centroid must shrink so that no two floes, and
/// no floe and none of `obstacles` (convex outlines in the world [m]), overlap. 1 for a floe that overlaps nothing.
/// Each pair is parted along the axis of its least overlap: outlines that reach h_A and h_B from their centroids along
/// it and overlap by d part when both shrink by d / (h_A + h_B), an outline and an obstacle when it shrinks by d / h_A.
/// Throws Error(usage) if a floe would lose half its size or more.
std::vector<double> parting_scales(const std::vector<FrameFloe>& floes,
                                   const std::vector<std::vector<Vec2>>& obstacles);

}  // namespace gem
