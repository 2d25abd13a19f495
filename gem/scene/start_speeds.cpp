#include "gem/scene/start_speeds.h"

#include <algorithm>
#include <cmath>

#include "gem/geometry/polygon.h"

namespace gem {

double rim_speed(const FloeDef& floe) {
  if (floe.spin_rad_per_s == 0.0 || floe.outline_m.empty()) return 0.0;
  const Vec2 centroid = polygon_moments(floe.outline_m).centroid;
  double radius = 0.0;
  for (const Vec2 corner : floe.outline_m) radius = std::max(radius, length(corner - centroid));
  return radius * std::abs(floe.spin_rad_per_s);
}

double closing_speed_bound(const SceneDef& scene) {
  Vec2 low = {std::min(0.0, scene.current.velocity_m_per_s.x), std::min(0.0, scene.current.velocity_m_per_s.y)};
  Vec2 high = {std::max(0.0, scene.current.velocity_m_per_s.x), std::max(0.0, scene.current.velocity_m_per_s.y)};
  double fastest_rim = 0.0, next_rim = 0.0;
  for (const FloeDef& floe : scene.floe) {
    low = {std::min(low.x, floe.velocity_m_per_s.x), std::min(low.y, floe.velocity_m_per_s.y)};
    high = {std::max(high.x, floe.velocity_m_per_s.x), std::max(high.y, floe.velocity_m_per_s.y)};
    const double rim = rim_speed(floe);
    next_rim = std::max(next_rim, std::min(rim, fastest_rim));
    fastest_rim = std::max(fastest_rim, rim);
  }
  return length(high - low) + fastest_rim + next_rim;
}

}  // namespace gem
