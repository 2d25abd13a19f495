// What the ice gave to each side of the platform in a whole run.
#pragma once

#include <string>
#include <vector>

#include "gem/record/run_file/run_file.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// Sums of one side of the outline, from corner k to corner k + 1.
struct SideRecord {
  std::string name;            // of a ship's part; else "side 3", counted from 1
  double length = 0.0;         // [m]
  double impulse = 0.0;        // that presses on the side [N s]
  double friction = 0.0;       // along it, from corner k to corner k + 1 [N s]
  double largest_force = 0.0;  // mean over one sample of the platform [N]
  double largest_time = 0.0;   // end of that sample [s]
};

/// Empty unless the run recorded output.side_loads. Throws Error(file_system) if the columns do not fit the outline or
/// the samples.
std::vector<SideRecord> side_record(const RunFile& file, const SceneDef& scene);

}  // namespace gem
