// Baselines on the closed-form scenes: surveyed beside gem's engines, not judged.
#pragma once

#include <vector>

#include "validation/verification/scenes.h"

namespace gem::verification {

/// The baselines and settings to run instead of gem's engines, if the environment variable GEM_BASELINES is set. Their
/// rows then go to the table with their errors; a test that fails says only that a baseline misses gem's tolerance.
std::vector<Setting> surveyed_baselines();

}  // namespace gem::verification
