// Runs as rows of a summary, and back: everything that the judge needs of a run without its run file.
#pragma once

#include <string>
#include <vector>

#include "gem/record/summary/summary_file.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {

/// Adds the case and every number with its interval to a summary's table, which has one row for each of `runs` in their
/// order. Existing columns stay.
void add_paper_part(SummaryTable& table, const std::vector<PaperRun>& runs);

/// The runs of a summary. Throws Error(file_system) if cases or origin are missing, or if its series are inconsistent.
std::vector<PaperRun> paper_runs(const SummaryTable& table, const std::string& origin);

}  // namespace gem
