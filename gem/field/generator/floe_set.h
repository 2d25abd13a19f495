// The floe set: shapes and sizes before anything is placed. It depends on the seed and the size law only.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// One outline per floe, centred on its centroid [m].
///   generated: every floe has its own shape. The sizes are the quantiles at the midpoints of `count` equal shares,
///              shuffled.
///   copied:    a library of `shape_count` shapes. Their sizes are quantiles too, spread slightly so that the library
///              has the requested mean and deviation (within the size limits). Copies keep the size; each is turned at
///              random.
std::vector<std::vector<Vec2>> make_floe_set(const SceneDef& scene, std::int64_t count);

/// Ice class of each floe. Floes are taken largest first; each joins the class that lacks most area. The areas of the
/// classes then have the ratio of their tenths.
std::vector<std::uint8_t> mixed_classes(const std::vector<double>& area, const std::vector<IceClassDef>& classes);

/// Indices of the floes, largest area first; equal areas by index.
std::vector<std::size_t> largest_first(const std::vector<double>& area);

}  // namespace gem
