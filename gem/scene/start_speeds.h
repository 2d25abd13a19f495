// How fast the bodies of a scene move at the start: what moments and the reach of contacts are measured by.
#pragma once

#include "gem/scene/scene_def.h"

namespace gem {

/// How fast a listed floe's spin moves its farthest corner about its centroid at the start [m/s].
double rim_speed(const FloeDef& floe);

/// Largest speed at which points of two bodies of the scene may approach each other at the start: platform or wall at
/// rest, water, listed floes with the two largest rim speeds [m/s].
double closing_speed_bound(const SceneDef& scene);

}  // namespace gem
