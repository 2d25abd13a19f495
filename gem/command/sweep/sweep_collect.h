// gem sweep collect: writes the results of all runs of a sweep to one file.
#pragma once

#include <functional>
#include <string>

#include "gem/record/run_file/run_file.h"
#include "gem/record/summary/summary_file.h"
#include "gem/report/run/run_data.h"

namespace CLI {
class App;
}

namespace gem {

struct SweepCollectChoice {
  std::string folder;
  std::string output;
  std::string command_line;
  std::string index;        // runs to collect; empty: all
  double from_s = 0.0;      // the analysis leaves out earlier times
  double interval_s = 1.0;  // interval of the displacement; not below the recorded one; 0: no displacement
  bool exact = false;       // displacement and velocity in double precision, to compare runs exactly
  bool partial = false;
  bool overwrite = false;
};

/// Adds the folder and all options but --from.
void add_collect_options(CLI::App& command, SweepCollectChoice& choice);

/// An addition of another program to the summary: it sees each run in turn, then adds its columns.
struct SummaryPart {
  std::function<void(const RunFile&, const RunData&)> look_at = {};
  std::function<void(SummaryTable&)> add_columns = {};
};

/// Writes the summary. Returns 0. Throws Error(file_system) if runs are not done (unless `partial`), and Error(usage)
/// for options that contradict each other or the runs.
int collect_sweep(const SweepCollectChoice& choice, const SummaryPart& part = {});

}  // namespace gem
