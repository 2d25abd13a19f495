// Counts what hits the platform from the rows of its events, in several ways, because engines log a landing
// differently.
// differently.
#pragma once

#include <vector>

#include "gem/record/run_file/run_file.h"

namespace gem::baseline {

/// Rows of /events in time order, one per floe and time step.
struct PlatformEvents {
  std::vector<double> time;           // start of the time step [s]
  std::vector<double> floe;           // body number
  std::vector<double> closing_speed;  // [m/s]
};

/// A floe lands if it has not touched the platform for this time. The contact force of a floe that lies on the platform
/// vanishes for up to two seconds (validation/baseline/README.md); a floe that leaves needs longer to return.
constexpr double landing_gap_s = 3.0;

PlatformEvents platform_events(const RunFile& file);

/// The rows with a higher closing speed [m/s].
PlatformEvents faster_than(double closing_speed, const PlatformEvents& events);

/// Number of rows in from_s <= time <= to_s whose floe had no row in the `gap_s` before. Rows before from_s count as
/// its past.
double first_after(double gap_s, const PlatformEvents& events, double from_s, double to_s);

}  // namespace gem::baseline
