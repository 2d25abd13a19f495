// Ice concentration on a grid: the exact share of each cell's area that is covered by floes.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// Square cells that begin at `corner`, `columns` along x and `rows` along y.
struct Grid {
  Vec2 corner;         // lower left [m]
  double cell = 10.0;  // side [m]
  std::size_t columns = 1;
  std::size_t rows = 1;
};

/// Row by row from the corner. A share above 1 means that floes overlap.
struct Concentration {
  Grid grid;
  std::vector<double> share;

  double at(std::size_t column, std::size_t row) const { return share[row * grid.columns + column]; }
};

/// A convex floe: counter-clockwise outline about its centroid, position and angle.
struct PlacedFloe {
  std::span<const Vec2> outline;
  Vec2 position;
  double angle = 0.0;  // [rad]
};

/// Every floe is cut exactly at the cell borders. Parts outside the grid are left out. Throws std::invalid_argument for
/// a grid without cells.
Concentration concentration(std::span<const PlacedFloe> floes, const Grid& grid);

}  // namespace gem
