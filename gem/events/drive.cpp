// Tables of current, tide and wind, read at one time.
#include "gem/events/drive.h"

#include <algorithm>
#include <utility>

#include "gem/base/strict_math.h"

namespace gem {
namespace {

/// The second and third number of a table at `time`.
Vec2 interpolated(const std::vector<TimeRow>& table, double time) {
  const auto after =
      std::upper_bound(table.begin(), table.end(), time, [](double t, const TimeRow& row) { return t < row[0]; });
  if (after == table.begin()) return {table.front()[1], table.front()[2]};
  const TimeRow& from = *(after - 1);
  if (after == table.end()) return {from[1], from[2]};
  const TimeRow& to = *after;
  const double share = (time - from[0]) / (to[0] - from[0]);
  return {from[1] + share * (to[1] - from[1]), from[2] + share * (to[2] - from[2])};
}

Vec2 velocity_at(const std::vector<TimeRow>& velocity, const std::vector<TimeRow>& direction, Vec2 steady,
                 double time) {
  if (!velocity.empty()) return interpolated(velocity, time);
  if (direction.empty()) return steady;
  const Vec2 polar = interpolated(direction, time);
  const Rotation q = strict::rotation_of_angle(polar.y);
  return {polar.x * q.cosine, polar.x * q.sine};
}

Vec2 tide_at(const std::vector<TideRow>& tide, double time) {
  Vec2 sum;
  for (const auto& [period, amplitude_x, phase_x, amplitude_y, phase_y] : tide) {
    const double turns = time / period;
    sum += {amplitude_x * strict::rotation_of_turns(turns - phase_x / strict::two_pi).cosine,
            amplitude_y * strict::rotation_of_turns(turns - phase_y / strict::two_pi).cosine};
  }
  return sum;
}

}  // namespace

bool varies(const DriveDef& def) {
  return !def.current_velocity.empty() || !def.current_direction.empty() || !def.tide.empty() ||
         !def.wind_velocity.empty() || !def.wind_direction.empty();
}

Drive drive_at(const DriveDef& def, const Drive& steady, double time) {
  return {velocity_at(def.current_velocity, def.current_direction, steady.water, time) + tide_at(def.tide, time),
          velocity_at(def.wind_velocity, def.wind_direction, steady.air, time),
          {}};
}

DriveSchedule::DriveSchedule(DriveDef def, const Drive& steady, double dt, TransitPath path)
    : def_(std::move(def)), steady_(steady), dt_(dt), varies_(gem::varies(def_)), path_(std::move(path)) {}

Drive DriveSchedule::at(std::int64_t step) const {
  Drive drive = steady_;
  if (varies_) drive = drive_at(def_, steady_, def_.start_time_s + (static_cast<double>(step) + 0.5) * dt_);
  if (path_.present()) drive.tow = path_.step(step, dt_);
  return drive;
}

}  // namespace gem
