// Baselines on the closed-form scenes: listed beside gem's engines, not judged.
#pragma once

#include <vector>

#include "validation/verification/scenes.h"

namespace gem::verification {

/// The baselines and settings to run instead of gem's engines, if the environment variable GEM_BASELINES is set. Their
/// errors are added to the table. A failing test then only means that a baseline misses gem's tolerance.
std::vector<Setting> surveyed_baselines();

}  // namespace gem::verification
