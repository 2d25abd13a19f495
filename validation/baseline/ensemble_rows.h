// The numbers of one member of an ensemble.
#pragma once

#include <string>
#include <vector>

#include "validation/baseline/ensemble_plan.h"

namespace gem::baseline {

struct MemberValue {
  std::string name;    // ends in its unit
  double value = 0.0;  // NaN if the run does not record it
};

struct MemberRows {
  int seed = 0;
  double time_step_s = 0.0;
  std::vector<MemberValue> values;
  std::vector<double> share;  // of each cell of the map, mean over the judged time, row by row
};

/// Reads a complete run file. Throws Error(usage) if it ends before the judged time does. Other errors are those of
/// RunFile.
MemberRows member_rows(const std::string& run_file, const PlannedCase& chosen, const Grid& grid);

}  // namespace gem::baseline
