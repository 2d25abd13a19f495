// In which settings the case of a run file differs from the case that is asked for.
#pragma once

#include <string>

#include "gem/scene/scene_def.h"

namespace gem {

/// The first settings that differ, as "; key = old there, key = new here"; empty if the file cannot be read.
std::string case_difference(const std::string& run_file, const SceneDef& scene);

}  // namespace gem
