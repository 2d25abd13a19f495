// The generated pack-ice fields: the floe set made and placed in the channel.
#pragma once

#include <vector>

#include "gem/base/vec2.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// `count` floes inside the field rectangle and the channel, clear of the obstacles (world outlines) by gap_m.
/// Shapes and sizes depend on the seed and the size law, the places also on the channel: with a taper over the whole
/// field the same floes stand closer (cover 0.48 for a gap of 300 m, 0.56 for 200 m, instead of 0.42).
/// `tiled` repeats one block of copied floes along the channel, which must be straight there.
/// Floes are numbered along the channel, by the x of their centroids. Thickness is 0: the ice classes decide it. Throws
/// Error(scene_rejected) if the floes do not fit.
std::vector<FloeDef> generate_floes(const SceneDef& scene, const std::vector<std::vector<Vec2>>& obstacles);

}  // namespace gem
