// How the rows of a front are divided among the threads of a warp. A thread takes a part of a chunk of the columns
// (FrontFactor): two bodies, so 18 numbers for the three rows of a body.
#pragma once

#include <cstdint>

#include "gem/base/macros.h"
#include "gem/engine/solver/splitting/factor/dissection_rules.h"

namespace gem {

/// Numbers of a thread in one pass.
constexpr std::int32_t tile_numbers = 9 * part_bodies;

/// The tiles of one front.
struct TileShape {
  std::int32_t tiles, bodies;  // bodies (three rows each) of a tile
  std::int32_t lanes, shift;   // threads of a body: two to the power of `shift`
  std::int32_t passes;         // until the lanes have taken all columns
  std::int32_t warp;

  GEM_HD std::int64_t numbers_of_tile() const { return std::int64_t{passes} * tile_numbers * warp; }
  GEM_HD std::int64_t numbers() const { return tiles * numbers_of_tile(); }
  /// Bodies of tile `k` of a front with rows for `all` bodies.
  GEM_HD std::int32_t bodies_of(std::int32_t k, std::int32_t all) const {
    return all - k * bodies < bodies ? all - k * bodies : bodies;
  }
};

/// `rows`, `columns`: bodies. `warp`: its threads, a power of two, four at least.
GEM_HD inline TileShape tile_shape(std::int32_t rows, std::int32_t columns, std::int32_t warp) {
  const std::int32_t parts = (columns + chunk_bodies - 1) / chunk_bodies * 4;
  std::int32_t lanes = 4, shift = 2;
  while (lanes < parts && lanes < warp) lanes *= 2, ++shift;
  const std::int32_t bodies = warp / lanes;
  return {(rows + bodies - 1) / bodies, bodies, lanes, shift, (parts + lanes - 1) / lanes, warp};
}

}  // namespace gem
