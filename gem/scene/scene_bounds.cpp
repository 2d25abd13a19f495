// Bounds on speeds and widths, for the check of the time step.
#include "gem/scene/scene_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/base/strict_math.h"
#include "gem/geometry/polygon.h"
#include "gem/scene/platform_shape.h"
#include "gem/scene/scene_drive.h"
#include "gem/scene/scene_mooring.h"

namespace gem {
namespace {

/// Smallest distance between two parallel lines that enclose the outline [m]. Skips repeated corners; the checks of the
/// field report them.
double outline_width(const std::vector<Vec2>& outline) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 edge = outline[(i + 1) % outline.size()] - outline[i];
    if (dot(edge, edge) == 0.0) continue;
    double low = 0.0;
    double high = 0.0;
    for (const Vec2 p : outline) {
      const double side = cross(edge, p - outline[i]) / length(edge);
      low = std::min(low, side);
      high = std::max(high, side);
    }
    if (high > low) smallest = std::min(smallest, high - low);
  }
  return smallest;
}

/// Fastest turn of the current's direction between the rows of its table [rad/s].
double turn_of_current(const std::vector<TimeRow>& direction) {
  double turn = 0.0;
  for (std::size_t k = 1; k < direction.size(); ++k)
    if (direction[k][0] > direction[k - 1][0])
      turn = std::max(turn, std::abs(direction[k][2] - direction[k - 1][2]) / (direction[k][0] - direction[k - 1][0]));
  return turn;
}

/// Largest rate at which the heading control turns a platform from rest [rad/s]: that of a swing from the start to the
/// current's direction, or of half a turn where the current turns back, and that of the current. Damping bounds it too.
double heading_rate(const SceneDef& scene) {
  const PlatformDef& p = scene.platform;
  const HeadingDef& heading = scene.heading;
  const double inertia = platform_inertia(p);
  if (!(heading.moment_N_m > 0.0 && inertia > 0.0) || p.yaw == Yaw::locked) return 0.0;
  const double work = current_turns_back(scene)
                          ? half_turn_work
                          : heading_work(strict::rotation_of_angle(p.start_yaw_rad), drive_at_start(scene).water);
  const double rate =
      std::sqrt(2.0 * work * heading.moment_N_m / inertia) + turn_of_current(scene.drive.current_direction);
  return heading.damping_N_m_s > 0.0 ? std::min(rate, heading.moment_N_m / heading.damping_N_m_s) : rate;
}

/// Largest speed of the platform's rim by which the thrusters bring it from the start to its set point [m/s]. As a
/// spring without damping would; the drift turns its set point.
double dp_speed(const SceneDef& scene) {
  const PlatformDef& p = scene.platform;
  const double inertia = platform_inertia(p);
  if (scene.dp.thruster.empty() || !(inertia > 0.0)) return 0.0;
  const DpInertia moved = dp_inertia(p.mass_kg, inertia, scene.added_mass);
  const std::array<DpGain, 3> gains = dp_gains(scene.dp, moved);
  const double fastest = std::sqrt(std::max(gains[0].proportional, gains[1].proportional) / p.mass_kg);
  const DpLaw law = dp_law(scene.dp, moved, scene.numerics.time_step_s);
  const double yaw =
      std::abs(dp_yaw_error(law, strict::rotation_of_angle(p.start_yaw_rad), drive_at_start(scene).water));
  const double turn = law.follows ? turn_of_current(scene.drive.current_direction) : 0.0;
  const double rate = std::sqrt(gains[2].proportional / inertia) * yaw + turn;
  return fastest * length(p.anchor_m + p.start_offset_m - scene.dp.position_m) + platform_radius(p) * rate;
}

/// Largest speed of a point of a ship in transit [m/s]. At way points it turns; one that runs free goes with the water.
double transit_speed(const SceneDef& scene) {
  const TransitDef& transit = scene.transit;
  if (runs_free(transit))
    return std::max(transit.speed_m_per_s, transit.open_water_speed_m_per_s + largest_current(scene));
  if (transit.way_point_m.size() < 2) return transit.speed_m_per_s;
  return transit.speed_m_per_s * (1.0 + platform_radius(scene.platform) / transit.turn_radius_m);
}

}  // namespace

double rim_speed(const FloeDef& floe) {
  if (floe.spin_rad_per_s == 0.0 || floe.outline_m.empty()) return 0.0;
  const Vec2 centroid = polygon_moments(floe.outline_m).centroid;
  double radius = 0.0;
  for (const Vec2 corner : floe.outline_m) radius = std::max(radius, length(corner - centroid));
  return radius * std::abs(floe.spin_rad_per_s);
}

double platform_speed_bound(const SceneDef& scene) {
  if (!scene.platform.present || scene.platform.fixed) return 0.0;
  const double swing = mooring_swing_speed(scene);
  const double rim =
      platform_radius(scene.platform) * (std::abs(scene.platform.start_spin_rad_per_s) + heading_rate(scene));
  return std::hypot(length(scene.platform.start_velocity_m_per_s), swing) + rim + platform_wind_speed(scene) +
         dp_speed(scene) + transit_speed(scene);
}

double closing_speed_bound(const SceneDef& scene) {
  auto [low, high] = drive_velocities(scene);
  double fastest_rim = 0.0, next_rim = 0.0;
  for (const FloeDef& floe : scene.floe) {
    low = {std::min(low.x, floe.velocity_m_per_s.x), std::min(low.y, floe.velocity_m_per_s.y)};
    high = {std::max(high.x, floe.velocity_m_per_s.x), std::max(high.y, floe.velocity_m_per_s.y)};
    const double rim = rim_speed(floe);
    next_rim = std::max(next_rim, std::min(rim, fastest_rim));
    fastest_rim = std::max(fastest_rim, rim);
  }
  return length(high - low) + fastest_rim + next_rim + platform_speed_bound(scene);
}

double fastest_point(const SceneDef& scene) {
  constexpr double slowest_of_interest = 1e-3;  // [m/s]; chosen by hand, the scale of a scene at rest
  double fastest = std::max(slowest_of_interest, drive_speed(scene));
  for (const FloeDef& floe : scene.floe) fastest = std::max(fastest, length(floe.velocity_m_per_s) + rim_speed(floe));
  return std::max(fastest, platform_speed_bound(scene));
}

double speed_foreseen(const SceneDef& scene) {
  if (scene.contact.solver == ContactSolver::compliant) return scene.numerics.contact_reach * fastest_point(scene);
  if (scene.contact.solver != ContactSolver::coupled || scene.contact.manifold != Manifold::chord_ends) return 0.0;
  return scene.numerics.contact_reach * fastest_point(scene);
}

double smallest_floe_width(const SceneDef& scene) {
  double smallest = std::numeric_limits<double>::infinity();
  const FloesDef& floes = scene.floes;
  const bool made = floes.source == FloeSource::generated || floes.source == FloeSource::copied;
  if (made && (floes.count > 0 || floes.concentration > 0.0)) smallest = floes.size_minimum_m;
  for (const FloeDef& floe : scene.floe) smallest = std::min(smallest, outline_width(floe.outline_m));
  if (scene.breakup.maximum_pieces > 0) smallest = std::min(smallest, scene.breakup.minimum_size_m);
  return smallest;
}

double longest_unseen_step(const SceneDef& scene, double foreseen) {
  const double unseen = closing_speed_bound(scene) - foreseen;
  return unseen > 0.0 ? 0.1 * smallest_floe_width(scene) / unseen : std::numeric_limits<double>::infinity();
}

}  // namespace gem
