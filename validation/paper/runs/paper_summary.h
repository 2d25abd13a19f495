// Runs as the rows of a summary, and back: what the reproduction needs of a run without its run file.
#pragma once

#include <string>
#include <vector>

#include "gem/record/summary_file.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {

/// Adds to a summary's table, with one row for each of `runs` in their order, the case and every number with its
/// interval; a column that is there already stays.
void add_paper_part(SummaryTable& table, const std::vector<PaperRun>& runs);

/// The runs of a summary. Throws Error(file_system) if it lacks their cases or origin, or if its series do not fit
/// together.
std::vector<PaperRun> paper_runs(const SummaryTable& table, const std::string& origin);

}  // namespace gem
