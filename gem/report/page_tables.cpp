// The rows of the tables, with units and intervals.
#include "gem/report/page_tables.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <utility>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/page_frame.h"

namespace gem {
namespace {

std::string row(const std::string& name, std::initializer_list<std::string> cells) {
  std::string html = "<tr><th scope=\"row\">" + name + "</th>";
  for (const std::string& cell : cells) html += "<td>" + cell + "</td>";
  return html + "</tr>\n";
}

std::string table(const std::string& caption, const std::string& rows) {
  return "<table><caption>" + caption + "</caption>\n" + rows + "</table>\n";
}

std::string stated(const std::string& text) { return text.empty() ? "not stated" : escaped(text); }

std::string code(const std::string& text) { return text.empty() ? "not stated" : "<code>" + escaped(text) + "</code>"; }

std::string measured_text(double value, const char* unit) {
  return std::isnan(value) ? "not measured" : exponent_text(value) + unit;
}

/// "12.3 &plusmn; 0.4 mm": both rounded to the second digit of the uncertainty.
std::string mean_text(const Finding& mean, const Unit& unit) {
  if (!mean.value) return "record too short";
  if (!mean.interval) return with_unit(*mean.value, unit) + ", record too short for an interval";
  const double half = 0.5 * (mean.interval->high - mean.interval->low) / unit.size;
  const int decimals = half > 0.0 ? std::clamp(1 - static_cast<int>(std::floor(std::log10(half))), 0, 9) : 3;
  return decimal_text(*mean.value / unit.size, decimals) + " &plusmn; " + decimal_text(half, decimals) + " " +
         unit.name;
}

std::string ends_text(const IntervalEstimate& interval, const Unit& unit) {
  return rounded_text(interval.low / unit.size, 3) + " to " + with_unit(interval.high, unit);
}

std::string at_time(double time, double duration) { return " at " + with_unit(time, time_unit(duration)); }

const Unit kSeconds{"s", 1.0};
const Unit kSpeed{"m/s", 1.0};

std::string period_text(const Finding& period) {
  if (!is_resolved(period) || !period.interval) return "not resolved";
  return with_unit(*period.value, kSeconds) + " (" + ends_text(*period.interval, kSeconds) + ")";
}

std::string contact_text(const Finding& fraction) {
  if (!fraction.value) return "record too short";
  const Unit percent{"%", 0.01};
  return with_unit(*fraction.value, percent) +
         (fraction.interval ? " (" + ends_text(*fraction.interval, percent) + ")" : "");
}

std::string figure_of_run(const std::string& value, const std::string& meaning) {
  return "<div><strong>" + value + "</strong><span>" + meaning + "</span></div>\n";
}

std::string main_period_html(const RunData& run, const Finding& period) {
  if (!period.value || !period.interval) return "";
  std::string meaning = "main period in x, " + ends_text(*period.interval, kSeconds);
  if (run.natural_period_s > 0.0) meaning += "; natural period along x " + with_unit(run.natural_period_s, kSeconds);
  return figure_of_run(is_resolved(period) ? with_unit(*period.value, kSeconds) : "not resolved", meaning);
}

bool is_transit(const RunData& run) { return run.transit.present; }

/// What holds the platform, if it is no ship in transit.
std::string holder_text(const RunData& run) { return run.dp.thruster.empty() ? "mooring" : "thruster"; }

std::string force_text(double force) { return with_unit(force, force_unit(std::abs(force))); }

/// " at 487.4 s, 12 degrees from +x"; nothing without a force.
std::string where_text(double force, const ForceAt& at, const std::string& before = " at ") {
  if (force == 0.0) return "";
  return before + number_text(at.time_s, 6) + " s, " + decimal_text(at.direction_rad * 180.0 / std::numbers::pi, 0) +
         "&deg; from +x";
}

/// An excursion; rounding is no motion.
std::string excursion_text(double excursion, const Unit& unit) {
  return std::abs(excursion) < kLeastMotion ? "none" : with_unit(excursion, unit);
}

/// A length and its share of the size of a body.
std::string with_share(double depth, double share) {
  return with_unit(depth, length_unit(depth)) + ", " + rounded_text(100.0 * share, 2) + " % of the smaller body";
}
std::string impulse_text(double impulse) { return with_unit(impulse, impulse_unit(std::abs(impulse))); }

}  // namespace

std::string headline_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis) {
  std::string html = "<section class=\"headline\">\n";
  if (is_transit(run) && !run.platform.time.empty()) {
    const double distance = run.transit.distance.back();
    html += figure_of_run(with_unit(distance, length_unit(distance)), "along the path");
    if (run.transit.free)
      html += figure_of_run(with_unit(finding_of(analysis, "transit_speed_mean_m_per_s").value.value_or(0.0), kSpeed),
                            "mean speed");
    html += figure_of_run(force_text(finding_of(analysis, "resistance_mean_N").value.value_or(0.0)),
                          "mean resistance of the ice");
    html += figure_of_run(force_text(findings.loads.ice_window_largest),
                          "largest ice force averaged over " + number_text(run.force_window_s, 6) + " s");
  } else if (!run.platform.time.empty()) {
    html += figure_of_run(excursion_text(findings.radial_excursion, length_unit(findings.radial_excursion)),
                          "largest excursion of the platform");
    html += main_period_html(run, finding_of(analysis, "x_period_by_spectrum_s"));
    const bool untouched = without_contact(run, findings.loads);
    const bool still = untouched && findings.radial_excursion < kLeastMotion;
    if (run.is_held)
      html += figure_of_run(still ? "no contact" : force_text(findings.loads.mooring_largest),
                            "largest " + holder_text(run) + " force");
    html += figure_of_run(untouched ? "no contact" : force_text(findings.loads.ice_window_largest),
                          "largest ice force averaged over " + number_text(run.force_window_s, 6) + " s");
  }
  if (findings.quality.speed > 0.0)
    html += figure_of_run(rounded_text(findings.quality.speed, 3) + " &times;", "real time");
  html += figure_of_run(grade_name(run.verdict.grade), "verdict on the run");
  return html + "</section>\n";
}

std::string verdict_html(const RunVerdict& verdict) {
  std::string rows = row("the run", {std::string("<strong>") + grade_name(verdict.grade) + "</strong>"});
  for (const Judgement& one : verdict.judgements) {
    std::string name = one.criterion;
    std::replace(name.begin(), name.end(), '_', ' ');
    rows += row(escaped(name), {std::string(grade_name(one.grade)) + ": " + escaped(one.text)});
  }
  return table("Verdict", rows);
}

std::string identity_html(const RunData& run) {
  const RunIdentity& id = run.identity;
  std::string rows = row("case", {stated(id.name)}) + row("status", {stated(id.status)}) +
                     row("simulated time", {number_text(run.duration_s, 6) + " s"}) +
                     row("floes", {std::to_string(run.floe_outlines.size())}) + row("engine", {stated(id.engine)}) +
                     row("contact solver", {stated(id.solver)}) +
                     row("time step", {number_text(id.time_step_s, 6) + " s"}) + row("threads", {stated(id.threads)}) +
                     row("seed", {stated(id.seed)}) + row("program", {stated(id.build)}) +
                     row("written", {stated(id.history)}) + row("case hash", {code(id.case_hash)}) +
                     row("state hash", {code(id.state_hash)});
  return table("Identity", rows);
}

std::string motion_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis) {
  if (run.platform.time.empty() || is_transit(run)) return "";  // a ship on its way has no rest
  if (findings.radial_excursion < kLeastMotion)
    return table("Motion of the platform", row("largest excursion from rest", {"none"}));
  const AxisMotion& x = findings.x;
  const AxisMotion& y = findings.y;
  const Unit unit = length_unit(findings.radial_excursion);
  const auto named = [&](const std::string& name) { return finding_of(analysis, name); };
  std::string rows =
      "<tr><td></td><th scope=\"col\">x</th><th scope=\"col\">y</th></tr>\n" +
      row("mean offset, 95 % interval", {mean_text(named("x_offset_m"), unit), mean_text(named("y_offset_m"), unit)}) +
      row("standard deviation", {with_unit(x.deviation, unit), with_unit(y.deviation, unit)}) +
      row("largest excursion from rest", {with_unit(x.excursion, unit) + at_time(x.excursion_time, run.duration_s),
                                          with_unit(y.excursion, unit) + at_time(y.excursion_time, run.duration_s)}) +
      row("in the plane",
          {with_unit(findings.radial_excursion, unit) + at_time(findings.radial_time, run.duration_s), ""});
  const std::pair<const char*, const char*> ways[] = {{"period, spectral peak", "period_by_spectrum_s"},
                                                      {"period, zero up-crossings", "period_by_crossings_s"},
                                                      {"period, local maxima", "period_by_maxima_s"}};
  for (const auto& [words, name] : ways)
    rows += row(words, {period_text(named(std::string("x_") + name)), period_text(named(std::string("y_") + name))});
  const auto natural = [](double period) { return period > 0.0 ? rounded_text(period, 4) + " s" : "none"; };
  if (run.natural_period_s > 0.0 || run.natural_period_y_s > 0.0)
    rows += row("natural period, 2&pi;&radic;(M/k)", {natural(run.natural_period_s), natural(run.natural_period_y_s)});
  return table("Motion of the platform", rows);
}

namespace {

/// Nothing for a ship that is towed.
std::string speed_rows(const RunData& run, const std::vector<Finding>& analysis) {
  if (!run.transit.free) return "";
  return row("speed averaged over the run", {mean_text(finding_of(analysis, "transit_speed_mean_m_per_s"), kSpeed)});
}

std::string mean_force_text(const Finding& mean) {
  return mean_text(mean, force_unit(std::abs(mean.value.value_or(0.0))));
}

/// What the thrust or the tow gives along the path, and what holds the ship across it.
std::string pull_rows(const RunData& run, const std::vector<Finding>& analysis) {
  const std::string name = run.transit.free ? "thrust" : "tow", words = run.transit.free ? "net thrust" : "tow force";
  const auto largest = [&](const std::string& of) { return force_text(finding_of(analysis, of).value.value_or(0.0)); };
  return row(words + " along the path, averaged over the run",
             {mean_force_text(finding_of(analysis, name + "_mean_N"))}) +
         row(words + " along the path, largest", {largest(name + "_largest_N")}) +
         row("force that holds the ship across its path, largest", {largest("hold_across_largest_N")});
}

/// Nothing where neither water nor wind drags the platform.
std::string drag_rows(const RunData& run, const std::vector<Finding>& analysis) {
  if (run.platform.drag_force_x.empty()) return "";
  std::string rows;
  for (const std::string axis : {"x", "y"})
    rows += row(run.dragged_by + " averaged over the run, " + axis,
                {mean_force_text(finding_of(analysis, "drag_force_" + axis + "_mean_N"))});
  return rows;
}

/// Nothing without transit.
std::string resistance_rows(const RunData& run, const std::vector<Finding>& analysis) {
  if (!is_transit(run)) return "";
  const std::string window = number_text(run.force_window_s, 6) + " s";
  const auto value = [&](const char* name) { return force_text(finding_of(analysis, name).value.value_or(0.0)); };
  return speed_rows(run, analysis) +
         row("resistance averaged over the run", {mean_force_text(finding_of(analysis, "resistance_mean_N"))}) +
         row("resistance averaged over " + window + ", 99 % below", {value("resistance_window_p99_N")}) +
         row("resistance averaged over " + window + ", largest", {value("resistance_window_largest_N")}) +
         pull_rows(run, analysis);
}

}  // namespace

std::string loads_html(const RunData& run, const RunFindings& findings, const std::vector<Finding>& analysis) {
  if (run.platform.time.empty()) return "";
  const PlatformLoads& l = findings.loads;
  const std::string window = number_text(run.force_window_s, 6) + " s";
  const std::string sample = number_text(l.sample_s, 6) + " s";
  const Unit mean_unit = force_unit(std::hypot(l.ice_mean_x, l.ice_mean_y));
  // A killed run loses its last events, and all of them if there are few.
  const bool cut = run.identity.status == "running";
  const auto of_events = [cut](const std::string& text) { return cut ? "not known: the run was cut off" : text; };
  const bool untouched = without_contact(run, l);
  const bool still = untouched && findings.radial_excursion < kLeastMotion;
  const auto of_ice = [untouched](const std::string& text) { return untouched ? "no contact" : text; };
  // What one contact gives in a short time is wrong first where the iterations stop short.
  const std::string doubt = untouched ? "" : doubt_text(run.verdict);
  const auto of_short = [&](const std::string& text) { return of_ice(text) + doubt; };
  const auto of_mooring = [still](const std::string& text) { return still ? "no contact" : text; };
  const double sample_force = l.sample_s > 0.0 ? l.sample_impulse_largest / l.sample_s : 0.0;
  std::string rows =
      resistance_rows(run, analysis) +
      row("impulse of one hit, largest", {of_short(of_events(impulse_text(l.event_impulse_largest)))}) +
      row("ice force averaged over one sample (" + sample + "), largest",
          {of_short(force_text(sample_force) +
                    where_text(sample_force, l.ice_sample_at, " in the " + sample + " up to "))}) +
      row("ice force averaged over " + window + ", largest",
          {of_short(force_text(l.ice_window_largest) +
                    where_text(l.ice_window_largest, l.ice_window_at, " in the " + window + " up to "))}) +
      row("ice force averaged over the run, x",
          {of_ice(mean_text(finding_of(analysis, "ice_force_x_mean_N"), mean_unit))}) +
      row("ice force averaged over the run, y",
          {of_ice(mean_text(finding_of(analysis, "ice_force_y_mean_N"), mean_unit))}) +
      row(run.events.resolved ? "force of one hit, largest" : "crushing peak (closed form) of one hit, largest",
          {of_short(of_events(force_text(l.crushing_largest)))}) +
      row(run.events.resolved ? "largest force of a hit, median" : "crushing peak of a hit, median",
          {of_short(of_events(force_text(l.crushing_median)))}) +
      (run.is_held && !is_transit(run)
           ? row(holder_text(run) + " force, largest",
                 {of_mooring(force_text(l.mooring_largest) + where_text(l.mooring_largest, l.mooring_at))}) +
                 row(holder_text(run) + " force averaged over the run, x",
                     {of_mooring(mean_force_text(finding_of(analysis, "mooring_force_x_mean_N")))}) +
                 row(holder_text(run) + " force averaged over the run, y",
                     {of_mooring(mean_force_text(finding_of(analysis, "mooring_force_y_mean_N")))})
           : "") +
      drag_rows(run, analysis) +
      row("hits on the platform, each from first touch to release", {of_events(std::to_string(l.events))}) +
      row("different floes that hit the platform", {of_events(std::to_string(l.arrivals))}) +
      row("samples with contact", {contact_text(finding_of(analysis, "contact_fraction"))});
  return table("Loads on the platform", rows);
}

std::string sides_html(const RunData& run) {
  if (run.sides.empty()) return "";
  constexpr std::size_t rows_maximum = 12;
  std::vector<SideRecord> sides = run.sides;
  double all = 0.0;
  for (const SideRecord& side : sides) all += side.impulse;
  const bool some = sides.size() > rows_maximum;
  if (some) {
    std::stable_sort(sides.begin(), sides.end(), [](const auto& a, const auto& b) { return a.impulse > b.impulse; });
    sides.resize(rows_maximum);
  }
  std::string rows =
      "<tr><td></td><th scope=\"col\">length</th><th scope=\"col\">impulse that presses, share</th><th "
      "scope=\"col\">largest mean of one sample</th></tr>\n";
  for (const SideRecord& side : sides) {
    const double share = all > 0.0 ? side.impulse / all : 0.0;
    rows += row(escaped(side.name),
                {with_unit(side.length, Unit{"m", 1.0}),
                 side.impulse > 0.0 ? impulse_text(side.impulse) + ", " + with_unit(share, Unit{"%", 0.01}) : "none",
                 side.largest_force > 0.0 ? force_text(side.largest_force) + at_time(side.largest_time, run.duration_s)
                                          : "none"});
  }
  return table(some ? "Loads by side of the platform, the dozen that took most" : "Loads by side of the platform",
               rows);
}

std::string lines_html(const RunData& run) {
  if (run.lines.empty()) return "";
  std::string rows =
      "<tr><td></td><th scope=\"col\">largest tension</th><th scope=\"col\">of its strength</th><th "
      "scope=\"col\">broke</th></tr>\n";
  for (std::size_t k = 0; k < run.lines.size(); ++k) {
    const LineRecord& line = run.lines[k];
    const LargestTension largest = largest_tension(line, 0);
    const bool known = largest.sample < run.platform.time.size() && !line.tension.empty();
    rows += row("line " + std::to_string(k + 1),
                {known ? force_text(largest.value) + at_time(run.platform.time[largest.sample], run.duration_s)
                       : "not recorded",
                 known && line.strength > 0.0 ? with_unit(largest.value / line.strength, Unit{"%", 0.01}) : "-",
                 line.break_time > 0.0 ? "at " + with_unit(line.break_time, time_unit(run.duration_s)) : "no"});
  }
  return table("Mooring lines", rows);
}

std::string dp_html(const RunData& run) {
  if (run.dp.thruster.empty() || run.dp.offset.empty()) return "";
  const std::vector<Finding> findings = dp_findings(run.dp, 0);
  const auto value = [&](const char* name) { return finding_of(findings, name).value.value_or(0.0); };
  const auto metres = [&](const char* name) { return with_unit(value(name), length_unit(value(name))); };
  const auto share = [&](const char* name) { return with_unit(value(name), Unit{"%", 0.01}); };
  double installed = 0.0;
  for (const ThrusterSamples& t : run.dp.thruster) installed += t.maximum;
  return table("Dynamic positioning",
               row("offset from the set point, median", {metres("dp_offset_median_m")}) +
                   row("offset from the set point, 99 % below", {metres("dp_offset_p99_m")}) +
                   row("offset from the set point, largest", {metres("dp_offset_largest_m")}) +
                   row("yaw from its set point, largest",
                       {with_unit(value("dp_yaw_largest_rad"), Unit{"degrees", std::numbers::pi / 180.0})}) +
                   row("force asked for, largest", {force_text(value("dp_demand_largest_N"))}) +
                   row("force of all thrusters together", {force_text(installed)}) +
                   row("use of it, averaged over the run", {share("dp_thrust_utilisation")}) +
                   row("time with a thruster at its limit", {share("dp_time_at_limit_share")}));
}

std::string fixed_html(const RunData& run) {
  const std::vector<Finding> findings = fixed_findings(run.on_fixed, 0.0);
  if (findings.empty()) return "";
  std::string rows =
      "<tr><td></td><th scope=\"col\">mean, x</th><th scope=\"col\">mean, y</th><th scope=\"col\">largest of a "
      "frame</th></tr>\n";
  const auto add = [&](const std::string& words, const std::string& name) {
    const auto found = [&](const char* what) { return finding_of(findings, name + what); };
    const double largest = *found("_force_largest_N").value;
    if (largest > 0.0)
      rows += row(words, {mean_force_text(found("_force_x_mean_N")), mean_force_text(found("_force_y_mean_N")),
                          force_text(largest)});
    else
      rows += row(words, {"no contact", "no contact", "no contact"});
  };
  for (std::size_t k = 0; k < run.on_fixed.force.size(); ++k)
    add("fixed body " + std::to_string(k), "fixed_" + std::to_string(k));
  add("all [[fixed]] together", "fixed_all");
  return table("Force of the ice on fixed bodies", rows);
}

std::string quality_html(const RunData& run, const RunFindings& findings) {
  if (run.stats.time.empty()) return "";
  const RunQuality& q = findings.quality;
  return table("Books and speed",
               row("momentum unexplained, relative", {exponent_text(q.residual_momentum)}) +
                   row("angular momentum unexplained, relative", {exponent_text(q.residual_angular_momentum)}) +
                   row("energy unexplained, relative", {exponent_text(q.residual_energy)}) +
                   row("deepest overlap", {with_share(q.maximum_overlap, q.maximum_share)}) +
                   row("99.9 % of the overlaps are below", {with_share(q.most_overlap, q.most_share)}) +
                   row("complementarity error", {measured_text(q.complementarity, " m/s")}) +
                   row("friction beyond Coulomb's bound", {measured_text(q.cone_excess, " N s")}) +
                   row("energy created by the contacts of one time step", {measured_text(q.energy_created, " J")}) +
                   row("wall time", {with_unit(run.stats.wall_time.back(), Unit{"s", 1.0})}) +
                   row("speed", {rounded_text(q.speed, 3) + " &times; real time"}));
}

}  // namespace gem
