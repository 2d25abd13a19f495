// Checks of the platform: its outline, its place, and options that need each other.
#pragma once

#include "gem/scene/check_scene.h"

namespace gem {

/// Appends the problems of the platform.
void check_platform(const SceneDef& scene, std::vector<SceneProblem>& problems);

/// Appends what is allowed there, but has no effect or may not be meant.
void warn_of_platform(const SceneDef& scene, std::vector<std::string>& warnings);

}  // namespace gem
