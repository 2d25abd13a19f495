// Free rows stand at the end of the field, and are taken in order.
#include "gem/field/floe_reserve.h"

#include <algorithm>

namespace gem {

void append_reserve(Bodies& bodies, const SceneDef& scene) {
  BodyDef none;
  none.thickness = 0.0;
  for (std::int64_t k = 0; k < scene.breakup.maximum_pieces; ++k) append(bodies, none);
}

std::size_t first_piece(const Bodies& bodies, const SceneDef& scene) {
  return bodies.count() - std::min(bodies.count(), static_cast<std::size_t>(scene.breakup.maximum_pieces));
}

std::size_t first_unborn(const Bodies& bodies) {
  const auto& begin = bodies.vertex_begin;
  const auto first = std::lower_bound(begin.begin(), begin.end(), begin.back()) - begin.begin();
  for (auto i = static_cast<std::size_t>(first); i < bodies.count(); ++i)
    if (is_unborn(bodies, i)) return i;
  return bodies.count();
}

std::size_t piece_corners_maximum(const SceneDef& scene) {
  return piece_corners_mean * static_cast<std::size_t>(scene.breakup.maximum_pieces);
}

}  // namespace gem
