// The statements of the paper against the runs: one judged row each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/paper/runs/paper_run.h"
#include "validation/paper/statements/catalogue.h"
#include "validation/paper/statements/folder_numbers.h"

namespace gem {

struct JudgedRow {
  std::string id, source, says, condition, metric, why;
  Rule rule;
  std::optional<Measured> measured;
  std::optional<HeldShare> share = {};  // of several runs
  Verdict verdict = Verdict::undecidable;
  std::string note = {};  // why there is no measurement
  bool one_seed = false;  // though seeds differ
};

/// One statement. The mean over the runs is judged by its interval; a statement about each run by the share of runs
/// that obey it, and undecidable with fewer than kRunsForShare runs unless all runs are alike in it. A ratio of two
/// conditions about each run pairs their seeds. `prefix` stands before the names of its conditions: the same statement
/// under another choice.
JudgedRow evaluate(const Statement& statement, const PaperFolder& folder, const FolderNumbers& numbers,
                   const std::string& prefix = "");

/// Whether the runs of a row of the tables are there and have the settings that the paper prints.
struct JudgedSettings {
  TableRow row;
  std::size_t runs = 0;
  std::vector<std::string> differences;  // "gap 300 m, not 400 m"
  Verdict verdict = Verdict::undecidable;
};
JudgedSettings compare_settings(const TableRow& row, const PaperFolder& folder);

}  // namespace gem
