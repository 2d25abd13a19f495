// Random floe shapes: convex polygons like the fragments of a broken floe.
#pragma once

#include <vector>

#include "gem/base/random.h"
#include "gem/base/vec2.h"

namespace gem {

/// Streams of random numbers of a field, one per purpose.
enum class FieldStream : std::uint32_t { size_order = 1, shape, position, copy, packing };

/// One convex counter-clockwise polygon of area 1, centred on its centroid: 4 to 7 sides in 99 of 100 cases, never more
/// than 12, random orientation, elongation up to 1.7, no short edges and no nearly straight corners.
std::vector<Vec2> random_shape(RandomSequence& numbers);

/// The same outline with `size` = sqrt(area) [m].
std::vector<Vec2> scaled(const std::vector<Vec2>& outline, double size);

}  // namespace gem
