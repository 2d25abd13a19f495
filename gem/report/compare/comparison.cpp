// Loads the runs, names them, and says why they have no intervals.
#include "gem/report/compare/comparison.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/report/run/load_run.h"

namespace gem {
namespace {

ComparedRun loaded(const std::string& path, double from_s, bool allow_incomplete) {
  ComparedRun run{path, "", since(load_run(path, allow_incomplete), from_s), {}, {}};
  if (run.data.platform.time.size() < kSamplesForStatistics)
    throw Error(ExitCode::usage, shown(path) + ": nothing to compare (it has fewer than " +
                                     std::to_string(kSamplesForStatistics) + " samples of a platform after " +
                                     number_text(from_s) + " s); leave it out, or choose an earlier --from");
  run.label = run.data.identity.name;
  run.findings = run_findings(run.data);
  run.analysis = whole_run_analysis(run.data);
  if (run.data.transit.present) std::erase_if(run.analysis, is_of_swing);
  return run;
}

bool all_different(const std::vector<ComparedRun>& runs) {
  std::set<std::string> labels;
  for (const ComparedRun& run : runs) labels.insert(run.label);
  return labels.size() == runs.size();
}

/// Runs of one name are called by their files; files of one name by their paths.
void set_labels(std::vector<ComparedRun>& runs) {
  if (all_different(runs)) return;
  for (ComparedRun& run : runs) run.label = std::filesystem::path(run.path).filename().string();
  if (all_different(runs)) return;
  for (ComparedRun& run : runs) run.label = run.path;
}

}  // namespace

std::vector<std::string> missing_intervals(const Comparison& comparison) {
  constexpr double fewest_periods =
      16.0;  // of the record: then it can be cut into stretches that are almost independent
  std::vector<std::string> sentences;
  for (std::size_t i = 0; i < comparison.runs.size(); ++i) {
    const auto has = [i](const ComparedRow& row) { return row.cells[i].interval.has_value(); };
    if (std::any_of(comparison.rows.begin(), comparison.rows.end(), has)) continue;
    const ComparedRun& run = comparison.runs[i];
    const std::vector<double>& time = run.data.platform.time;
    const double record = time.empty() ? 0.0 : time.back() - time.front(), period = run.data.natural_period_s;
    const std::string start = "no intervals for " + shown(run.label) + ": ";
    if (!(period > 0.0))
      sentences.push_back(start + "it has no mooring, so no natural period to cut its record by");
    else if (record < fewest_periods * period)
      sentences.push_back(start + "they need a record of " + number_text(fewest_periods * period, 3) + " s (" +
                          number_text(fewest_periods, 3) + " natural periods), it has " + number_text(record, 3) +
                          " s");
    else
      sentences.push_back(start + "its record does not resolve them (the platform hardly moves, or no ice presses)");
  }
  return sentences;
}

Comparison compare_runs(const std::vector<std::string>& paths, double from_s, bool allow_incomplete) {
  if (paths.size() < 2 || paths.size() > kRunsCompared)
    throw Error(ExitCode::usage, "cannot compare " + std::to_string(paths.size()) +
                                     " run files (a comparison takes 2 to " + std::to_string(kRunsCompared) +
                                     "); for many runs see `gem sweep collect`");
  Comparison comparison;
  comparison.from_s = from_s;
  std::vector<SceneDef> cases;
  for (const std::string& path : paths) {
    comparison.runs.push_back(loaded(path, from_s, allow_incomplete));
    cases.push_back(stored_scene(RunFile(path, allow_incomplete)));
  }
  set_labels(comparison.runs);
  comparison.differences = case_differences(cases);
  comparison.rows = compared_rows(comparison.runs);
  return comparison;
}

}  // namespace gem
