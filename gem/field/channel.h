// The channel between the two side boundaries.
//
// Half the width: inlet_width / 2 up to the start of the taper (taper_start_x, but never upstream of inlet_x), straight
// from there to gap / 2 at x = 0, gap / 2 from there on. The sides exist between inlet_x and outlet_x and are 50 m
// thick.
#pragma once

#include <vector>

#include "gem/base/vec2.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Convex counter-clockwise outlines in world coordinates, upper side first. One per side, or two where the channel has
/// a bend towards its axis (a straight stretch before the taper, or a gap wider than the inlet).
/// Empty without boundary. Throws Error(scene_rejected) unless inlet_x < 0 <= outlet_x and the widths are positive.
std::vector<std::vector<Vec2>> boundary_outlines(const BoundaryDef& boundary);

/// Half the free width at x [m].
double channel_half_width(const BoundaryDef& boundary, double x);

/// False if a vertex lies more than a micrometre upstream of the inlet or beyond a side. True without boundary.
bool inside_channel(const BoundaryDef& boundary, const std::vector<Vec2>& outline);

}  // namespace gem
