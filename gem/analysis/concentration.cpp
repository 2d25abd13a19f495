// Cuts convex outlines into columns, then into cells.
#include "gem/analysis/concentration.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gem {
namespace {

using Corners = std::vector<Vec2>;

/// The part of a convex outline where dot(normal, point) <= limit (Sutherland and Hodgman 1974).
Corners cut(const Corners& outline, Vec2 normal, double limit) {
  Corners kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 here = outline[i];
    const Vec2 next = outline[(i + 1) % outline.size()];
    const double beyond_here = dot(normal, here) - limit;
    const double beyond_next = dot(normal, next) - limit;
    if (beyond_here <= 0.0) kept.push_back(here);
    if ((beyond_here < 0.0 && beyond_next > 0.0) || (beyond_here > 0.0 && beyond_next < 0.0))
      kept.push_back(here + (beyond_here / (beyond_here - beyond_next)) * (next - here));
  }
  return kept;
}

double area_of(const Corners& outline) {
  double twice = 0.0;
  for (std::size_t i = 1; i + 1 < outline.size(); ++i)
    twice += cross(outline[i] - outline[0], outline[i + 1] - outline[0]);
  return 0.5 * twice;
}

Corners corners_of(const PlacedFloe& floe) {
  const Rotation rotation{std::cos(floe.angle), std::sin(floe.angle)};
  Corners corners;
  for (const Vec2 corner : floe.outline) corners.push_back(floe.position + rotate(rotation, corner));
  return corners;
}

struct CellRange {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// The cells that an interval from low to high meets, of `count` cells that begin at `start`.
CellRange cells_within(double low, double high, double start, double cell, std::size_t count) {
  const auto limit = static_cast<double>(count);
  const double first = std::clamp(std::floor((low - start) / cell), 0.0, limit);
  const double last = std::clamp(std::floor((high - start) / cell) + 1.0, 0.0, limit);
  return {static_cast<std::size_t>(first), static_cast<std::size_t>(std::max(first, last))};
}

/// Adds the area of a strip in each cell of a column.
void add_strip(Concentration& map, const Corners& strip, std::size_t column) {
  if (strip.size() < 3) return;
  const Grid& grid = map.grid;
  const auto [lowest, highest] =
      std::minmax_element(strip.begin(), strip.end(), [](Vec2 a, Vec2 b) { return a.y < b.y; });
  const CellRange rows = cells_within(lowest->y, highest->y, grid.corner.y, grid.cell, grid.rows);
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    const double low = grid.corner.y + grid.cell * static_cast<double>(row);
    const Corners part = cut(cut(strip, {0.0, -1.0}, -low), {0.0, 1.0}, low + grid.cell);
    map.share[row * grid.columns + column] += area_of(part) / (grid.cell * grid.cell);
  }
}

}  // namespace

Concentration concentration(std::span<const PlacedFloe> floes, const Grid& grid) {
  if (grid.columns == 0 || grid.rows == 0 || !(grid.cell > 0.0))
    throw std::invalid_argument("a concentration map needs cells of positive size");
  Concentration map{grid, std::vector<double>(grid.columns * grid.rows, 0.0)};
  for (const PlacedFloe& floe : floes) {
    const Corners corners = corners_of(floe);
    if (corners.size() < 3) continue;
    const auto [leftmost, rightmost] =
        std::minmax_element(corners.begin(), corners.end(), [](Vec2 a, Vec2 b) { return a.x < b.x; });
    const CellRange columns = cells_within(leftmost->x, rightmost->x, grid.corner.x, grid.cell, grid.columns);
    for (std::size_t column = columns.begin; column < columns.end; ++column) {
      const double low = grid.corner.x + grid.cell * static_cast<double>(column);
      add_strip(map, cut(cut(corners, {-1.0, 0.0}, -low), {1.0, 0.0}, low + grid.cell), column);
    }
  }
  return map;
}

}  // namespace gem
