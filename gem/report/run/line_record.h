// What the mooring lines of a run had to hold, and when they broke.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gem/record/run_file/run_file.h"
#include "gem/scene/scene_def.h"

namespace gem {

/// A line of mooring.line_table.
struct LineRecord {
  double strength = 0.0;        // 0: it never breaks [N]
  double break_time = 0.0;      // 0: it held [s]
  std::vector<double> tension;  // largest of each platform sample [N]; empty unless the run recorded them
};

/// Empty for a run without lines. Throws Error(file_system) if the columns do not fit the case or the samples.
std::vector<LineRecord> line_record(const RunFile& file, const SceneDef& scene);

/// The time at which each line broke; 0: it held [s]. Throws like line_record().
std::vector<double> last_break_times(const RunFile& file, const SceneDef& scene);

/// The largest tension from sample `first` on.
struct LargestTension {
  double value = 0.0;  // [N]
  std::size_t sample = 0;
};
LargestTension largest_tension(const LineRecord& line, std::size_t first);

/// "none", or "line 3 at 12.5 s, line 4 at 13.1 s", from the time at which each line broke; 0: it held.
std::string broken_lines_text(const std::vector<double>& break_times);

}  // namespace gem
