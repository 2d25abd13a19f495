// Checks of a ship in transit.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/check_scene.h"

namespace gem {

/// What is wrong with the path, and what else would hold the ship.
void check_transit(const SceneDef& scene, std::vector<SceneProblem>& problems);

/// Keys of a transit that have no effect.
void warn_of_transit(const SceneDef& scene, std::vector<std::string>& warnings);

}  // namespace gem
