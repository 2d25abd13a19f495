// Checks of dynamic positioning.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/check_scene.h"

namespace gem {

/// What is wrong with set point, gains and thrusters.
void check_dp(const SceneDef& scene, std::vector<SceneProblem>& problems);

/// Keys of dynamic positioning that have no effect, and a mooring that may not be meant.
void warn_of_dp(const SceneDef& scene, std::vector<std::string>& warnings);

}  // namespace gem
