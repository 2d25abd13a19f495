// Checks that compare the options of a scene with each other, which a table of ranges cannot do.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

/// One problem. `key` is the option to change; `text` reads "problem (value, allowed range); suggestion".
struct SceneProblem {
  std::string key;
  std::string text;
};

/// All reasons to refuse the scene; empty if it may run.
std::vector<SceneProblem> check_scene(const SceneDef& scene);

/// The scene with the floes of a file listed and checked. Throws Error(scene_rejected) with the first problem.
SceneDef with_listed_floes(const SceneDef& scene, std::vector<FloeDef> floes);

/// What is allowed but unusual, one line each: "key: problem (value, limit); suggestion".
std::vector<std::string> scene_warnings(const SceneDef& scene);

}  // namespace gem
