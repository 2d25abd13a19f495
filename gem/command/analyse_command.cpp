// gem analyse: periods, offset, orbit, contact and loads of one run; means and extremes over several.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "gem/analysis/run_analysis.h"
#include "gem/analysis/runs_analysis.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/platform_series.h"
#include "gem/report/run/run_findings.h"
#include "gem/scene/toml/document.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

struct AnalyseOptions {
  std::vector<std::string> paths;
  double from_s = 0.0;
  bool allow_incomplete = false;
  bool json = false;
};

/// A mooring line: its largest tension, if the run recorded it, strength (0: none) and time of failure (0: it held).
struct LineFinding {
  std::optional<double> largest;  // [N]
  double at = 0.0;                // [s]
  double strength, break_time;    // [N], [s]
};

/// The findings of one run, its file and its duration.
struct Run {
  std::string path, name;
  std::string state_hash;  // empty if the run did not end in order
  double duration_s = 0.0;
  std::vector<Finding> findings;
  std::vector<LineFinding> lines;  // of the mooring
};

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

Run analysed(const std::string& path, const AnalyseOptions& options) {
  const RunData data = load_run(path, options.allow_incomplete);
  const std::vector<double>& time = data.platform.time;
  if (time.empty())
    throw Error(ExitCode::usage,
                shown(path) + ": nothing to analyse (it has no samples of a platform: the case has " +
                    "none, or the run ended before the first) see `gem info`; `gem report` shows the ice");
  const std::size_t first = sample_from(data, options.from_s);
  if (time.size() < first + kSamplesForStatistics)
    throw Error(ExitCode::usage, shown(path) + ": too short to analyse (fewer than " +
                                     std::to_string(kSamplesForStatistics) + " platform samples after --from " +
                                     number_text(options.from_s) + " s) choose an earlier start or a longer run");
  return {path,
          data.identity.name,
          data.identity.state_hash,
          time.back() - time[first],
          analyse_platform(platform_series(data, first)),
          line_findings(data, first)};
}

Json json_of(const IntervalEstimate& estimate) {
  return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}};
}

Json json_of(const Finding& finding) {
  if (!finding.value) return nullptr;
  return finding.interval ? json_of(*finding.interval) : Json{{"value", *finding.value}};
}

Json json_of(const LineFinding& line) {
  Json object = {{"strength_N", line.strength}, {"break_time_s", line.break_time}};
  if (line.largest) object["tension_largest_N"] = *line.largest, object["tension_largest_at_s"] = line.at;
  return object;
}

Json json_of(const Run& run) {
  Json object = {{"file", run.path}, {"name", run.name}, {"duration_s", run.duration_s}};
  for (const Finding& finding : run.findings) object["findings"][finding.name] = json_of(finding);
  for (const LineFinding& line : run.lines) object["mooring_lines"].push_back(json_of(line));
  return object;
}

std::string row_text(const std::string& name, const std::vector<std::string>& cells) {
  std::string line = "  " + name;
  std::size_t end = 34;
  for (const std::string& cell : cells) {
    line += std::string(line.size() < end ? end - line.size() : 1, ' ') + cell;
    end += 14;
  }
  return line + "\n";
}

std::string short_text(double value) { return number_text(value, 5); }

std::string interval_text(const IntervalEstimate& estimate) {
  return short_text(estimate.low) + " to " + short_text(estimate.high);
}

bool is_length_or_force(const std::string& name) { return name.ends_with("_m") || name.ends_with("_N"); }

/// Whether no ice touched the platform and it did not move. Then its numbers are rounding.
bool untouched(const std::vector<Finding>& findings) {
  return finding_of(findings, "contact_fraction").value.value_or(0.0) == 0.0 &&
         finding_of(findings, "ice_force_window_largest_N").value.value_or(0.0) == 0.0 &&
         finding_of(findings, "orbit_largest_m").value.value_or(0.0) < kLeastMotion;
}

std::string value_text(const Finding& finding) {
  if (!finding.value) return "not resolved";
  const bool spectral = finding.name.ends_with("_period_by_spectrum_s") && finding.interval;
  if (spectral && finding.interval->high > 2.0 * finding.interval->low) return "not resolved";
  return short_text(*finding.value);
}

std::string text_of(const std::vector<LineFinding>& lines) {
  if (lines.empty()) return "";
  std::string text = row_text("mooring line", {"largest N", "at s", "of strength", "broke at s"});
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const LineFinding& line = lines[k];
    const bool has_share = line.largest && line.strength > 0.0;
    text +=
        row_text("line " + std::to_string(k + 1),
                 {line.largest ? short_text(*line.largest) : "not recorded", line.largest ? short_text(line.at) : "-",
                  has_share ? number_text(100.0 * *line.largest / line.strength, 3) + " %" : "-",
                  line.break_time > 0.0 ? short_text(line.break_time) : "no"});
  }
  return text;
}

std::string text_of(const Run& run) {
  std::string text = shown(run.path) + ": " + run.name + ", " + short_text(run.duration_s) + " s\n" +
                     row_text("", {"value", "95 % interval"});
  const bool without_contact = untouched(run.findings);
  for (const Finding& finding : run.findings) {
    const bool rounding = without_contact && is_length_or_force(finding.name);
    text += row_text(finding.name, {rounding ? "no contact" : value_text(finding),
                                    finding.interval && !rounding ? interval_text(*finding.interval) : "-"});
  }
  return text + text_of(run.lines) +
         "spells and gaps cut by an end of the record count with their observed part: mean = total time over "
         "the\n"
         "observed ends (exponential), median by Kaplan-Meier, the longest is a lower bound\n";
}

/// The findings whose largest value is extrapolated over runs.
const std::vector<std::string>& extreme_names() {
  static const std::vector<std::string> names = {"x_largest_m", "y_largest_m", "orbit_largest_m",
                                                 "ice_force_window_largest_N", "mooring_force_largest_N"};
  return names;
}

/// The largest value grows with the duration, so runs of different length are not mixed.
void check_exposure(const std::vector<Run>& runs) {
  for (const Run& run : runs)
    if (std::abs(run.duration_s - runs.front().duration_s) > 1e-3 * runs.front().duration_s)
      throw Error(ExitCode::usage, shown(run.path) + ": lasts " + short_text(run.duration_s) + " s, the first run " +
                                       short_text(runs.front().duration_s) +
                                       " s (the largest value grows with the duration) analyse runs of one length");
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
void check_condition(const std::vector<Run>& runs) {
  const std::vector<std::string> first = condition_of(runs.front().path);
  for (const Run& run : runs) {
    const std::vector<std::string> other = condition_of(run.path);
    const auto [a, b] = std::mismatch(first.begin(), first.end(), other.begin(), other.end());
    if (a == first.end() && b == other.end()) continue;
    throw Error(ExitCode::usage, shown(run.path) + ": not the same condition as " + shown(runs.front().path) + " (" +
                                     (b == other.end() ? "less" : *b) + "; there " + (a == first.end() ? "less" : *a) +
                                     ") analyse runs that differ only in seed or start");
  }
}

bool same_run(const Run& a, const Run& b) {
  if (!a.state_hash.empty() && a.state_hash == b.state_hash) return true;
  std::error_code ignored;
  return std::filesystem::equivalent(a.path, b.path, ignored);
}

/// A run that did not end in order has no state hash.
std::string hash_clause(const Run& run) { return run.state_hash.empty() ? "" : "state hash " + run.state_hash + "; "; }

/// Runs count as independent. The same run given twice would narrow every interval without new information.
void check_different(const std::vector<Run>& runs) {
  for (std::size_t i = 0; i < runs.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (same_run(runs[i], runs[j]))
        throw Error(ExitCode::usage, shown(runs[i].path) + ": the same run as " + shown(runs[j].path) + " (" +
                                         hash_clause(runs[i]) +
                                         "several runs count as independent) give each run once");
}

struct Combined {
  std::vector<RunsFinding> means;
  std::vector<RunsExtreme> extremes;
};

Combined combined(const std::vector<Run>& runs) {
  std::vector<std::vector<Finding>> findings;
  for (const Run& run : runs) findings.push_back(run.findings);
  Combined result{combine_runs(findings), {}};
  for (const std::string& name : extreme_names())
    if (const auto extreme = extreme_of(findings, name)) result.extremes.push_back(*extreme);
  return result;
}

Json json_of(const std::vector<Run>& runs, const Combined& all) {
  Json object = {{"runs", Json::array()}, {"over_runs", Json::object()}, {"extremes", Json::object()}};
  for (const Run& run : runs) object["runs"].push_back(json_of(run));
  for (const RunsFinding& row : all.means) {
    Json& entry = object["over_runs"][row.name] = {{"runs", row.runs}};
    if (!row.mean) continue;
    entry["mean"] = json_of(*row.mean);
    entry["deviation"] = row.deviation;
    entry["smallest"] = row.smallest;
    entry["largest"] = row.largest;
  }
  for (const RunsExtreme& extreme : all.extremes)
    object["extremes"][extreme.name] = {
        {"most_probable", json_of(extreme.most_probable)},
        {"p90", json_of(extreme.p90)},
        {"gumbel_by_likelihood", {{"mode", extreme.by_likelihood.mode}, {"scale", extreme.by_likelihood.scale}}},
        {"gumbel_by_moments", {{"mode", extreme.by_moments.mode}, {"scale", extreme.by_moments.scale}}}};
  return object;
}

std::string text_of(const std::vector<Run>& runs, const Combined& all) {
  std::string text = std::to_string(runs.size()) + " runs of " + short_text(runs.front().duration_s) + " s\n" +
                     row_text("", {"mean", "deviation", "runs", "95 % interval of the mean"});
  for (const RunsFinding& row : all.means)
    text += row.mean ? row_text(row.name, {short_text(row.mean->value), short_text(row.deviation),
                                           std::to_string(row.runs), interval_text(*row.mean)})
                     : row_text(row.name, {"not resolved"});
  if (all.extremes.empty()) return text + "extremes need at least five runs\n";
  text += "largest of one exposure (Gumbel)\n" + row_text("", {"most probable", "90 % quantile", "its 95 % interval"});
  for (const RunsExtreme& extreme : all.extremes)
    text += row_text(extreme.name, {short_text(extreme.most_probable.value), short_text(extreme.p90.value),
                                    interval_text(extreme.p90)});
  return text;
}

int analyse(const AnalyseOptions& options) {
  if (!(options.from_s >= 0.0))
    throw Error(ExitCode::usage,
                "--from " + number_text(options.from_s) + " is not a valid time (it must be 0 s or more) correct it");
  std::vector<Run> runs;
  for (const std::string& path : options.paths) runs.push_back(analysed(path, options));
  if (runs.size() == 1) {
    print(options.json ? json_of(runs.front()).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
                       : text_of(runs.front()));
    return 0;
  }
  check_condition(runs);
  check_exposure(runs);
  check_different(runs);
  const Combined all = combined(runs);
  print(options.json ? json_of(runs, all).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
                     : text_of(runs, all));
  return 0;
}

}  // namespace

void add_analyse_command(CLI::App& app, Chosen& chosen) {
  const auto options = std::make_shared<AnalyseOptions>();
  CLI::App* command =
      app.add_subcommand("analyse", "periods, offset, orbit, contact and extremes of one or several run files");
  command->add_option("files", options->paths, "run files; several count as independent runs of one condition")
      ->required()
      ->type_name("RUNFILE");
  command->add_option("--from", options->from_s, "ignore the record before this time, e.g. until the ice arrives [s]");
  command->add_flag("--allow-incomplete", options->allow_incomplete, "analyse incomplete runs");
  command->add_flag("--json", options->json, "as JSON");
  command->callback([options, &chosen] {
    chosen.reading = {options->paths};
    chosen.action = [options] { return analyse(*options); };
  });
}

}  // namespace gem
