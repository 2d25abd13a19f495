// Turns the force of the ice on the platform into the axes of the path.
#include "gem/report/run/transit_record.h"

#include <cmath>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/moments.h"
#include "gem/report/run/run_data.h"
#include "gem/scene/scene_drive.h"

namespace gem {
namespace {

Vec2 direction(Rotation course) { return {course.cosine, course.sine}; }

/// Mean with the interval of one correlated record.
Finding mean_resistance(const std::vector<double>& resistance) {
  constexpr std::size_t stretches = 20;
  const double mean = moments(resistance).mean;
  if (resistance.size() < 2 * stretches) return {"resistance_mean_N", mean, {}};
  return {"resistance_mean_N", mean, moving_block_mean(resistance, resistance.size() / stretches)};
}

}  // namespace

TransitRecord transit_record(const PlatformRecord& platform, const SceneDef& scene) {
  TransitRecord transit;
  const TransitPath path = transit_path(scene);
  if (!path.present()) return transit;
  transit.speed = scene.transit.speed_m_per_s;
  for (std::size_t i = 0; i < platform.time.size(); ++i) {
    const double distance = transit.speed * platform.time[i];
    const Vec2 ahead = direction(path.at(distance).course);
    const Vec2 ice{platform.ice_force_x[i], platform.ice_force_y[i]};
    const Vec2 window{platform.ice_force_mean_x[i], platform.ice_force_mean_y[i]};
    transit.distance.push_back(distance);
    transit.resistance.push_back(-dot(ice, ahead));
    transit.resistance_window.push_back(-dot(window, ahead));
    transit.side_window.push_back(cross(ahead, window));
  }
  return transit;
}

std::vector<Finding> transit_findings(const TransitRecord& transit, std::size_t first) {
  if (first >= transit.distance.size()) return {};
  const auto from = [first](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + std::ptrdiff_t(first), all.end());
  };
  const std::vector<double> window = from(transit.resistance_window), side = from(transit.side_window);
  return {{"transit_distance_m", transit.distance.back() - transit.distance[first], {}},
          mean_resistance(from(transit.resistance)),
          {"resistance_window_deviation_N", moments(window).deviation, {}},
          {"resistance_window_p99_N", percentile(window, 0.99), {}},
          {"resistance_window_largest_N", moments(window).maximum, {}},
          {"side_force_window_largest_N", std::abs(maximum_excursion(side).value), {}}};
}

}  // namespace gem
