// The rectangle of a generated field: exact areas by cutting convex outlines at its four sides.
#include "gem/field/generator/field_region.h"

#include <algorithm>

#include "gem/field/channel.h"
#include "gem/field/generator/convex_cut.h"
#include "gem/geometry/polygon.h"

namespace gem {

Box field_region(const SceneDef& scene) {
  const FloesDef& f = scene.floes;
  double half_width = 0.5 * f.width_m;
  if (scene.boundary.present) {
    const double at_start = channel_half_width(scene.boundary, f.start_x_m);
    const double at_end = channel_half_width(scene.boundary, f.start_x_m + f.length_m);
    half_width = std::min(half_width, std::max(at_start, at_end));
  }
  return {{f.start_x_m, -half_width}, {f.start_x_m + f.length_m, half_width}};
}

double area_within(const Box& box, const std::vector<Vec2>& outline) {
  LabelledPolygon part{outline, std::vector<int>(outline.size(), 0)};
  cut(part, {1.0, 0.0}, box.high.x, 0);
  cut(part, {-1.0, 0.0}, -box.low.x, 0);
  cut(part, {0.0, 1.0}, box.high.y, 0);
  cut(part, {0.0, -1.0}, -box.low.y, 0);
  return part.corner.size() < 3 ? 0.0 : polygon_moments(part.corner).area;
}

double free_area(const Box& box, const std::vector<std::vector<Vec2>>& obstacles) {
  const Vec2 size = box.high - box.low;
  double area = size.x * size.y;
  for (const auto& obstacle : obstacles) area -= area_within(box, obstacle);
  return area;
}

}  // namespace gem
