// Bounds on current and wind over a run, from the rows of their tables.
#include "gem/scene/scene_drive.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/scene/scene_mooring.h"

namespace gem {
namespace {

/// Parts of a stretch between two rows at which a table of directions is looked at. Chosen by hand: of a quarter turn
/// between two rows they miss 3e-4.
constexpr int parts_of_stretch = 32;

/// Largest speed of a table, which is linear between its rows [m/s].
double fastest_row(const std::vector<TimeRow>& velocity, const std::vector<TimeRow>& direction, Vec2 steady) {
  double fastest = velocity.empty() && direction.empty() ? length(steady) : 0.0;
  for (const TimeRow& row : velocity) fastest = std::max(fastest, length({row[1], row[2]}));
  if (velocity.empty())
    for (const TimeRow& row : direction) fastest = std::max(fastest, std::abs(row[1]));
  return fastest;
}

/// Sum of the amplitudes of the tide in x and y [m/s].
Vec2 tide_reach(const SceneDef& scene) {
  Vec2 sum;
  for (const TideRow& row : scene.drive.tide) sum += {std::abs(row[1]), std::abs(row[3])};
  return sum;
}

/// Stiffness that the thrusters give to surge and sway, the smaller one [N/m].
double dp_stiffness(const SceneDef& scene) {
  if (scene.dp.thruster.empty()) return 0.0;
  const std::array<DpGain, 3> gains = dp_gains(scene.dp, dp_inertia(scene.platform.mass_kg, 1.0, scene.added_mass));
  return std::min(gains[0].proportional, gains[1].proportional);
}

/// Thrust that surely acts in any direction: that of the thrusters that turn [N].
double dp_thrust(const SceneDef& scene) {
  double sum = 0.0;
  for (const ThrusterDef& one : scene.dp.thruster)
    if (one.kind == ThrusterKind::azimuth) sum += one.maximum_N;
  return sum;
}

/// Speed that the wind gives to a platform whose thrusters are at their limit [m/s]: until the wind over the moving
/// platform pushes as hard as they do, or until the run ends.
double speed_beyond_thrust(const SceneDef& scene, double wind, double rate) {
  const double held = dp_thrust(scene) / scene.platform.mass_kg;
  if (scene.dp.thruster.empty() || rate * wind * wind <= held) return 0.0;
  return std::min(wind - std::sqrt(held / rate), (rate * wind * wind - held) * scene.run.duration_s);
}

/// Times at which the current without tide is looked at: its table is nowhere outside what it is there.
std::vector<double> times_of_current(const DriveDef& drive) {
  const std::vector<TimeRow>& table = drive.current_velocity.empty() ? drive.current_direction : drive.current_velocity;
  std::vector<double> times = {0.0};
  for (std::size_t k = 0; k < table.size(); ++k)
    for (int part = 0; part < parts_of_stretch && (part == 0 || k + 1 < table.size()); ++part)
      times.push_back(table[k][0] + (part == 0 ? 0.0 : part * (table[k + 1][0] - table[k][0]) / parts_of_stretch));
  return times;
}

/// Wind factor: largest speed through the water over the wind that a floe feels [-]. A floe of any size lies between
/// the ratio of the skin drags and that of the form drags.
double wind_factor(const SceneDef& s) {
  const double density = s.wind.density_kg_per_m3 / s.water.density_kg_per_m3;
  const double freeboard = s.water.density_kg_per_m3 / s.ice.density_kg_per_m3 - 1.0;  // over the draft
  const auto ratio = [](double air, double water) {
    return air > 0.0 ? (water > 0.0 ? air / water : std::numeric_limits<double>::infinity()) : 0.0;
  };
  const double skin = ratio(s.wind.skin_coefficient, s.water.skin_coefficient);
  const double form = ratio(s.wind.form_coefficient * freeboard, s.water.form_coefficient);
  return std::sqrt(density * std::max(skin, form) / turning_of(s.water.turning_rad).cosine);
}

/// Largest speed through the water that the wind gives to a floe [m/s].
double wind_drift(const SceneDef& scene) {
  if (!has_wind(scene)) return 0.0;
  const double felt = largest_wind(scene) + largest_current(scene);
  return std::min(felt, wind_factor(scene) * felt);
}

}  // namespace

DriveSchedule drive_schedule(const SceneDef& scene) {
  return {scene.drive, steady_drive(scene), scene.numerics.time_step_s, transit_path(scene)};
}

TransitPath transit_path(const SceneDef& scene) {
  const PlatformDef& p = scene.platform;
  if (!p.present || p.fixed) return {};
  return {scene.transit, p.anchor_m + p.start_offset_m, p.start_yaw_rad};
}

ThrustLaw transit_thrust(const SceneDef& scene, double mass) {
  const TransitPath path = transit_path(scene);
  if (!path.present()) return {};
  const Rotation course = path.at(0.0).course;
  return thrust_law(scene.transit, {course.cosine, course.sine}, mass, scene.numerics.time_step_s);
}

Drive drive_at_start(const SceneDef& scene) {
  return drive_at(scene.drive, steady_drive(scene), scene.drive.start_time_s);
}

bool has_wind(const SceneDef& scene) { return largest_wind(scene) > 0.0; }

double largest_current(const SceneDef& scene) {
  const DriveDef& drive = scene.drive;
  const double fastest = fastest_row(drive.current_velocity, drive.current_direction, scene.current.velocity_m_per_s);
  return drive.tide.empty() ? fastest : fastest + length(tide_reach(scene));
}

bool current_turns_back(const SceneDef& scene) {
  const DriveDef& drive = scene.drive;
  double slowest = std::numeric_limits<double>::infinity();
  bool back = false;
  for (std::size_t k = 0; k < drive.current_velocity.size(); ++k) {
    const Vec2 here{drive.current_velocity[k][1], drive.current_velocity[k][2]};
    slowest = std::min(slowest, length(here));
    if (k == 0) continue;
    back = back || dot({drive.current_velocity[k - 1][1], drive.current_velocity[k - 1][2]}, here) <= 0.0;
  }
  for (std::size_t k = 0; k < drive.current_direction.size(); ++k) {
    slowest = std::min(slowest, std::abs(drive.current_direction[k][1]));
    back = back || (k > 0 && drive.current_direction[k - 1][1] * drive.current_direction[k][1] < 0.0);
  }
  if (drive.current_velocity.empty() && drive.current_direction.empty())
    slowest = length(scene.current.velocity_m_per_s);
  return back || (!drive.tide.empty() && length(tide_reach(scene)) >= slowest);
}

double largest_wind(const SceneDef& scene) {
  return fastest_row(scene.drive.wind_velocity, scene.drive.wind_direction, scene.wind.velocity_m_per_s);
}

double drive_speed(const SceneDef& scene) {
  return has_wind(scene) ? largest_current(scene) + wind_drift(scene) : largest_current(scene);
}

VelocityBox drive_velocities(const SceneDef& scene) {
  DriveDef table = scene.drive;
  table.tide.clear();
  const double drift = wind_drift(scene);
  const Vec2 more = tide_reach(scene) + Vec2{drift, drift};
  VelocityBox box;
  for (const double time : times_of_current(scene.drive)) {
    const Vec2 water = drive_at(table, steady_drive(scene), time).water;
    const Vec2 low = water - more, high = water + more;
    box.low = {std::min(box.low.x, low.x), std::min(box.low.y, low.y)};
    box.high = {std::max(box.high.x, high.x), std::max(box.high.y, high.y)};
  }
  return box;
}

double platform_wind_speed(const SceneDef& scene) {
  const PlatformDef& p = scene.platform;
  if (!p.present || p.fixed || !has_wind(scene) || scene.wind.platform_area_m2 == 0.0) return 0.0;
  const double wind = largest_wind(scene), rate = platform_wind_rate(scene.wind, p.mass_kg);
  if (scene.mooring.law != MooringLaw::linear)
    return std::min(wind, mooring_pushed_speed(scene, rate * p.mass_kg * wind * wind));
  const double stiffness = scene.mooring.stiffness_N_per_m + dp_stiffness(scene);
  if (stiffness == 0.0) return wind;
  const double beyond = scene.mooring.stiffness_N_per_m > 0.0 ? 0.0 : speed_beyond_thrust(scene, wind, rate);
  return std::min(wind, rate * wind * wind / std::sqrt(stiffness / p.mass_kg) + beyond);
}

}  // namespace gem
