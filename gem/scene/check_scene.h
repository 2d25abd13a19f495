// Compares the options of a scene with one another: what a table of ranges cannot see.
#pragma once

#include <string>
#include <vector>

#include "gem/scene/scene_def.h"

namespace gem {

/// One fault; `key` is the option to change, `text` reads "problem (value, allowed range) suggestion".
struct SceneProblem {
  std::string key;
  std::string text;
};

/// Everything for which the scene is refused; empty if it may run.
std::vector<SceneProblem> check_scene(const SceneDef& scene);

/// The scene with the floes of a file listed, which no check has seen yet. Throws Error(scene_rejected) with the first
/// fault of it.
SceneDef with_listed_floes(const SceneDef& scene, std::vector<FloeDef> floes);

/// What is allowed but deserves a second look, one line each: "key: problem (value, limit) suggestion".
std::vector<std::string> scene_warnings(const SceneDef& scene);

}  // namespace gem
