// The resistance of the ice to a ship in transit.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/analysis/run_analysis.h"
#include "gem/scene/scene_def.h"

namespace gem {

struct PlatformRecord;

/// One value for each platform sample; forces as means over output.force_window_s, against the course at the time.
struct TransitRecord {
  bool present = false;
  bool free = false;                      // the ship runs free, by its own thrust
  double speed = 0.0;                     // given [m/s]; of a ship that runs free: at the start
  std::vector<double> time;               // [s]
  std::vector<double> distance;           // along the path [m]
  std::vector<double> resistance;         // force of the ice against the course, mean over the sample [N]
  std::vector<double> resistance_window;  // the same, mean over the force window [N]
  std::vector<double> side_window;        // to the left of the course [N]
  std::vector<double> pull;               // of the thrust of a ship that runs free, or of the tow: along the path [N]
  std::vector<double> across;             // what holds the ship on its path: to the left [N]
  std::vector<double> made_good;          // the same: speed along the path over the sample [m/s]
};

/// Empty for a run without transit.
TransitRecord transit_record(const PlatformRecord& platform, const SceneDef& scene);

/// Mean, scatter, percentile and peak of the resistance from sample `first` on, the distance covered, and what the
/// thrust or the tow gives along the path and across it; of a ship that runs free also its speed. None without transit.
/// The interval of the mean takes stretches of a twentieth of the record as independent.
std::vector<Finding> transit_findings(const TransitRecord& transit, std::size_t first);

}  // namespace gem
