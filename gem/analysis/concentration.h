// Ice concentration on a grid: the exact share of each cell's area that floes cover.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// Square cells from `corner` on, `columns` along x and `rows` along y.
struct Grid {
  Vec2 corner;         // lower left [m]
  double cell = 10.0;  // side [m]
  std::size_t columns = 1;
  std::size_t rows = 1;
};

/// Row by row from the corner. A share above 1 tells of floes that overlap.
struct Concentration {
  Grid grid;
  std::vector<double> share;

  double at(std::size_t column, std::size_t row) const { return share[row * grid.columns + column]; }
};

/// A convex floe: outline about its centroid, counter-clockwise, and where it is.
struct PlacedFloe {
  std::span<const Vec2> outline;
  Vec2 position;
  double angle = 0.0;  // [rad]
};

/// Every floe is cut exactly at the cell borders; parts outside the grid are left out. Throws std::invalid_argument
/// for a grid without cells.
Concentration concentration(std::span<const PlacedFloe> floes, const Grid& grid);

}  // namespace gem
