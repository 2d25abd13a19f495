// Generates pack-ice fields: makes the floe set and places it in the channel.
#pragma once

#include <vector>

#include "gem/base/vec2.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// `count` floes inside the field rectangle and the channel, at least gap_m from the obstacles (world outlines). Shapes
/// and sizes depend only on the seed and the size law. Positions also depend on the channel: if the whole field tapers,
/// the same floes stand closer (cover 0.48 for a gap of 300 m, 0.56 for 200 m, instead of 0.42). `tiled` repeats one
/// block of copied floes along the channel, which must be straight there. Floes are numbered by the x of their
/// centroids. A concentration above 0.75 of generated floes is made as a mosaic, see mosaic.h. Thickness is 0, and the
/// ice classes decide. Throws Error(scene_rejected) if the floes do not fit.
std::vector<FloeDef> generate_floes(const SceneDef& scene, const std::vector<std::vector<Vec2>>& obstacles);

}  // namespace gem
