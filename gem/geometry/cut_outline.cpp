// Walks around the outline: corners go to their side of the line, those on it to both.
#include "gem/geometry/cut_outline.h"

#include <algorithm>
#include <cmath>

namespace gem {

std::optional<OutlineCut> cut_outline(const std::vector<Vec2>& outline, Vec2 point, Vec2 along, double snap) {
  const std::size_t n = outline.size();
  std::vector<double> side(n);  // distance to the left of the line, 0 for corners on it
  for (std::size_t i = 0; i < n; ++i) {
    const double distance = cross(along, outline[i] - point);
    side[i] = std::fabs(distance) < snap ? 0.0 : distance;
  }
  OutlineCut cut;
  std::vector<double> ends;
  const auto on_line = [&](Vec2 corner) {
    cut.left.push_back(corner);
    cut.right.push_back(corner);
    ends.push_back(dot(along, corner - point));
  };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t next = (i + 1) % n;
    if (side[i] == 0.0) on_line(outline[i]);
    if (side[i] > 0.0) cut.left.push_back(outline[i]);
    if (side[i] < 0.0) cut.right.push_back(outline[i]);
    if (side[i] * side[next] < 0.0)
      on_line(outline[i] + (side[i] / (side[i] - side[next])) * (outline[next] - outline[i]));
  }
  if (ends.size() != 2 || cut.left.size() < 3 || cut.right.size() < 3) return std::nullopt;
  cut.length = std::fabs(ends[1] - ends[0]);
  return cut;
}

}  // namespace gem
