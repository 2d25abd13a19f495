// What dynamic positioning asked for, gave and left in a run.
#pragma once

#include <cstddef>
#include <vector>

#include "gem/analysis/run_analysis.h"
#include "gem/record/run_file/run_file.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Columns with one value for each platform sample.
struct ThrusterSamples {
  double maximum = 0.0;          // largest thrust [N]
  std::vector<double> thrust;    // magnitude of the mean over the sample [N]
  std::vector<double> at_limit;  // share of the sample at its limit
};

struct DpRecord {
  std::vector<ThrusterSamples> thruster;  // none: no dynamic positioning
  std::vector<double> offset;             // distance from the set point [m]
  std::vector<double> yaw;                // from its set point [rad]
  std::vector<double> demand;             // force asked for [N]
  double period = 0.0;                    // of the surge by the design of the control [s]
};

/// Empty for a run without thrusters. Throws Error(file_system) if the columns do not fit the case or the samples.
DpRecord dp_record(const RunFile& file, const SceneDef& scene);

/// Thrust of all thrusters in a sample, as a sum of magnitudes over the sum of their largest [-].
double thrust_utilisation(const DpRecord& dp, std::size_t sample);

/// Percentiles of the offset, largest yaw error, use of the thrust and time at the limit, from sample `first` on. None
/// without thrusters.
std::vector<Finding> dp_findings(const DpRecord& dp, std::size_t first);

}  // namespace gem
