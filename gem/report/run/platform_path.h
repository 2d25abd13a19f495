// Position of the platform at whole multiples of an interval.
#pragma once

#include <string>
#include <vector>

namespace gem {

/// Motion from rest, and velocity, at 0, interval_s, 2 interval_s, ...
struct PlatformPath {
  double interval_s = 0.0;
  bool exact = true;           // double precision as in the run, not rounded to single
  std::vector<double> x, y;    // [m]
  std::vector<double> vx, vy;  // [m/s]; empty if not kept
};

/// Reads the path of a run file. Each time takes its sample, or the last one before. Empty for a run without a
/// platform. Throws Error(file_system) if the file cannot be read.
PlatformPath read_path(const std::string& run_file, double interval_s);

}  // namespace gem
