// Random floe shapes: convex polygons like the fragments of a broken floe.
#pragma once

#include <vector>

#include "gem/base/random.h"
#include "gem/base/vec2.h"

namespace gem {

/// Random number streams of a field, one per purpose.
enum class FieldStream : std::uint32_t { size_order = 1, shape, position, copy, packing };

/// One convex counter-clockwise polygon of area 1, centred on its centroid. It has 4 to 7 sides in 99 % of cases and
/// never more than 12, a random orientation, an elongation up to 1.7, and neither short edges nor nearly straight
/// corners.
std::vector<Vec2> random_shape(RandomSequence& numbers);

/// The same outline with `size` = sqrt(area) [m].
std::vector<Vec2> scaled(const std::vector<Vec2>& outline, double size);

}  // namespace gem
