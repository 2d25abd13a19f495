// Peaks, blocks and paths of runs as the series of a summary.
#pragma once

#include <functional>
#include <vector>

#include "gem/record/summary/summary_file.h"
#include "gem/report/run/run_series.h"

namespace gem {

/// A series of the summary and where a run keeps its values.
struct SeriesEntry {
  const char* axis;  // time, cycle or block
  const char* name;
  const char* units;
  const char* long_name;
  std::function<std::vector<double>&(RunSeries&)> values;  // makes an empty path if there is none
};

/// All series that a summary may hold.
const std::vector<SeriesEntry>& summary_series();

/// Adds the series of the runs to a table that has one row per run, in the same order.
void add_series(SummaryTable& table, const std::vector<RunSeries>& runs);

}  // namespace gem
