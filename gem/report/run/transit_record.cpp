// Turns the force of the ice on the platform into the axes of the path.
#include "gem/report/run/transit_record.h"

#include <cmath>

#include "gem/analysis/statistics/moments.h"
#include "gem/analysis/statistics/record_mean.h"
#include "gem/report/run/run_data.h"
#include "gem/scene/scene_drive.h"

namespace gem {
namespace {

Vec2 direction(Rotation course) { return {course.cosine, course.sine}; }

/// The speed of a ship that runs free; `distance` from its start.
void add_speed(TransitRecord& transit, double time, double distance) {
  const bool first = transit.time.size() == 1;
  const double before = first ? 0.0 : transit.time[transit.time.size() - 2];
  const double from = first ? 0.0 : transit.distance[transit.distance.size() - 2];
  transit.made_good.push_back(time > before ? (distance - from) / (time - before) : transit.speed);
}

}  // namespace

TransitRecord transit_record(const PlatformRecord& platform, const SceneDef& scene) {
  TransitRecord transit;
  const TransitPath path = transit_path(scene);
  if (!path.present()) return transit;
  transit.present = true;
  transit.free = runs_free(scene.transit);
  transit.speed = scene.transit.speed_m_per_s;
  for (std::size_t i = 0; i < platform.time.size(); ++i) {
    const Vec2 way = Vec2{platform.x[i], platform.y[i]} - path.at(0.0).place;
    const double distance = transit.free ? dot(way, direction(path.at(0.0).course)) : transit.speed * platform.time[i];
    const Vec2 ahead = direction(path.at(distance).course);
    const Vec2 ice{platform.ice_force_x[i], platform.ice_force_y[i]};
    const Vec2 window{platform.ice_force_mean_x[i], platform.ice_force_mean_y[i]};
    transit.time.push_back(platform.time[i]);
    transit.distance.push_back(distance);
    if (transit.free) add_speed(transit, platform.time[i], distance);
    const Vec2 holder{platform.mooring_force_x[i], platform.mooring_force_y[i]};
    transit.pull.push_back(dot(holder, ahead));
    transit.across.push_back(cross(ahead, holder));
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
  const std::vector<double> pull = from(transit.pull), across = from(transit.across);
  std::vector<Finding> findings = {{"transit_distance_m", transit.distance.back() - transit.distance[first], {}},
                                   mean_of("resistance_mean_N", from(transit.resistance)),
                                   {"resistance_window_deviation_N", moments(window).deviation, {}},
                                   {"resistance_window_p99_N", percentile(window, 0.99), {}},
                                   {"resistance_window_largest_N", moments(window).maximum, {}},
                                   {"side_force_window_largest_N", std::abs(maximum_excursion(side).value), {}},
                                   mean_of(transit.free ? "thrust_mean_N" : "tow_mean_N", pull),
                                   {transit.free ? "thrust_largest_N" : "tow_largest_N", moments(pull).maximum, {}},
                                   {"hold_across_largest_N", std::abs(maximum_excursion(across).value), {}}};
  if (!transit.free) return findings;
  const std::vector<double> speed = from(transit.made_good);
  findings.push_back(mean_of("transit_speed_mean_m_per_s", speed));
  findings.push_back({"transit_speed_least_m_per_s", moments(speed).minimum, {}});
  return findings;
}

}  // namespace gem
