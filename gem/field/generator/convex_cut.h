// Cuts a convex polygon along a straight line, and remembers what made each edge.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// A convex counter-clockwise polygon. Edge i runs from corner i to the next one.
struct LabelledPolygon {
  std::vector<Vec2> corner;  // [m]
  std::vector<int> label;    // of each edge: who is on its other side
};

/// Keeps the part with dot(normal, p) <= bound. The new edge gets `label`. Nothing is left if all of it lies beyond.
inline void cut(LabelledPolygon& polygon, Vec2 normal, double bound, int label) {
  const std::size_t n = polygon.corner.size();
  LabelledPolygon kept;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = polygon.corner[i];
    const Vec2 b = polygon.corner[(i + 1) % n];
    const double beyond_a = dot(normal, a) - bound;
    const double beyond_b = dot(normal, b) - bound;
    if (beyond_a <= 0.0) {
      kept.corner.push_back(a);
      kept.label.push_back(polygon.label[i]);
    }
    if ((beyond_a <= 0.0) == (beyond_b <= 0.0)) continue;
    kept.corner.push_back(a + (beyond_a / (beyond_a - beyond_b)) * (b - a));
    kept.label.push_back(beyond_a <= 0.0 ? label : polygon.label[i]);
  }
  polygon = std::move(kept);
}

}  // namespace gem
