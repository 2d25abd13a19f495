// Checks of a mooring that is more than linear.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/check_scene.h"

namespace gem {

/// What is wrong with the laws and tables of the mooring.
void check_mooring(const SceneDef& scene, std::vector<SceneProblem>& problems);

/// Whether the curves of the mooring can be made. Its speeds can only be asked for then.
bool mooring_is_sound(const SceneDef& scene);

/// Keys of the mooring that have no effect.
void warn_of_mooring(const SceneDef& scene, std::vector<std::string>& warnings);

}  // namespace gem
