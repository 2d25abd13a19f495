// Runs as the rows of a summary, and back: what the reproduction needs of a run without its run file.
#pragma once

#include <string>
#include <vector>

#include "gem/record/summary_file.h"
#include "gem/report/paper/paper_run.h"

namespace gem {

/// Adds to a table with one row for each of `runs`, in their order: case, origin, every number with its interval (a
/// column that is there already stays), the peaks and blocks of the motion, and the paths, where the runs have them.
void add_paper_part(SummaryTable& table, const std::vector<PaperRun>& runs);

/// The series alone: peaks, blocks and paths.
void add_series(SummaryTable& table, const std::vector<PaperRun>& runs);

/// The runs of a summary. Throws Error(file_system) if it was made without them.
std::vector<PaperRun> paper_runs(const SummaryTable& table, const std::string& origin);

}  // namespace gem
