// Rows for floes that do not exist yet: pieces of floes that split during a run.
#pragma once

#include <cstddef>

#include "gem/field/bodies.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Most corners of all pieces together, over the number of pieces. A floe of n corners gives pieces with n + 4
/// together.
inline constexpr std::size_t piece_corners_mean = 10;

/// Appends the rows of the pieces that a scene allows: floes without outline and mass that take no part.
void append_reserve(Bodies& bodies, const SceneDef& scene);

/// First body that is a piece, made or not.
std::size_t first_piece(const Bodies& bodies, const SceneDef& scene);

/// First body whose row is still free; count() if there is none.
std::size_t first_unborn(const Bodies& bodies);

/// Whether body i is a row for a piece that was not made.
inline bool is_unborn(const Bodies& bodies, std::size_t i) {
  return bodies.kind[i] == BodyKind::floe && bodies.vertex_count(i) == 0;
}

/// Corners that the pieces of a scene may have together.
std::size_t piece_corners_maximum(const SceneDef& scene);

}  // namespace gem
