// Compares the distances to all sides, then their normals.
#include "gem/geometry/outline_side.h"

#include <algorithm>
#include <limits>

namespace gem {
namespace {

double distance_to(Vec2 begin, Vec2 edge, Vec2 point) {
  const double along = std::clamp(dot(point - begin, edge) / dot(edge, edge), 0.0, 1.0);
  return length(point - (begin + along * edge));
}

}  // namespace

std::size_t side_of(const std::vector<Vec2>& outline, Vec2 point, Vec2 normal) {
  const std::size_t n = outline.size();
  const auto edge = [&](std::size_t k) { return outline[(k + 1) % n] - outline[k]; };
  double nearest = std::numeric_limits<double>::infinity(), radius = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    nearest = std::min(nearest, distance_to(outline[k], edge(k), point));
    radius = std::max(radius, length(outline[k]));
  }
  std::size_t best = 0;
  double facing = -2.0;
  for (std::size_t k = 0; k < n; ++k) {
    if (distance_to(outline[k], edge(k), point) > nearest + 0.01 * radius) continue;
    const double cosine = dot(turned_right(edge(k)), normal) / length(edge(k));
    if (cosine > facing) facing = cosine, best = k;
  }
  return best;
}

}  // namespace gem
