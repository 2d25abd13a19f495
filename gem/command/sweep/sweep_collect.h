// gem sweep collect: the runs of a sweep as one table in one file.
#pragma once

#include <functional>
#include <string>

#include "gem/record/run_file.h"
#include "gem/record/summary_file.h"
#include "gem/report/run/run_data.h"

namespace CLI {
class App;
}

namespace gem {

struct SweepCollectChoice {
  std::string folder;
  std::string output;
  std::string command_line;
  std::string index;        // of the runs meant; empty: all
  double from_s = 0.0;      // the analysis leaves out what is before
  double interval_s = 1.0;  // of the displacement, no shorter than a run was recorded; 0: none
  bool exact = false;       // displacement and velocity in double precision, for runs that are to be compared
  bool partial = false;
  bool overwrite = false;
};

/// Adds the folder and all options but --from.
void add_collect_options(CLI::App& command, SweepCollectChoice& choice);

/// What another program adds to the summary: it looks at each run in turn, then adds its columns.
struct SummaryPart {
  std::function<void(const RunFile&, const RunData&)> look_at = {};
  std::function<void(SummaryTable&)> add_columns = {};
};

/// Writes the summary. Returns 0. Throws Error(file_system) if runs are not done (and not partial), Error(usage) for
/// options that do not go together or with the runs.
int collect_sweep(const SweepCollectChoice& choice, const SummaryPart& part = {});

}  // namespace gem
