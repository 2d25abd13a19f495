// Loads the runs and sets their numbers side by side.
#include "gem/report/compare/comparison.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/record/output/output_path.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/platform_series.h"

namespace gem {
namespace {

template <class T>
void drop(std::vector<T>& column, std::size_t count) {
  column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(std::min(count, column.size())));
}

EventColumns events_since(const EventColumns& events, double from_s) {
  EventColumns kept;
  for (std::size_t i = 0; i < events.time.size(); ++i) {
    if (events.time[i] < from_s) continue;
    kept.time.push_back(events.time[i]);
    kept.body_b.push_back(events.body_b[i]);
    kept.nx.push_back(events.nx[i]);
    kept.ny.push_back(events.ny[i]);
    kept.impulse.push_back(events.impulse[i]);
    kept.force_peak.push_back(events.force_peak[i]);
  }
  return kept;
}

ComparedRun loaded(const std::string& path, double from_s, bool allow_incomplete) {
  ComparedRun run{path, "", since(load_run(path, allow_incomplete), from_s), {}, {}};
  if (run.data.platform.time.size() < kSamplesForStatistics)
    throw Error(ExitCode::usage, shown(path) + ": nothing to compare (it has fewer than " +
                                     std::to_string(kSamplesForStatistics) + " samples of a platform after " +
                                     number_text(from_s) + " s) leave it out, or choose an earlier --from");
  run.label = run.data.identity.name;
  run.findings = run_findings(run.data);
  run.analysis = whole_run_analysis(run.data);
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

Apart apart(const std::vector<ComparedCell>& cells) {
  double highest_low = 0.0, lowest_high = 0.0;
  int intervals = 0;
  for (const ComparedCell& cell : cells) {
    if (!cell.interval) continue;
    highest_low = intervals == 0 ? cell.interval->low : std::max(highest_low, cell.interval->low);
    lowest_high = intervals == 0 ? cell.interval->high : std::min(lowest_high, cell.interval->high);
    ++intervals;
  }
  return intervals < 2 ? Apart::unknown : highest_low > lowest_high ? Apart::yes : Apart::no;
}

/// Collects the rows of a table.
class Rows {
 public:
  explicit Rows(const std::vector<ComparedRun>& runs) : runs_(runs) {}

  void analysed(const std::string& name, const std::string& meaning) {
    add(name, meaning, [&](const ComparedRun& run) {
      const Finding finding = finding_of(run.analysis, name);
      return is_resolved(finding) ? ComparedCell{finding.value, finding.interval, ""} : ComparedCell{};
    });
  }
  template <class Number>
  void number(const std::string& name, const std::string& meaning, const Number& of) {
    add(name, meaning, [&](const ComparedRun& run) { return ComparedCell{double(of(run)), std::nullopt, ""}; });
  }
  /// Marks the last row, a load of a short time, in runs whose contacts had not converged.
  void short_load() {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      ComparedCell& cell = list.back().cells[i];
      cell.not_converged = cell.value.value_or(0.0) != 0.0 && stops_short(runs_[i].data.verdict);
    }
  }
  template <class Text>
  void text(const std::string& name, const std::string& meaning, const Text& of) {
    add(name, meaning, [&](const ComparedRun& run) { return ComparedCell{std::nullopt, std::nullopt, of(run)}; });
  }
  /// Whether some run has this number.
  bool any(const std::string& name) const {
    return std::any_of(runs_.begin(), runs_.end(),
                       [&](const ComparedRun& run) { return finding_of(run.analysis, name).value.has_value(); });
  }
  std::vector<ComparedRow> list;

 private:
  template <class Cell>
  void add(const std::string& name, const std::string& meaning, const Cell& cell) {
    ComparedRow row{name, meaning, {}};
    for (const ComparedRun& run : runs_) row.cells.push_back(cell(run));
    row.apart = apart(row.cells);
    list.push_back(row);
  }
  const std::vector<ComparedRun>& runs_;
};

void add_loads(Rows& rows) {
  rows.analysed("ice_force_window_largest_N", "ice force averaged over the force window, largest");
  rows.short_load();
  const bool moored = rows.any("mooring_force_largest_N");
  if (moored) rows.analysed("mooring_force_largest_N", "mooring force, largest");
  rows.analysed("ice_force_x_mean_N", "ice force, mean, x");
  rows.analysed("ice_force_y_mean_N", "ice force, mean, y");
  if (moored) rows.analysed("mooring_force_x_mean_N", "mooring force, mean, x");
  rows.number("event_impulse_largest_N_s", "impulse of one hit, largest",
              [](const ComparedRun& run) { return run.findings.loads.event_impulse_largest; });
  rows.short_load();
  rows.number("crushing_peak_largest_N", "crushing peak of one hit, largest",
              [](const ComparedRun& run) { return run.findings.loads.crushing_largest; });
  rows.short_load();
}

void add_motion(Rows& rows) {
  for (const std::string axis : {"x", "y"}) {
    rows.analysed(axis + "_offset_m", "mean offset, " + axis);
    rows.analysed(axis + "_deviation_m", "standard deviation, " + axis);
    rows.analysed(axis + "_largest_m", "largest excursion, " + axis);
  }
  rows.analysed("orbit_largest_m", "largest excursion in the plane");
  for (const std::string axis : {"x", "y"}) {
    rows.analysed(axis + "_period_by_spectrum_s", "period, spectral peak, " + axis);
    rows.analysed(axis + "_period_by_crossings_s", "period, zero up-crossings, " + axis);
  }
}

void add_contact(Rows& rows) {
  rows.analysed("contact_fraction", "share of the samples with contact");
  rows.number("events", "hits on the platform", [](const ComparedRun& run) { return run.findings.loads.events; });
  rows.number("arrivals", "different floes that hit the platform",
              [](const ComparedRun& run) { return run.findings.loads.arrivals; });
}

}  // namespace

RunData since(RunData run, double from_s) {
  const std::size_t first = sample_from(run, from_s);
  PlatformRecord& p = run.platform;
  for (auto* column : {&p.time, &p.x, &p.y, &p.ice_force_x, &p.ice_force_y, &p.ice_force_mean_x, &p.ice_force_mean_y,
                       &p.mooring_force_x, &p.mooring_force_y, &p.contacts})
    drop(*column, first);
  run.events = events_since(run.events, from_s);
  return run;
}

std::vector<ComparedRow> compared_rows(const std::vector<ComparedRun>& runs) {
  Rows rows(runs);
  rows.text("verdict", "verdict on the run",
            [](const ComparedRun& run) { return std::string(grade_name(run.data.verdict.grade)); });
  rows.text("verdict_reasons", "why it is not good", [](const ComparedRun& run) {
    const std::string doubts = doubts_of(run.data.verdict);
    return doubts.empty() ? "-" : doubts;
  });
  rows.text("status", "status of the file", [](const ComparedRun& run) { return run.data.identity.status; });
  rows.number("duration_s", "simulated time", [](const ComparedRun& run) { return run.data.duration_s; });
  add_loads(rows);
  add_motion(rows);
  add_contact(rows);
  rows.number("overlap_largest_m", "deepest overlap",
              [](const ComparedRun& run) { return run.findings.quality.maximum_overlap; });
  rows.number("sim_rate", "simulated over wall time",
              [](const ComparedRun& run) { return run.findings.quality.speed; });
  rows.text("engine", "engine", [](const ComparedRun& run) { return run.data.identity.engine; });
  rows.text("program", "program", [](const ComparedRun& run) { return run.data.identity.source; });
  rows.text("state_hash", "state hash", [](const ComparedRun& run) { return run.data.identity.state_hash; });
  return rows.list;
}

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
                                     ") for many runs see `gem sweep collect`");
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
