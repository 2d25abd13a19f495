// The outline of the platform and what follows from it: extent, area, width for the drag.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

/// The outline in body axes about its centroid, counter-clockwise [m]. A regular polygon starts with the corner on the
/// x axis. A ship starts with its stem, at -x: with yaw 0 its bow meets ice that drifts to +x. A listed outline keeps
/// its first corner. Nothing is checked: a listed outline of no area comes back as it is. Of a platform of several
/// pieces: the corners of all, piece by piece.
std::vector<Vec2> platform_outline(const PlatformDef& platform);

/// The outlines of the convex pieces in body axes about their common centroid, counter-clockwise [m]. A platform of one
/// piece has its outline.
std::vector<std::vector<Vec2>> platform_pieces(const PlatformDef& platform);

/// A name for each side of the outline, from corner k to corner k + 1: the parts of a ship, such as "port quarter".
/// Empty for outlines whose sides have only numbers.
std::vector<std::string> platform_side_names(const PlatformDef& platform);

/// Area of the outline or of all pieces together [m2]; 0 if it has none.
double platform_area(const PlatformDef& platform);

/// Moment of inertia about the centroid, as given or of the mass spread over the outline or the pieces [kg m2]; 0
/// without an area.
double platform_inertia(const PlatformDef& platform);

/// Radius of the circle about the centre that holds the outline [m].
double platform_radius(const PlatformDef& platform);

/// How far the outline can reach from the centre during a run [m]. A platform that may turn reaches as far in every
/// direction.
struct PlatformReach {
  double upstream = 0.0;    // towards -x
  double downstream = 0.0;  // towards +x
  double sideways = 0.0;    // towards -y or +y, the larger
};
PlatformReach platform_reach(const PlatformDef& platform);

/// Length on which the water drags by axis: the diameter of a regular polygon, or the extent of the outline along its x
/// axis, which is the length of a ship [m].
double platform_drag_length(const PlatformDef& platform);

/// Width on which the water drags: the diameter of a regular polygon, or the extent of the outline across its x axis,
/// which is the beam of a ship [m].
double platform_drag_width(const PlatformDef& platform);

}  // namespace gem
