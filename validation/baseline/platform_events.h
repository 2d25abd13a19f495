// What hits the platform, counted from the rows of its events: several ways, because engines log one landing
// differently.
#pragma once

#include <vector>

#include "gem/record/run_file.h"

namespace gem::baseline {

/// Rows of /events in time order, one per floe and time step.
struct PlatformEvents {
  std::vector<double> time;           // start of the time step [s]
  std::vector<double> floe;           // body number
  std::vector<double> closing_speed;  // [m/s]
};

/// A floe has landed if it had not touched the platform for so long. Its weight on the platform comes and goes for up
/// to two seconds while it lies there (validation/baseline/README.md), and it needs longer to come back.
constexpr double landing_gap_s = 3.0;

PlatformEvents platform_events(const RunFile& file);

/// Only the rows with a higher closing speed [m/s].
PlatformEvents faster_than(double closing_speed, const PlatformEvents& events);

/// Rows in from_s <= time <= to_s whose floe had no row in the `gap_s` before; rows before from_s count as its past.
double first_after(double gap_s, const PlatformEvents& events, double from_s, double to_s);

}  // namespace gem::baseline
