// The reproduction report of the paper from run files and summaries.
#pragma once

#include <string>
#include <vector>

namespace gem {

struct PaperReportSummary {
  std::size_t runs = 0, refused = 0, reproduced = 0, not_reproduced = 0, undecidable = 0;
};

/// Reads every run file and summary of `runs` (folders or files), judges the statements of `statements`
/// (validation/paper/paper.json), and writes OUT/README.md, OUT/rows.csv and OUT/figures. Rows of build/unordered_sums
/// and build/ice_distances are used if they lie beside `statements`. Figures of an earlier report are removed. Any
/// subset of the runs is accepted; the page says what is missing. Throws Error(file_system) if no run can be read
/// (before anything is removed), if another file cannot be read or written, or if gnuplot is missing.
PaperReportSummary write_paper_report(const std::vector<std::string>& runs, const std::string& out,
                                      const std::string& statements);

}  // namespace gem
