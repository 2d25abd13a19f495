// Reads the runs, and checks that several of them may be taken as draws of one condition.
#include "gem/command/analyse/analysed_runs.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <system_error>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/engine/engine.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/report/contact_energy_record.h"
#include "gem/report/run/fixed_record.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/platform_series.h"
#include "gem/report/run/run_findings.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

std::string seconds_text(double value) { return number_text(value, 5) + " s"; }

/// The findings whose largest value is extrapolated over runs.
const std::vector<std::string>& extreme_names() {
  static const std::vector<std::string> names = {"x_largest_m", "y_largest_m", "orbit_largest_m",
                                                 "ice_force_window_largest_N", "mooring_force_largest_N"};
  return names;
}

/// The largest value grows with the duration, so runs of different length are not mixed.
void check_exposure(const std::vector<AnalysedRun>& runs) {
  for (const AnalysedRun& run : runs)
    if (std::abs(run.duration_s - runs.front().duration_s) > 1e-3 * runs.front().duration_s)
      throw Error(ExitCode::usage, shown(run.path) + ": lasts " + seconds_text(run.duration_s) + ", the first run " +
                                       seconds_text(runs.front().duration_s) +
                                       " (the largest value grows with the duration); analyse runs of one length");
}

/// What defines the condition of a run: its case without name, length, start state and output, one line per option, and
/// the engine whose mechanics moved it.
std::vector<std::string> condition_of(const std::string& path) {
  const RunFile file(path, true);
  SceneDef scene = stored_scene(file);
  scene.run = {};
  scene.output = {};
  scene.platform.start_offset_m = {};
  scene.platform.start_velocity_m_per_s = {};
  scene.floes.moved_floe = -1;
  scene.floes.moved_by_m = {};
  const std::string engine = file.attribute("gem_engine");
  const std::vector<std::string> others = baseline_names();
  std::vector<std::string> lines = {"engine " +
                                    (std::find(others.begin(), others.end(), engine) != others.end() ? engine : "gem")};
  std::istringstream text(resolved_toml(scene));
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  return lines;
}

/// A mean over several runs only makes sense if all of them have the same condition.
void check_condition(const std::vector<AnalysedRun>& runs) {
  const std::vector<std::string> first = condition_of(runs.front().path);
  for (const AnalysedRun& run : runs) {
    const std::vector<std::string> other = condition_of(run.path);
    const auto [a, b] = std::mismatch(first.begin(), first.end(), other.begin(), other.end());
    if (a == first.end() && b == other.end()) continue;
    throw Error(ExitCode::usage, shown(run.path) + ": not the same condition as " + shown(runs.front().path) + " (" +
                                     (b == other.end() ? "less" : *b) + "; there " + (a == first.end() ? "less" : *a) +
                                     "); analyse runs that differ only in seed or start");
  }
}

bool same_run(const AnalysedRun& a, const AnalysedRun& b) {
  if (!a.state_hash.empty() && a.state_hash == b.state_hash) return true;
  std::error_code ignored;
  return std::filesystem::equivalent(a.path, b.path, ignored);
}

/// A run that did not end in order has no state hash.
std::string hash_clause(const AnalysedRun& run) {
  return run.state_hash.empty() ? "" : "state hash " + run.state_hash + "; ";
}

/// Runs count as independent. The same run given twice would narrow every interval without new information.
void check_different(const std::vector<AnalysedRun>& runs) {
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (same_run(runs[i], runs[j]))
        throw Error(ExitCode::usage, shown(runs[i].path) + ": the same run as " + shown(runs[j].path) + " (" +
                                         hash_clause(runs[i]) +
                                         "several runs count as independent); give each run once");
}

/// The largest tension of each mooring line from sample `first` on.
std::vector<LineFinding> line_findings(const RunData& data, std::size_t first) {
  std::vector<LineFinding> findings;
  for (const LineRecord& line : data.lines) {
    LineFinding finding{{}, 0.0, line.strength, line.break_time};
    const LargestTension largest = largest_tension(line, first);
    if (largest.sample < line.tension.size()) {
      finding.largest = largest.value;
      finding.at = data.platform.time[largest.sample];
    }
    findings.push_back(finding);
  }
  return findings;
}

[[noreturn]] void refuse_too_short(const std::string& path, std::size_t least, const char* rows, double from_s) {
  throw Error(ExitCode::usage, shown(path) + ": too short to analyse (fewer than " + std::to_string(least) + " " +
                                   rows + " after --from " + number_text(from_s) +
                                   " s); choose an earlier start or a longer run");
}

/// What a run without a platform has: the forces on `[[fixed]]` bodies.
AnalysedRun without_platform(const std::string& path, const RunData& data, double from_s) {
  const std::vector<double>& time = data.on_fixed.time;
  if (time.empty())
    throw Error(ExitCode::usage, shown(path) +
                                     ": nothing to analyse (it has no samples of a platform: the case has none, or " +
                                     "the run ended before the first; nor has it the forces on [[fixed]] bodies); run "
                                     "the case with output.contact_forces = true for those; `gem report` shows the "
                                     "ice");
  std::vector<Finding> findings = fixed_findings(data.on_fixed, from_s);
  if (findings.empty()) refuse_too_short(path, 2, "floe frames", from_s);
  const auto first = std::lower_bound(time.begin(), time.end(), from_s);
  return {path, data.identity.name, data.identity.state_hash, time.back() - *first, data.verdict, std::move(findings),
          {}};
}

AnalysedRun with_platform(const std::string& path, const RunData& data, double from_s) {
  const std::vector<double>& time = data.platform.time;
  const std::size_t first = sample_from(data, from_s);
  if (time.size() < first + kSamplesForStatistics)
    refuse_too_short(path, kSamplesForStatistics, "platform samples", from_s);
  return {path,
          data.identity.name,
          data.identity.state_hash,
          time.back() - time[first],
          data.verdict,
          platform_findings(data, first),
          line_findings(data, first)};
}

}  // namespace

AnalysedRun analysed(const std::string& path, double from_s, bool allow_incomplete) {
  const RunData data = load_run(path, allow_incomplete);
  AnalysedRun run =
      data.platform.time.empty() ? without_platform(path, data, from_s) : with_platform(path, data, from_s);
  run.contact_energy = contact_energy_of(RunFile(path, allow_incomplete));
  return run;
}

CombinedRuns combined(const std::vector<AnalysedRun>& runs) {
  check_condition(runs);
  check_exposure(runs);
  check_different(runs);
  std::vector<std::vector<Finding>> findings;
  for (const AnalysedRun& run : runs) findings.push_back(run.findings);
  CombinedRuns result{combine_runs(findings), {}};
  for (const std::string& name : extreme_names())
    if (const auto extreme = extreme_of(findings, name)) result.extremes.push_back(*extreme);
  return result;
}

}  // namespace gem
