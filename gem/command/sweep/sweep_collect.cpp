// Collects the results of each run into columns.
#include "gem/command/sweep/sweep_collect.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/command/command.h"
#include "gem/command/index_list.h"
#include "gem/command/sweep/folder/sweep_folder.h"
#include "gem/command/sweep/folder/sweep_manifest.h"
#include "gem/command/sweep/sweep_settings.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/record/summary/summary_file.h"
#include "gem/report/run/line_record.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/platform_series.h"
#include "gem/report/run/run_findings.h"
#include "gem/report/run/run_series.h"
#include "gem/report/run/summary_series.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// Columns in the order in which their names first appear; NaN where a run has no value.
class Columns {
 public:
  explicit Columns(std::size_t runs) : runs_(runs) {}

  void set(std::size_t run, const std::string& name, const std::string& units, const std::string& long_name,
           double value) {
    const auto [place, is_new] = place_.insert({name, list.size()});
    if (is_new) list.push_back({name, units, long_name, false, std::vector<double>(runs_, nothing)});
    list[place->second].numbers[run] = value;
  }

  void add_texts(const std::string& name, const std::string& long_name, const std::vector<std::string>& texts) {
    list.push_back({name, "", long_name, false, {}, texts});
  }

  std::vector<SummaryColumn> list;

 private:
  std::size_t runs_;
  std::map<std::string, std::size_t> place_;
};

std::string unit_of(const std::string& name) {
  if (name.ends_with("_m_per_s")) return "m/s";
  for (const char* unit : {"m", "s", "N", "rad"})
    if (name.ends_with(std::string("_") + unit)) return unit;
  return "1";
}

std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

void set_finding(Columns& columns, std::size_t run, const Finding& finding) {
  const std::string unit = unit_of(finding.name);
  const std::string words = in_words(finding.name);
  columns.set(run, finding.name, unit, words, finding.value.value_or(nothing));
  // A main period keeps its columns even if no run resolves it, so that all summaries have the same columns.
  if (!finding.interval && finding.name.find("period_by") == std::string::npos) return;
  const IntervalEstimate interval = finding.interval.value_or(IntervalEstimate{nothing, nothing, nothing});
  columns.set(run, finding.name + "_low", unit, words + ", lower end of its 95 % interval", interval.low);
  columns.set(run, finding.name + "_high", unit, words + ", upper end of its 95 % interval", interval.high);
}

double mean_length(const std::vector<double>& x, const std::vector<double>& y) {
  double sum = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) sum += std::hypot(x[i], y[i]);
  return sum / static_cast<double>(x.size());
}

void set_platform(Columns& columns, std::size_t run, const RunData& data, double from_s) {
  const std::size_t first = sample_from(data, from_s);
  if (data.platform.time.size() < first + kSamplesForStatistics) return;
  const PlatformSeries series = platform_series(data, first);
  for (const Finding& finding : platform_findings(data, first)) set_finding(columns, run, finding);
  columns.set(run, "ice_force_window_mean_N", "N",
              "mean over the run of the magnitude of the ice force, averaged over output.force_window_s",
              mean_length(series.ice_force_window_x, series.ice_force_window_y));
}

/// What the mooring lines had to hold, of the whole run; --from applies to tensions.
void set_lines(Columns& columns, std::size_t run, const RunData& data, double from_s) {
  if (data.lines.empty()) return;
  double tension = nothing;
  const std::size_t first = sample_from(data, from_s);
  for (const LineRecord& line : data.lines)
    if (!line.tension.empty()) tension = std::fmax(tension, largest_tension(line, first).value);
  const auto broken =
      std::count_if(data.lines.begin(), data.lines.end(), [](const LineRecord& l) { return l.break_time > 0.0; });
  columns.set(run, "line_tension_largest_N", "N",
              "largest tension of any mooring line; missing unless output.line_tensions recorded them", tension);
  columns.set(run, "lines_broken", "1", "mooring lines that broke", static_cast<double>(broken));
}

/// Quality of the whole run; --from does not apply.
void set_quality(Columns& columns, std::size_t run, const RunData& data) {
  const RunFindings findings = run_findings(data);
  const RunQuality& quality = findings.quality;
  const auto set = [&](const char* name, const char* units, const char* words, double value) {
    columns.set(run, name, units, words, value);
  };
  set("events", "1", "events on the platform", static_cast<double>(findings.loads.events));
  set("impacts", "1", "events that begin a contact: no event of the same floe in the second before",
      static_cast<double>(findings.loads.touches));
  set("arrivals", "1", "distinct floes that hit the platform", static_cast<double>(findings.loads.arrivals));
  set("maximum_overlap_m", "m", "deepest overlap", quality.maximum_overlap);
  set("maximum_overlap_share", "1", "deepest overlap over the size of the smaller body", quality.maximum_share);
  set("residual_momentum", "1", "momentum that the books leave unexplained, relative", quality.residual_momentum);
  set("residual_angular_momentum", "1", "angular momentum that the books leave unexplained, relative",
      quality.residual_angular_momentum);
  set("residual_energy", "1", "energy that the books leave unexplained, relative", quality.residual_energy);
  set("sim_rate", "1", "simulated over wall time", quality.speed);
}

std::vector<SweepRow> done_rows(const SweepCollectChoice& choice) {
  std::vector<SweepRow> rows = read_manifest(choice.folder);
  if (rows.empty())
    throw Error(ExitCode::file_system, shown(choice.folder) +
                                           " is not the folder of a sweep (it has no manifest.json); name the "
                                           "--out folder of `gem sweep run`");
  std::vector<SweepRow> meant;
  for (const std::size_t place : parse_index_list(choice.index, rows.size())) meant.push_back(rows[place]);
  rows = std::move(meant);
  const std::size_t all = rows.size();
  for (SweepRow& row : rows) row = look_at_run(choice.folder, row);
  const auto open = std::find_if(rows.begin(), rows.end(), [](const SweepRow& row) { return row.status != "done"; });
  const std::string first_open =
      open == rows.end() ? "" : shown(open->name) + (open->error.empty() ? ": " + open->status : ": " + open->error);
  std::erase_if(rows, [](const SweepRow& row) { return row.status != "done"; });
  if (rows.empty() || (rows.size() < all && !choice.partial))
    throw Error(ExitCode::file_system, shown(choice.folder) + " holds " + std::to_string(rows.size()) +
                                           " done runs of " + std::to_string(all) + " (" + first_open +
                                           "); finish them with `gem sweep run`" +
                                           (rows.empty() ? "" : " or collect with --partial"));
  return rows;
}

/// The verdict of each run, and the value of each criterion.
void add_verdicts(Columns& columns, const std::vector<RunVerdict>& verdicts) {
  std::vector<std::string> grades;
  for (std::size_t run = 0; run < verdicts.size(); ++run) {
    grades.push_back(grade_name(verdicts[run].grade));
    for (const Judgement& one : verdicts[run].judgements)
      columns.set(run, "verdict_" + one.criterion, "1", "value that was judged: " + in_words(one.criterion), one.value);
  }
  columns.add_texts("verdict", "how far the run can be believed: good, doubtful, bad or not judged", grades);
}

void add_origin(Columns& columns, const std::vector<SweepRow>& rows, const std::vector<RunIdentity>& identities) {
  std::vector<std::string> hashes, engines, cases, sources, solvers;
  for (std::size_t run = 0; run < rows.size(); ++run) {
    hashes.push_back(rows[run].state_hash);
    engines.push_back(rows[run].engine);
    cases.push_back(rows[run].case_sha256);
    sources.push_back(identities[run].source);
    solvers.push_back(identities[run].solver);
    columns.set(run, "index", "1", "number of the run in the sweep file, from 1", static_cast<double>(rows[run].index));
    columns.set(run, "duration_s", "s", "simulated time", rows[run].time_s);
    columns.set(run, "wall_time_s", "s", "wall time of the run", rows[run].wall_time_s);
  }
  columns.add_texts("state_hash", "hash of the state at the end: same bits, same hash", hashes);
  columns.add_texts("engine", "engine that made the run", engines);
  columns.add_texts("case_sha256", "hash of the case with all its options", cases);
  columns.add_texts("source", "program that made the run", sources);
  columns.add_texts("resolution", "contact solver with its settings", solvers);
}

/// The drawn numbers of each run, one column per variable.
void add_draws(Columns& columns, const std::vector<SweepRow>& rows) {
  const bool drawn = std::any_of(rows.begin(), rows.end(), [](const SweepRow& row) { return row.draw.draw > 0; });
  if (!drawn) return;
  std::vector<std::string> conditions, parts;
  for (std::size_t run = 0; run < rows.size(); ++run) {
    const SweepDraw& draw = rows[run].draw;
    conditions.push_back(draw.condition);
    parts.push_back(draw.part);
    columns.set(run, "draw", "1", "number of the draw, from 1", static_cast<double>(draw.draw));
    columns.set(run, "draw_repeat", "1", "repeat of the draw with another seed, from 1",
                static_cast<double>(draw.repeat));
    for (const DrawnValue& one : draw.values)
      columns.set(run, "drawn_" + one.variable, "1", one.key + ", " + one.law, one.value);
  }
  columns.add_texts("draw_condition", "name of the run without its draw", conditions);
  columns.add_texts("draw_part", "of a Saltelli design: A, B, or the variable that comes from B", parts);
}

/// Displacement of the whole run; --from does not apply.
RunSeries kept_series(const RunData& data) {
  return data.platform.time.size() < kSamplesForStatistics ? RunSeries{} : run_series(platform_series(data));
}

/// The path rounded as the summary stores it, or exact with its velocity.
PlatformPath kept_path(const std::string& file, const SweepCollectChoice& choice) {
  PlatformPath path = read_path(file, choice.interval_s);
  path.exact = choice.exact;
  if (choice.exact) return path;
  path.vx.clear();
  path.vy.clear();
  return path;
}

void check(const SweepCollectChoice& choice) {
  if (!(choice.from_s >= 0.0))
    throw Error(ExitCode::usage,
                "--from " + number_text(choice.from_s) + " is not a valid time (it must be 0 s or more); correct it");
  if (!(choice.interval_s >= 0.0))
    throw Error(ExitCode::usage,
                "--series " + number_text(choice.interval_s) +
                    " is not a valid interval (it must be 0 s or more; 0 keeps no series); correct it");
  if (choice.exact && choice.interval_s == 0.0)
    throw Error(ExitCode::usage, "--exact has no effect (--series 0 keeps no displacement); leave one of them out");
  check_output_path(choice.output, choice.overwrite);
  check_replaceable(choice.output);
  if (is_run_file(choice.output) && !is_summary(choice.output))
    throw Error(ExitCode::file_system, "cannot write " + shown(choice.output) +
                                           " (it is a run file, and a summary would replace it); choose another --out");
}

/// A series cannot be collected at a shorter interval than the run was recorded at.
void check_intervals(const SweepCollectChoice& choice, const std::vector<SweepRow>& rows) {
  constexpr double kRounding = 1e-9;
  if (choice.interval_s == 0.0) return;
  for (const SweepRow& row : rows) {
    const std::string path = run_path(choice.folder, row.name);
    const double sampled_s = stored_scene(RunFile(path)).output.platform_interval_s;
    if (choice.interval_s < sampled_s * (1.0 - kRounding))
      throw Error(ExitCode::usage, "--series " + number_text(choice.interval_s) + " is too short (" + shown(row.name) +
                                       " was recorded every " + number_text(sampled_s) +
                                       " s, see output.platform_interval_s); give at least that, or 0 for no series");
  }
}

}  // namespace

int collect_sweep(const SweepCollectChoice& choice, const SummaryPart& part) {
  check(choice);
  const std::vector<SweepRow> rows = done_rows(choice);
  check_intervals(choice, rows);
  SummaryTable table;
  table.title = "summary of a sweep of " + std::to_string(rows.size()) + " runs";
  table.history = choice.command_line;
  Columns columns(rows.size());
  std::vector<RunIdentity> identities;
  std::vector<SceneDef> scenes;
  std::vector<RunSeries> series;
  std::vector<RunVerdict> verdicts;
  for (std::size_t run = 0; run < rows.size(); ++run) {
    const std::string path = run_path(choice.folder, rows[run].name);
    table.runs.push_back(rows[run].name);
    const RunData data = load_run(path, false);
    const RunFile records(path);
    identities.push_back(data.identity);
    verdicts.push_back(data.verdict);
    scenes.push_back(stored_scene(records));
    set_quality(columns, run, data);
    set_platform(columns, run, data, choice.from_s);
    set_lines(columns, run, data, choice.from_s);
    series.push_back(kept_series(data));
    if (choice.interval_s > 0.0) series.back().path = kept_path(path, choice);
    if (part.look_at) part.look_at(records, data);
  }
  add_verdicts(columns, verdicts);
  add_origin(columns, rows, identities);
  add_draws(columns, rows);
  table.columns = setting_columns(scenes);
  table.columns.insert(table.columns.end(), columns.list.begin(), columns.list.end());
  if (part.add_columns) part.add_columns(table);
  add_series(table, series);
  write_summary(choice.output, choice.overwrite, table);
  const SummaryAxis* time = table.axis("time");
  print_about_file(shown(choice.output) + ": " + std::to_string(rows.size()) + " runs, " +
                   std::to_string(table.columns.size()) + " columns, " +
                   std::to_string(time == nullptr ? 0 : time->values.size()) + " times of displacement\n");
  return 0;
}

}  // namespace gem
