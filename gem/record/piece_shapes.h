// The rows of /shape of pieces that were made in a run.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "gem/field/bodies.h"

namespace gem {

/// Rows of consecutive pieces, as the columns of the same name.
struct PieceShapes {
  std::size_t first_floe = 0, first_vertex = 0;  // floe and corner of the first piece
  std::vector<double> vertex_xy, vertex_count, area, thickness, mass, inertia, ice_class;

  /// Adds the row of body `piece`, which follows that of the last one.
  void add(const Bodies& bodies, std::size_t piece);
  /// The columns with one value for each piece.
  std::vector<std::pair<std::string, const std::vector<double>*>> columns() const;
};

/// All pieces that were made, of the rows from `first` on.
PieceShapes pieces_of(const Bodies& bodies, std::size_t first);

}  // namespace gem
