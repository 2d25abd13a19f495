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

/// What is allowed but deserves a second look, one line each: "key: problem (value, limit) suggestion".
std::vector<std::string> scene_warnings(const SceneDef& scene);

/// Smallest width of any floe of the scene that is known before the field is made [m]; infinity without floes.
double smallest_floe_width(const SceneDef& scene);

}  // namespace gem
