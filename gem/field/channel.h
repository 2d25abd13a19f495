// The channel between the two side boundaries.
//
// Half the free width: inlet_width / 2 up to the start of the taper (taper_start_x, but not upstream of inlet_x),
// linear from there to gap / 2 at x = 0, then gap / 2. The sides reach from inlet_x to outlet_x and are 50 m thick.
#pragma once

#include <vector>

#include "gem/base/vec2.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Convex counter-clockwise outlines in world coordinates [m], upper side first. One body per side, or two where the
/// channel bends towards its axis (a straight stretch before the taper, or a gap wider than the inlet). Empty without
/// boundary. Throws Error(scene_rejected) unless inlet_x < 0 <= outlet_x and the widths are positive.
std::vector<std::vector<Vec2>> boundary_outlines(const BoundaryDef& boundary);

/// Half the free width at x [m].
double channel_half_width(const BoundaryDef& boundary, double x);

/// False if a vertex lies more than a micrometre upstream of the inlet or inside a side. True without boundary.
bool inside_channel(const BoundaryDef& boundary, const std::vector<Vec2>& outline, double overlap = 0.0);

}  // namespace gem
