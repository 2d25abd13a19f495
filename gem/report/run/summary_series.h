// Peaks, blocks and paths of runs as the series of a summary.
#pragma once

#include <functional>
#include <vector>

#include "gem/record/summary_file.h"
#include "gem/report/run/run_series.h"

namespace gem {

/// A series of the summary and where its values lie in a run.
struct SeriesEntry {
  const char* axis;  // time, cycle or block
  const char* name;
  const char* units;
  const char* long_name;
  std::function<std::vector<double>&(RunSeries&)> values;  // makes room for a path where there is none
};

/// All series that a summary may hold.
const std::vector<SeriesEntry>& summary_series();

/// Adds to a table with one row for each of `runs`, in their order, what the runs have.
void add_series(SummaryTable& table, const std::vector<RunSeries>& runs);

}  // namespace gem
