// Where the platform was at whole multiples of an interval.
#pragma once

#include <string>
#include <vector>

namespace gem {

/// Motion from rest and velocity at 0, interval_s, 2 interval_s, ...
struct PlatformPath {
  double interval_s = 0.0;
  bool exact = true;           // as the run had it, not rounded to single precision
  std::vector<double> x, y;    // [m]
  std::vector<double> vx, vy;  // [m/s]; empty where they were not kept
};

/// From a run file: at each time the sample there, or the last one before it. Empty for a run without a platform.
/// Throws Error(file_system) if the file cannot be read.
PlatformPath read_path(const std::string& run_file, double interval_s);

}  // namespace gem
