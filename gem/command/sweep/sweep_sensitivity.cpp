// Gathers drawn numbers from the manifest and results from the run files.
#include "gem/command/sweep/sweep_sensitivity.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/command/sweep/folder/sweep_folder.h"
#include "gem/command/sweep/folder/sweep_manifest.h"
#include "gem/record/output/output_path.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/platform_series.h"
#include "gem/report/run/run_findings.h"
#include "gem/report/sweep/sensitivity_page.h"
#include "gem/scene/problems.h"

namespace gem {
namespace {

using Json = nlohmann::ordered_json;

const std::vector<std::string>& usual_measures() {
  static const std::vector<std::string> names = {"ice_force_x_mean_N", "ice_force_window_largest_N",
                                                 "ice_sample_largest_N", "mooring_force_largest_N"};
  return names;
}

/// Largest ice force in one sample of the platform.
double sample_largest(const PlatformSeries& series) {
  return maximum_radial_excursion(series.ice_force_x, series.ice_force_y).value;
}

std::vector<Finding> measured(const std::string& path, double from_s) {
  const RunData data = load_run(path, false);
  const std::size_t first = sample_from(data, from_s);
  if (data.platform.time.size() < first + kSamplesForStatistics)
    throw Error(ExitCode::usage, shown(path) + ": too short to analyse (fewer than " +
                                     std::to_string(kSamplesForStatistics) + " platform samples after --from " +
                                     number_text(from_s) + " s); choose an earlier start or longer runs");
  const PlatformSeries series = platform_series(data, first);
  std::vector<Finding> findings = platform_findings(data, first);
  findings.push_back({"ice_sample_largest_N", sample_largest(series), {}});
  return findings;
}

bool has(const std::vector<Finding>& findings, const std::string& name) {
  return std::any_of(findings.begin(), findings.end(), [&](const Finding& finding) { return finding.name == name; });
}

/// What is measured without the user's choice: what any of the runs has. Without a mooring there is no force of it.
std::vector<std::string> usual_measures_of(const std::vector<std::vector<Finding>>& runs) {
  std::vector<std::string> names = usual_measures();
  std::erase_if(names, [&](const std::string& name) {
    return std::none_of(runs.begin(), runs.end(), [&](const auto& findings) { return has(findings, name); });
  });
  return names;
}

std::vector<double> values_of(const std::vector<Finding>& findings, const std::vector<std::string>& names,
                              bool chosen) {
  std::vector<std::string> known;
  for (const Finding& finding : findings) known.push_back(finding.name);
  std::vector<double> values;
  for (const std::string& name : names) {
    if (chosen && !has(findings, name))
      throw Error(ExitCode::usage,
                  "unknown measure " + shown(name) + " (`gem analyse` lists them)" + suggestion(name, known));
    const double value = finding_of(findings, name).value.value_or(std::numeric_limits<double>::quiet_NaN());
    // The sign of a largest excursion is that of one swing.
    values.push_back(name.ends_with("_largest_m") ? std::abs(value) : value);
  }
  return values;
}

std::vector<StudyInput> inputs_of(const SweepDraw& draw) {
  std::vector<StudyInput> inputs;
  for (const DrawnValue& one : draw.values) inputs.push_back({one.variable, one.key, one.law, one.key == "run.seed"});
  return inputs;
}

/// Rows with draws; all of them draw the same variables.
std::vector<SweepRow> drawn_rows(const std::string& folder) {
  std::vector<SweepRow> rows = read_manifest(folder);
  if (rows.empty())
    throw Error(ExitCode::file_system, shown(folder) +
                                           " is not the folder of a sweep (it has no manifest.json); name "
                                           "the --out folder of `gem sweep run`");
  std::erase_if(rows, [](const SweepRow& row) { return row.draw.draw == 0; });
  if (rows.empty())
    throw Error(ExitCode::usage, shown(folder) + " has no drawn inputs (its sweep file has no [sweep.draw]) " +
                                     "see `gem report` or `gem analyse` for its runs");
  const auto other = std::find_if(rows.begin(), rows.end(), [&rows](const SweepRow& row) {
    return !std::equal(row.draw.values.begin(), row.draw.values.end(), rows.front().draw.values.begin(),
                       rows.front().draw.values.end(), [](const DrawnValue& a, const DrawnValue& b) {
                         return a.variable == b.variable && a.key == b.key && a.law == b.law;
                       });
  });
  if (other != rows.end())
    throw Error(ExitCode::usage, shown(folder) + " holds two sweeps (" + shown(other->name) +
                                     " draws other inputs than " + shown(rows.front().name) +
                                     "); run each into a folder of its own");
  return rows;
}

SensitivityPage study_of(const SweepSensitivityChoice& choice) {
  std::vector<SweepRow> rows = drawn_rows(choice.folder);
  SensitivityPage page;
  page.sweep = std::filesystem::weakly_canonical(choice.folder).filename().string();
  page.listed = rows.size();
  page.from_s = choice.from_s;
  page.study.inputs = inputs_of(rows.front().draw);
  std::vector<std::vector<Finding>> findings;
  for (SweepRow& row : rows) {
    row = look_at_run(choice.folder, row);
    if (row.status != "done") continue;
    StudyRun run{row.name, row.draw.condition, row.draw.draw, row.draw.part, row.draw.repeat, {}, {}};
    for (const DrawnValue& one : row.draw.values) run.inputs.push_back(one.value);
    findings.push_back(measured(run_path(choice.folder, row.name), choice.from_s));
    page.study.runs.push_back(std::move(run));
  }
  page.study.outputs = choice.measures.empty() ? usual_measures_of(findings) : choice.measures;
  for (std::size_t i = 0; i < findings.size(); ++i)
    page.study.runs[i].outputs = values_of(findings[i], page.study.outputs, !choice.measures.empty());
  const std::size_t done = page.study.runs.size();
  if (done == 0 || (done < rows.size() && !choice.partial))
    throw Error(ExitCode::file_system, shown(choice.folder) + " holds " + std::to_string(done) + " done runs of " +
                                           std::to_string(rows.size()) +
                                           " (the others would be left out); finish them "
                                           "with `gem sweep run`" +
                                           (done == 0 ? "" : " or use --partial"));
  page.effects = study_effects(page.study);
  return page;
}

Json json_of(const std::optional<IntervalEstimate>& estimate) {
  if (!estimate) return nullptr;
  return {{"value", estimate->value}, {"low", estimate->low}, {"high", estimate->high}};
}

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const StudyInput& input, const InputEffect& effect) {
  const auto trend = [](const std::optional<TrendShare>& share) -> Json {
    if (!share) return nullptr;
    return {{"coefficient", json_of(std::optional(share->coefficient))},
            {"share", json_of(std::optional(share->share))}};
  };
  return {{"input", input.name},
          {"key", input.key},
          {"law", input.law},
          {"linear", trend(effect.linear)},
          {"monotone", trend(effect.monotone)},
          {"first_order", json_of(effect.first)},
          {"total", json_of(effect.total)}};
}

Json json_of(const SensitivityPage& page) {
  Json object = {{"runs", page.study.runs.size()}, {"listed", page.listed}, {"conditions", Json::array()}};
  for (const ConditionEffects& condition : page.effects) {
    Json outputs = Json::array();
    for (const OutputEffects& effects : condition.outputs) {
      Json inputs = Json::array();
      for (std::size_t k = 0; k < effects.inputs.size(); ++k)
        inputs.push_back(json_of(page.study.inputs[k], effects.inputs[k]));
      outputs.push_back({{"measure", effects.output},
                         {"draws", effects.draws},
                         {"runs", effects.runs},
                         {"draws_left_out", effects.left_out},
                         {"mean", json_of(effects.mean)},
                         {"deviation", json_of(effects.deviation)},
                         {"p90", json_of(effects.p90)},
                         {"smallest", effects.smallest},
                         {"largest", effects.largest},
                         {"linear_explained", json_of(effects.linear_explained)},
                         {"monotone_explained", json_of(effects.monotone_explained)},
                         {"inputs", inputs}});
    }
    object["conditions"].push_back({{"condition", condition.condition}, {"measures", outputs}});
  }
  return object;
}

/// The name of the page: that of its sweep with _sensitivity.
std::string page_folder(const SweepSensitivityChoice& choice) {
  if (!choice.output.empty()) return choice.output;
  std::filesystem::path stem(choice.folder);
  if (!stem.has_filename()) stem = stem.parent_path();
  return stem.string() + "_sensitivity";
}

}  // namespace

int sweep_sensitivity(const SweepSensitivityChoice& choice) {
  if (!(choice.from_s >= 0.0))
    throw Error(ExitCode::usage,
                "--from " + number_text(choice.from_s) + " is not a valid time (it must be 0 s or more); correct it");
  if (!choice.table.empty()) check_output_path(choice.table, false);
  const SensitivityPage page = study_of(choice);
  const std::string out = page_folder(choice);
  if (choice.table.empty())
    write_sensitivity_page(page, out);
  else
    write_sensitivity_runs(page, choice.table);
  print(choice.json ? json_of(page).dump(2, ' ', false, Json::error_handler_t::replace) + "\n"
                    : sensitivity_text(page) +
                          (choice.table.empty() ? shown(out) + "/index.html\n" : shown(choice.table) + "\n"));
  return 0;
}

}  // namespace gem
