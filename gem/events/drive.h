// What drives the bodies: the velocity of water and air over time. The same everywhere.
//
//   table   linear in time between its rows; the first row holds before them, the last row after them
//             velocity table    x and y are linear
//             direction table   speed and direction are linear: a current that turns keeps its speed
//   tide    sum over its rows of  a_x cos(2 pi t / T - phi_x),  a_y cos(2 pi t / T - phi_y),  added to the current
//
//   T  period [s]     a  amplitude [m/s]     phi  phase lag [rad]
//
// A time step takes the velocities in its middle, so a floe lags behind its exact path by terms of the order of dt^2.
// Without tables the velocities of the definitions hold for the whole run, with the bits of a case without this law.
// Host only: engines are handed one Drive for each time step. The functions are strict (gem/base/strict_math.h).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gem/base/vec2.h"
#include "gem/events/platform/transit_path.h"

namespace gem {

/// Velocities of water and air in one time step [m/s], and where the path of a ship in transit leads.
struct Drive {
  Vec2 water, air;
  TowStep tow = {};
};

using TimeRow = std::array<double, 3>;  ///< time [s]; x and y [m/s], or speed [m/s] and direction [rad]
using TideRow = std::array<double, 5>;  ///< period [s]; amplitude [m/s] and phase [rad] of x, of y

/// Tables of a case. At most one table each for current and wind.
struct DriveDef {
  std::vector<TimeRow> current_velocity, current_direction;
  std::vector<TideRow> tide;
  std::vector<TimeRow> wind_velocity, wind_direction;
  double start_time_s = 0.0;  ///< time in the tables at t = 0 of the run
};

/// Whether the velocities change during a run.
bool varies(const DriveDef& def);

/// The velocities at `time` of the tables [s]; `steady` holds where there is no table.
Drive drive_at(const DriveDef& def, const Drive& steady, double time);

/// The drive of each time step of a run.
class DriveSchedule {
 public:
  DriveSchedule() = default;
  /// `dt`: time step [s].
  DriveSchedule(DriveDef def, const Drive& steady, double dt, TransitPath path = {});

  /// Whether any part of the drive changes.
  bool varies() const { return varies_ || path_.present(); }
  /// Velocities in the middle of a time step, counted from 0.
  Drive at(std::int64_t step) const;

 private:
  DriveDef def_;
  Drive steady_;
  double dt_ = 0.0;
  bool varies_ = false;
  TransitPath path_;
};

}  // namespace gem
