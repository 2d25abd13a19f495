// Reads each run, draws its picture, keeps its numbers, and lays them out.
#include "gem/report/sweep/sweep_report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/figures/figures.h"
#include "gem/report/page_frame.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/run_findings.h"
#include "gem/report/sweep/sweep_layout.h"

namespace gem {
namespace {

/// What the page shows of one run.
struct SweepPageCell {
  SweepPageRun run;
  std::string picture;  // SVG; empty without frames of the floes
  RunVerdict verdict;
  PlatformLoads loads;
  std::string holder;             // what holds the platform in its place; empty if nothing does
  double radial_excursion = 0.0;  // [m]
  double duration_s = 0.0;
  double force_window_s = 0.0;
  std::string source;
  std::vector<Finding> analysis;
};

SweepPageCell page_cell(const SweepPageRun& run, std::size_t number, std::optional<double> at_s,
                        const PlotFolder& folder) {
  SweepPageCell cell{run, "", {}, {}, "", 0.0, 0.0, 0.0, "", {}};
  if (run.path.empty()) return cell;
  RunData data = load_run(run.path, true);
  const RunFindings findings = run_findings(data);
  cell.verdict = data.verdict;
  cell.loads = findings.loads;
  if (data.is_held && !data.transit.present) cell.holder = data.dp.thruster.empty() ? "mooring" : "thrusters";
  cell.radial_excursion = findings.radial_excursion;
  cell.duration_s = data.duration_s;
  cell.force_window_s = data.force_window_s;
  cell.source = data.identity.source;
  cell.analysis = whole_run_analysis(data);
  // a run that stopped before has its numbers, and no picture
  if (at_s.value_or(0.0) > data.duration_s) {
    cell.run.status += ", ends at " + time_text(data.duration_s);
    return cell;
  }
  if (data.frames.size() < 3 || data.platform_outline.empty()) return cell;
  data = load_run(run.path, true, at_s.value_or(findings.loads.ice_window_at.time_s));
  cell.picture =
      small_field_figure(data, "run_" + std::to_string(number), "Ice around the platform, " + run.name, folder).svg;
  return cell;
}

void check_time_is_in_some(const std::vector<SweepPageCell>& cells, std::optional<double> at_s) {
  double longest = 0.0;
  for (const SweepPageCell& cell : cells) longest = std::max(longest, cell.duration_s);
  if (at_s.value_or(0.0) > longest)
    throw Error(ExitCode::usage, "no run has the time " + time_text(*at_s) + " (the longest ends at " +
                                     time_text(longest) + "); choose another --at");
}

std::string share_bar(double value, double largest) {
  return "<i style=\"width:" + decimal_text(largest > 0.0 ? 100.0 * value / largest : 0.0, 1) + "%\"></i>";
}

/// The verdict, with the criteria that gave it below it.
std::string grade_html(const SweepPageCell& cell) {
  const Grade grade = cell.verdict.grade;
  const std::string doubts = doubts_of(cell.verdict);
  const bool loud = grade == Grade::bad;
  return std::string(loud ? "<strong>" : "") + grade_name(grade) + (loud ? "</strong>" : "") +
         (doubts.empty() ? "" : "<br><small>" + escaped(doubts) + "</small>");
}

/// The largest loads of all runs, which fill the bars.
struct Largest {
  double ice = 0.0, mooring = 0.0;
};

Largest largest_loads(const std::vector<SweepPageCell>& cells) {
  Largest largest;
  for (const SweepPageCell& cell : cells)
    largest = {std::max(largest.ice, cell.loads.ice_window_largest),
               std::max(largest.mooring, cell.loads.mooring_largest)};
  return largest;
}

std::string force_text_of(double force) { return with_unit(force, force_unit(force)); }

std::string ice_text(const SweepPageCell& cell) {
  return force_text_of(cell.loads.ice_window_largest) + doubt_text(cell.verdict);
}

std::string holder_html(const SweepPageCell& cell, const Largest& largest) {
  if (cell.holder.empty()) return "";
  return "<p>" + cell.holder + " <span>" + force_text_of(cell.loads.mooring_largest) + "</span></p>" +
         share_bar(cell.loads.mooring_largest, largest.mooring);
}

/// What holds the platforms of a sweep: "mooring", "thrusters", both, or nothing.
std::string holders_text(const std::vector<SweepPageCell>& cells) {
  std::set<std::string> holders;
  for (const SweepPageCell& cell : cells)
    if (!cell.holder.empty()) holders.insert(cell.holder);
  std::string text;
  for (const std::string& holder : holders) text += (text.empty() ? "" : " or ") + holder;
  return text;
}

std::string cell_html(const SweepPageCell& cell, const Largest& largest) {
  const std::string name = "<b>" + escaped(cell.run.name) + "</b>";
  if (cell.run.path.empty()) return "<td>" + name + "<p>" + escaped(cell.run.status) + "</p></td>";
  return "<td>" + cell.picture + "<p>" + name + (cell.run.status == "done" ? "" : " " + escaped(cell.run.status)) +
         "<span>" + grade_html(cell) + "</span></p><p>ice <span>" + ice_text(cell) + "</span></p>" +
         share_bar(cell.loads.ice_window_largest, largest.ice) + holder_html(cell, largest) + "</td>";
}

std::string matrix_html(const std::vector<SweepPageCell>& cells) {
  std::vector<std::string> names;
  for (const SweepPageCell& cell : cells) names.push_back(cell.run.name);
  const SweepLayout layout = sweep_layout(names);
  const Largest largest = largest_loads(cells);
  // Without a matrix the cells follow each other in rows.
  const bool is_matrix = layout.columns.size() > 1;
  constexpr std::size_t width = 4;
  std::string html = "<table class=\"matrix\">\n";
  if (is_matrix) {
    html += "<tr><th scope=\"row\"></th>";
    for (const std::string& column : layout.columns) html += "<th scope=\"col\">" + escaped(column) + "</th>";
    html += "</tr>\n";
    for (std::size_t row = 0; row < layout.rows.size(); ++row) {
      html += "<tr><th scope=\"row\">" + escaped(layout.rows[row]) + "</th>";
      for (const auto& run : layout.cell[row]) html += run ? cell_html(cells[*run], largest) : "<td></td>";
      html += "</tr>\n";
    }
    return html + "</table>\n";
  }
  for (std::size_t i = 0; i < cells.size(); ++i)
    html += (i % width == 0 ? "<tr>" : "") + cell_html(cells[i], largest) +
            (i % width == width - 1 || i + 1 == cells.size() ? "</tr>\n" : "");
  return html + "</table>\n";
}

std::string mean_with_interval(const Finding& finding, const Unit& unit) {
  if (!finding.value) return "-";
  std::string text = rounded_text(*finding.value / unit.size, 3);
  if (finding.interval)
    text += " [" + rounded_text(finding.interval->low / unit.size, 3) + ", " +
            rounded_text(finding.interval->high / unit.size, 3) + "]";
  return text + " " + unit.name;
}

std::string table_row(const SweepPageCell& cell, bool with_holder) {
  std::string html =
      "<tr><th scope=\"row\">" + escaped(cell.run.name) + "</th><td>" + escaped(cell.run.status) + "</td>";
  if (cell.run.path.empty()) return html + "</tr>\n";
  const auto mean = [&](const char* name, double size) {
    const Finding finding = finding_of(cell.analysis, name);
    const double value = std::abs(finding.value.value_or(0.0));
    return mean_with_interval(finding, size > 0.0 ? length_unit(size) : force_unit(value));
  };
  html += "<td>" + grade_html(cell) + "</td><td>" + ice_text(cell) + "</td>";
  if (with_holder) html += "<td>" + (cell.holder.empty() ? "-" : force_text_of(cell.loads.mooring_largest)) + "</td>";
  for (const std::string& text :
       {mean("ice_force_x_mean_N", 0.0), mean("x_offset_m", std::max(cell.radial_excursion, 1e-9)),
        with_unit(cell.radial_excursion, length_unit(cell.radial_excursion)), std::to_string(cell.loads.events)})
    html += "<td>" + text + "</td>";
  return html + "</tr>\n";
}

std::string table_html(const std::vector<SweepPageCell>& cells) {
  std::string html = "<table class=\"runs\"><caption>The runs in numbers</caption>\n<tr>";
  const std::string holders = holders_text(cells);
  std::vector<std::string> heads = {"run", "status", "verdict", "largest ice force"};
  if (!holders.empty()) heads.push_back("largest force of " + holders);
  for (const char* head : {"mean ice force, x", "mean offset, x", "largest excursion", "events"}) heads.push_back(head);
  for (const std::string& head : heads) html += "<th scope=\"col\">" + head + "</th>";
  html += "</tr>\n";
  for (const SweepPageCell& cell : cells) html += table_row(cell, !holders.empty());
  return html + "</table>\n";
}

std::string notes_html(const std::vector<SweepPageCell>& cells, std::optional<double> at_s) {
  double window = 0.0;
  const std::string holders = holders_text(cells);
  for (const SweepPageCell& cell : cells) window = std::max(window, cell.force_window_s);
  const bool doubted =
      std::any_of(cells.begin(), cells.end(), [](const SweepPageCell& cell) { return stops_short(cell.verdict); });
  return "<p class=\"notes\">Each picture shows the ice around the platform " +
         (at_s ? "at " + time_text(*at_s) : std::string("when the ice force was largest")) +
         ", in the recorded frame nearest to that time; floes are coloured by speed, from dark (at rest) to yellow "
         "(the "
         "fastest of the run). <em>Ice</em> is the largest ice force averaged over " +
         number_text(window, 6) + " s" +
         (holders.empty() ? "" : ", <em>" + holders + "</em> the largest force of " + holders) +
         "; the bars are shares of the largest value of the sweep. A "
         "largest value is a single draw. Brackets are intervals of 95 % of one run." +
         (doubted
              ? " <em>Not converged</em> are runs whose time steps often end before their contacts agree: what acts "
                "for a short time is wrong there first."
              : "") +
         "</p>\n";
}

}  // namespace

void write_sweep_report(const std::string& sweep, const std::vector<SweepPageRun>& runs, const std::string& out_dir,
                        std::optional<double> at_s) {
  if (std::all_of(runs.begin(), runs.end(), [](const SweepPageRun& run) { return run.path.empty(); }))
    throw Error(ExitCode::usage, sweep +
                                     " has no run that can be shown (none is done); make them with `gem sweep run`, "
                                     "or include those that stopped with --allow-incomplete");
  const std::filesystem::path folder(out_dir);
  const std::string title = escaped(sweep) + " - report of a sweep";
  check_page_folder(folder, title, "report of " + sweep);
  const PlotFolder plots(folder / "figures", "");
  std::vector<SweepPageCell> cells;
  for (const SweepPageRun& run : runs) cells.push_back(page_cell(run, cells.size() + 1, at_s, plots));
  check_time_is_in_some(cells, at_s);
  const auto shown_runs =
      std::count_if(runs.begin(), runs.end(), [](const SweepPageRun& run) { return !run.path.empty(); });
  write_page(folder, html_page(title, "<header><h1>" + escaped(sweep) +
                                          "</h1>\n<p>Ice loads on a platform: " + std::to_string(shown_runs) + " of " +
                                          std::to_string(runs.size()) + " runs of a sweep</p></header>\n" +
                                          matrix_html(cells) + notes_html(cells, at_s) + table_html(cells)));
}

}  // namespace gem
