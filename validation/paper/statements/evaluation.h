// Judges the statements of the paper: one row each.
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
  bool one_seed = false;  // only one seed, although seeds differ
};

/// Judges one statement. The mean over the runs is judged by its interval. A statement about each run is judged by the
/// share of runs that obey it; with fewer than kRunsForShare runs it is undecidable unless all runs are alike. A ratio
/// of two conditions about each run pairs their seeds. `prefix` is put before the names of the conditions, to judge a
/// statement under another modelling choice.
JudgedRow evaluate(const Statement& statement, const PaperFolder& folder, const FolderNumbers& numbers,
                   const std::string& prefix = "");

/// Whether the runs of a table row exist and have the settings that the paper prints.
struct JudgedSettings {
  TableRow row;
  std::size_t runs = 0;
  std::vector<std::string> differences;  // "gap 300 m, not 400 m"
  Verdict verdict = Verdict::undecidable;
};
JudgedSettings compare_settings(const TableRow& row, const PaperFolder& folder);

}  // namespace gem
