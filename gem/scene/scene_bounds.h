// What is known of speeds and floe widths before the field is made.
#pragma once

#include "gem/scene/scene_def.h"

namespace gem {

/// Speed at which two bodies of the scene may approach each other: water, wall at rest, listed floes, and the platform
/// as it starts [m/s].
double closing_speed_bound(const SceneDef& scene);

/// Smallest width of any floe of the scene that is known before the field is made [m]; infinity without floes.
double smallest_floe_width(const SceneDef& scene);

}  // namespace gem
