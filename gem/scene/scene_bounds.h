// What is known of speeds and floe widths before the field is made.
#pragma once

#include "gem/scene/scene_def.h"

namespace gem {

/// How fast a listed floe's spin moves its farthest corner about its centroid at the start [m/s].
double rim_speed(const FloeDef& floe);

/// Largest speed of the swing that the platform starts with; what the ice adds is slower than the ice [m/s]. 0 without
/// a platform.
double platform_speed_bound(const SceneDef& scene);

/// Largest speed at which points of two bodies of the scene may approach each other: water, wall at rest, listed floes
/// with the two largest rim speeds, and the platform as it starts [m/s].
double closing_speed_bound(const SceneDef& scene);

/// Smallest width of any floe of the scene that is known before the field is made [m]; infinity without floes.
double smallest_floe_width(const SceneDef& scene);

}  // namespace gem
