// Checks of what drives the bodies: tables of current, tide and wind, and the laws that need each other.
#pragma once

#include "gem/scene/check_scene.h"

namespace gem {

/// Appends the problems of current and wind.
void check_drive(const SceneDef& scene, std::vector<SceneProblem>& problems);

/// Appends what is allowed there, but has no effect or may not be meant.
void warn_of_drive(const SceneDef& scene, std::vector<std::string>& warnings);

}  // namespace gem
