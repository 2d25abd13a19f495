// Power diagrams by cutting the region with the bisectors of near sites.
//
//   for each site: start with the whole region
//     visit the sites ring by ring of a grid; cut with each bisector that reaches the cell
//     stop when no site farther away can reach it
//     cut off the obstacles
#include "gem/field/generator/power_diagram.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "gem/geometry/polygon.h"

namespace gem {
namespace {

/// Sites in the squares of a grid, in index order within a square.
class SiteGrid {
 public:
  SiteGrid(const std::vector<Vec2>& sites, const Box& box) : low_(box.low) {
    const Vec2 size = box.high - box.low;
    step_ = std::max(std::sqrt(2.0 * size.x * size.y / static_cast<double>(sites.size())),
                     std::max(size.x, size.y) / 2000.0);
    columns_ = static_cast<int>(size.x / step_) + 1;
    rows_ = static_cast<int>(size.y / step_) + 1;
    squares_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (std::size_t i = 0; i < sites.size(); ++i) squares_[square(column(sites[i]), row(sites[i]))].push_back(i);
  }

  double step() const { return step_; }
  int rings() const { return std::max(columns_, rows_); }

  /// Visits the sites whose square is `ring` squares away from that of `p`.
  template <class Visit>
  void for_ring(Vec2 p, int ring, Visit&& visit) const {
    const int c = column(p);
    const int r = row(p);
    for (int y = std::max(0, r - ring); y <= std::min(rows_ - 1, r + ring); ++y) {
      const bool whole_row = y == r - ring || y == r + ring;
      const int stride = whole_row || ring == 0 ? 1 : 2 * ring;
      for (int x = c - ring; x <= c + ring; x += stride)
        if (x >= 0 && x < columns_)
          for (const std::size_t i : squares_[square(x, y)]) visit(i);
    }
  }

 private:
  int column(Vec2 p) const { return std::clamp(static_cast<int>((p.x - low_.x) / step_), 0, columns_ - 1); }
  int row(Vec2 p) const { return std::clamp(static_cast<int>((p.y - low_.y) / step_), 0, rows_ - 1); }
  std::size_t square(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }

  Vec2 low_;
  double step_ = 1.0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::vector<std::size_t>> squares_;
};

double farthest_corner(const LabelledPolygon& cell, Vec2 from) {
  double farthest = 0.0;
  for (const Vec2 p : cell.corner) farthest = std::max(farthest, length(p - from));
  return farthest;
}

LabelledPolygon rectangle(const Box& box) {
  return {{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}},
          {wall_label, wall_label, wall_label, wall_label}};
}

/// Cuts the cell of site i with the bisectors of all sites that can reach it.
LabelledPolygon bounded_cell(const PowerSites& sites, std::size_t i, const SiteGrid& grid, const Box& box,
                             double largest_weight) {
  LabelledPolygon cell = rectangle(box);
  const Vec2 centre = sites.position[i];
  double radius = farthest_corner(cell, centre);
  for (int ring = 0; ring <= grid.rings(); ++ring) {
    // Sites of this ring are at least this far away; a bisector reaches the cell only from a distance below `reach`.
    const double nearest = (ring - 1) * grid.step();
    const double reach = radius + std::sqrt(std::max(0.0, radius * radius + largest_weight - sites.weight[i]));
    if (nearest > reach) break;
    grid.for_ring(centre, ring, [&](std::size_t j) {
      if (j == i || cell.corner.empty()) return;
      const Vec2 apart = sites.position[j] - centre;
      const double distance = length(apart);
      if (distance == 0.0) return;
      const double at = 0.5 * (distance * distance + sites.weight[i] - sites.weight[j]) / distance;
      if (at >= radius) return;
      const Vec2 normal = (1.0 / distance) * apart;
      cut(cell, normal, dot(normal, centre) + at, static_cast<int>(j));
      radius = farthest_corner(cell, centre);
    });
  }
  return cell;
}

void cut_off(LabelledPolygon& cell, const std::vector<Vec2>& obstacle) {
  LabelledPolygon best;
  double most = -1.0;
  for (std::size_t e = 0; e < obstacle.size(); ++e) {
    const Vec2 outward = turned_right(obstacle[(e + 1) % obstacle.size()] - obstacle[e]);
    const double bound = dot(outward, obstacle[e]);
    LabelledPolygon kept = cell;
    cut(kept, -outward, -bound, wall_label);
    if (kept.corner.size() == cell.corner.size() && kept.label == cell.label &&
        polygon_moments(kept.corner).area >= polygon_moments(cell.corner).area)
      return;  // the whole cell lies on the free side of this edge
    const double area = kept.corner.size() < 3 ? 0.0 : polygon_moments(kept.corner).area;
    if (area <= most) continue;
    most = area;
    best = std::move(kept);
  }
  cell = std::move(best);
}

}  // namespace

std::vector<LabelledPolygon> power_diagram(const PowerSites& sites, const MosaicRegion& region) {
  std::vector<LabelledPolygon> cells;
  if (sites.position.empty()) return cells;
  const SiteGrid grid(sites.position, region.box);
  const double largest_weight = *std::max_element(sites.weight.begin(), sites.weight.end());
  std::vector<Box> boxes;
  for (const auto& obstacle : region.obstacles) boxes.push_back(box_of(obstacle));
  for (std::size_t i = 0; i < sites.position.size(); ++i) {
    LabelledPolygon cell = bounded_cell(sites, i, grid, region.box, largest_weight);
    for (std::size_t o = 0; o < boxes.size() && !cell.corner.empty(); ++o)
      if (box_of(cell.corner).meets(boxes[o])) cut_off(cell, region.obstacles[o]);
    if (cell.corner.size() < 3) cell = {};
    cells.push_back(std::move(cell));
  }
  return cells;
}

}  // namespace gem
