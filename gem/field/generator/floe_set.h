// The floe set: shapes and sizes before anything is placed. It depends on the seed and the size law only.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// One outline per floe, centred on its centroid [m].
///   generated: every floe its own shape; sizes are the quantiles at the midpoints of `count` equal shares, shuffled.
///   copied: `shape_count` shapes whose sizes are such quantiles, spread slightly so that the library's mean and
///   deviation are the asked ones (if they stay within the size limits); copies keep the size, each turned at random.
std::vector<std::vector<Vec2>> make_floe_set(const SceneDef& scene, std::int64_t count);

/// Class of each floe: taken largest first, each floe joins the class that lacks most area, so that the areas of the
/// classes stand in the ratio of their tenths.
std::vector<std::uint8_t> mixed_classes(const std::vector<double>& area, const std::vector<IceClassDef>& classes);

/// Indices of the floes, largest area first; equal areas in order of index.
std::vector<std::size_t> largest_first(const std::vector<double>& area);

}  // namespace gem
