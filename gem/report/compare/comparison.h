// Several runs side by side: their numbers with intervals, and what differs in their cases.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/run_analysis.h"
#include "gem/report/compare/case_differences.h"
#include "gem/report/run/run_data.h"
#include "gem/report/run/run_findings.h"

namespace gem {

struct ComparedRun {
  std::string path;
  std::string label;  // the run's name, or its file if names repeat
  RunData data;       // from from_s on
  RunFindings findings;
  std::vector<Finding> analysis;  // empty: the record is too short
};

/// A number of one run. Without value and text: the record does not allow it.
struct ComparedCell {
  std::optional<double> value;
  std::optional<IntervalEstimate> interval;  // 95 %
  std::string text;                          // instead of a number
  bool is_absent = false;                    // the run has no such quantity
  bool not_converged = false;                // a load of a short time in a run that ends its iterations too early
};

/// Whether the intervals of a row have a common part. Intervals that overlap do not show that two numbers are equal.
enum class Apart { unknown, no, yes };

/// One number of all runs. The name is that of `gem analyse` where it has one; it ends in the unit.
struct ComparedRow {
  std::string name;
  std::string meaning;
  std::vector<ComparedCell> cells;  // one per run
  Apart apart = Apart::unknown;     // unknown: fewer than two intervals
};

struct Comparison {
  double from_s = 0.0;
  std::vector<ComparedRun> runs;
  std::vector<CaseDifference> differences;
  std::vector<ComparedRow> rows;
};

/// The largest number of runs that one comparison takes; more cannot be told apart in a figure.
inline constexpr std::size_t kRunsCompared = 12;

/// Reads the runs and compares their records from `from_s` on. Throws Error(usage) for fewer than two runs or more than
/// kRunsCompared, for a run without platform or without 64 samples after `from_s`; otherwise like load_run().
Comparison compare_runs(const std::vector<std::string>& paths, double from_s, bool allow_incomplete);

/// The rows for runs in memory.
std::vector<ComparedRow> compared_rows(const std::vector<ComparedRun>& runs);

/// A sentence for each run that has no interval in any row, with the reason.
std::vector<std::string> missing_intervals(const Comparison& comparison);

/// The records from a time on: samples, events and frames of fixed bodies. What concerns the whole run stays.
RunData since(RunData run, double from_s);

}  // namespace gem
