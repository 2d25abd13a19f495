// The rows of a comparison: numbers that every run has, and those of thrusters, transit and fixed bodies where some has
// them.
#include <algorithm>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/report/compare/comparison.h"

namespace gem {
namespace {

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
      ComparedCell cell;
      cell.is_absent = !has(run, name);
      if (is_resolved(finding)) cell.value = finding.value, cell.interval = finding.interval;
      return cell;
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
  /// Whether the analysis of some run has this number.
  bool any(const std::string& name) const {
    return std::any_of(runs_.begin(), runs_.end(), [&](const ComparedRun& run) { return has(run, name); });
  }
  const std::vector<ComparedRun>& runs() const { return runs_; }
  std::vector<ComparedRow> list;

 private:
  static bool has(const ComparedRun& run, const std::string& name) {
    return std::any_of(run.analysis.begin(), run.analysis.end(),
                       [&](const Finding& finding) { return finding.name == name; });
  }
  template <class Cell>
  void add(const std::string& name, const std::string& meaning, const Cell& cell) {
    ComparedRow row{name, meaning, {}};
    for (const ComparedRun& run : runs_) row.cells.push_back(cell(run));
    row.apart = apart(row.cells);
    list.push_back(row);
  }
  const std::vector<ComparedRun>& runs_;
};

/// A number that only some runs have.
struct SpecialRow {
  const char* name;
  const char* meaning;
  bool is_short_load = false;
};

constexpr SpecialRow special_rows[] = {
    {"drag_force_x_mean_N", "drag of water and wind, mean, x"},
    {"drag_force_y_mean_N", "drag of water and wind, mean, y"},
    {"transit_distance_m", "distance along the path"},
    {"transit_speed_mean_m_per_s", "speed along the path, mean"},
    {"transit_speed_least_m_per_s", "speed along the path, least"},
    {"resistance_mean_N", "resistance of the ice, mean"},
    {"resistance_window_deviation_N", "resistance averaged over the force window, standard deviation"},
    {"resistance_window_p99_N", "resistance averaged over the force window, 99 % below", true},
    {"resistance_window_largest_N", "resistance averaged over the force window, largest", true},
    {"side_force_window_largest_N", "ice force across the path averaged over the force window, largest", true},
    {"thrust_mean_N", "net thrust along the path, mean"},
    {"thrust_largest_N", "net thrust along the path, largest"},
    {"tow_mean_N", "tow force along the path, mean"},
    {"tow_largest_N", "tow force along the path, largest", true},
    {"hold_across_largest_N", "force that holds the ship across its path, largest", true},
    {"dp_offset_median_m", "distance from the set point, median"},
    {"dp_offset_p90_m", "distance from the set point, 90 % below"},
    {"dp_offset_p99_m", "distance from the set point, 99 % below"},
    {"dp_offset_largest_m", "distance from the set point, largest"},
    {"dp_yaw_largest_rad", "yaw from its set point, largest"},
    {"dp_demand_largest_N", "force that the control asks for, largest"},
    {"dp_thrust_utilisation", "used thrust, mean"},
    {"dp_thrust_utilisation_largest", "used thrust, largest"},
    {"dp_time_at_limit_share", "share of the time with a thruster at its limit"}};

void add_special(Rows& rows) {
  for (const SpecialRow& row : special_rows) {
    if (!rows.any(row.name)) continue;
    rows.analysed(row.name, row.meaning);
    if (row.is_short_load) rows.short_load();
  }
}

/// Bodies of [[fixed]] are numbered from 0, as in the case.
void add_fixed(Rows& rows) {
  std::size_t bodies = 0;
  for (const ComparedRun& run : rows.runs()) bodies = std::max(bodies, run.data.on_fixed.force.size());
  for (std::size_t k = 0; k <= bodies; ++k) {
    const std::string name = "fixed_" + (k < bodies ? std::to_string(k) : "all") + "_force_";
    const std::string body = k < bodies ? "force on fixed body " + std::to_string(k) : "force on all fixed bodies";
    if (!rows.any(name + "x_mean_N")) continue;
    rows.analysed(name + "x_mean_N", body + ", mean, x");
    rows.analysed(name + "y_mean_N", body + ", mean, y");
    rows.analysed(name + "largest_N", body + " at a frame, largest");
    rows.short_load();
  }
}

/// What the force in the columns of the mooring comes from.
std::string holder_words(const Rows& rows) {
  const auto has_thrusters = [](const ComparedRun& run) { return !run.data.dp.thruster.empty(); };
  const auto& runs = rows.runs();
  if (std::all_of(runs.begin(), runs.end(), has_thrusters)) return "thruster force";
  return std::any_of(runs.begin(), runs.end(), has_thrusters) ? "mooring or thruster force" : "mooring force";
}

void add_loads(Rows& rows) {
  rows.analysed("ice_force_window_largest_N", "ice force averaged over the force window, largest");
  rows.short_load();
  const bool moored = rows.any("mooring_force_largest_N");
  if (moored) rows.analysed("mooring_force_largest_N", holder_words(rows) + ", largest");
  rows.analysed("ice_force_x_mean_N", "ice force, mean, x");
  rows.analysed("ice_force_y_mean_N", "ice force, mean, y");
  if (moored) rows.analysed("mooring_force_x_mean_N", holder_words(rows) + ", mean, x");
  rows.number("event_impulse_largest_N_s", "impulse of one hit, largest",
              [](const ComparedRun& run) { return run.findings.loads.event_impulse_largest; });
  rows.short_load();
  rows.number("crushing_peak_largest_N", "force (rigid ice: crushing peak) of one hit, largest",
              [](const ComparedRun& run) { return run.findings.loads.crushing_largest; });
  rows.short_load();
}

void add_motion(Rows& rows) {
  if (!rows.any("x_offset_m")) return;  // ships on their way have no rest
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
  add_special(rows);
  add_fixed(rows);
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

}  // namespace gem
