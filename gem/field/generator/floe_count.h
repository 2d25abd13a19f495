// How many floes a concentration needs.
#pragma once

#include <cstdint>

#include "gem/scene/scene_def.h"

namespace gem {

/// Number of floes whose areas cover the share floes.concentration of `water` [m2]; at least 1.
/// Throws Error(scene_rejected) if there are too many, or if there is no water.
std::int64_t count_of_concentration(const FloesDef& floes, double water);

/// Sizes are kept, so the cover goes in steps of a floe: half a floe of mean area over the water, and the difference
/// between the law's mean area and that of its quantiles [-].
double concentration_tolerance(const FloesDef& floes, double water);

}  // namespace gem
