// The rules of a scene, section by section, each in the file of its name. A rule is one small function that compares a
// few options and may add a problem.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/check_scene.h"

namespace gem {

using SceneProblems = std::vector<SceneProblem>;
using SceneWarnings = std::vector<std::string>;

/// Each appends what is wrong.
void check_name(const SceneDef& scene, SceneProblems& problems);
void check_time_step(const SceneDef& scene, SceneProblems& problems);
void check_output(const SceneDef& scene, SceneProblems& problems);
void check_floes(const SceneDef& scene, SceneProblems& problems);
void check_platform(const SceneDef& scene, SceneProblems& problems);
void check_listed_floes(const SceneDef& scene, SceneProblems& problems);
void check_ice(const SceneDef& scene, SceneProblems& problems);
void check_drive(const SceneDef& scene, SceneProblems& problems);
void check_mooring(const SceneDef& scene, SceneProblems& problems);
void check_dp(const SceneDef& scene, SceneProblems& problems);
void check_breakup(const SceneDef& scene, SceneProblems& problems);
void check_transit(const SceneDef& scene, SceneProblems& problems);

/// Each appends what is allowed, but has no effect, is unusual or may not be meant.
void warn_of_ice(const SceneDef& scene, SceneWarnings& warnings);
void warn_of_floes(const SceneDef& scene, SceneWarnings& warnings);
void warn_of_time_step(const SceneDef& scene, SceneWarnings& warnings);
void warn_of_output(const SceneDef& scene, SceneWarnings& warnings);
void warn_of_platform(const SceneDef& scene, SceneWarnings& warnings);
void warn_of_drive(const SceneDef& scene, SceneWarnings& warnings);
void warn_of_mooring(const SceneDef& scene, SceneWarnings& warnings);
void warn_of_dp(const SceneDef& scene, SceneWarnings& warnings);
void warn_of_transit(const SceneDef& scene, SceneWarnings& warnings);

/// Whether the floes are generated: of own shapes or copies.
bool is_made(const FloesDef& floes);

/// Whether the curves of the mooring can be made. Its speeds can only be asked for then.
bool mooring_is_sound(const SceneDef& scene);

}  // namespace gem
