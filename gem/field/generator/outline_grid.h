// A uniform grid over outlines, to find those near a box.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// Axis-parallel box [m].
struct Box {
  Vec2 low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  void add(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  void grow(double margin) {
    low -= {margin, margin};
    high += {margin, margin};
  }
  bool meets(const Box& other) const {
    return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y && other.low.y <= high.y;
  }
};

inline Box box_of(const std::vector<Vec2>& outline) {
  Box box;
  for (const Vec2 p : outline) box.add(p);
  return box;
}

/// Boxes stored in the cells that they cover. A box outside the domain goes to the outermost cells.
class OutlineGrid {
 public:
  /// Cell size in m; enlarged if the grid would have millions of cells.
  OutlineGrid(const Box& domain, double cell) : low_(domain.low) {
    const Vec2 size = domain.high - domain.low;
    inverse_cell_ = 1.0 / std::max({cell, std::sqrt(size.x * size.y / 2e6), size.x / 1e5, size.y / 1e5});
    columns_ = cells_along(size.x);
    rows_ = cells_along(size.y);
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
  }

  void insert(std::size_t id, const Box& box) {
    if (boxes_.size() <= id) boxes_.resize(id + 1);
    boxes_[id] = box;
    for_each_cell(box, [&](std::size_t c) {
      cells_[c].push_back(id);
      return true;
    });
  }

  /// Calls visit(id) for every stored box that meets `box`, possibly more than once. Stops when visit returns false.
  template <class Visit>
  bool for_each_near(const Box& box, Visit&& visit) const {
    return for_each_cell(box, [&](std::size_t c) {
      for (const std::size_t id : cells_[c])
        if (boxes_[id].meets(box) && !visit(id)) return false;
      return true;
    });
  }

 private:
  int cells_along(double size) const { return std::max(1, static_cast<int>(std::ceil(size * inverse_cell_))); }
  int cell_of(double x, double low, int count) const {
    return static_cast<int>(std::clamp(std::floor((x - low) * inverse_cell_), 0.0, static_cast<double>(count - 1)));
  }
  template <class Visit>
  bool for_each_cell(const Box& box, Visit&& visit) const {
    const int first_column = cell_of(box.low.x, low_.x, columns_);
    const int last_column = cell_of(box.high.x, low_.x, columns_);
    const int last_row = cell_of(box.high.y, low_.y, rows_);
    for (int row = cell_of(box.low.y, low_.y, rows_); row <= last_row; ++row)
      for (int column = first_column; column <= last_column; ++column)
        if (!visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(column)))
          return false;
    return true;
  }

  Vec2 low_;
  double inverse_cell_;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::vector<std::size_t>> cells_;
  std::vector<Box> boxes_;
};

}  // namespace gem
