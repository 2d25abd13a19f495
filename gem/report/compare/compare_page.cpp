// Tables and figures of a comparison as one page.
#include "gem/report/compare/compare_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "gem/analysis/verdict/verdict_words.h"
#include "gem/base/number_text.h"
#include "gem/report/compare/compare_figures.h"
#include "gem/report/display.h"
#include "gem/report/page_frame.h"

namespace gem {
namespace {

constexpr const char* kCompareNotes = R"(<section><h2>How to read the table</h2>
<div class="notes"><p>Brackets are intervals of 95 % of one run. They are given only for records of at least 16 natural periods; a
largest value is a single draw and has none. <em>apart</em> means that the intervals have no common part: the runs differ by more than
chance explains. Intervals that overlap do not show that two numbers are equal. Runs that differ only minimally diverge after some
minutes, so single peaks differ between any two runs; compare means and distributions, over several seeds.</p></div></section>
)";

/// The unit in which a number of this size is read.
Unit unit_of(const std::string& name, double size) {
  if (name.ends_with("_N_s")) return impulse_unit(size);
  if (name.ends_with("_N")) return force_unit(size);
  if (name.ends_with("_m")) return length_unit(size);
  if (name.ends_with("_m_per_s")) return {"m/s", 1.0};
  if (name.ends_with("_s")) return {"s", 1.0};
  if (name.ends_with("_rad")) return {"rad", 1.0};
  if (name.ends_with("_fraction") || name.ends_with("_share") || name.starts_with("dp_thrust_")) return {"%", 0.01};
  return {"", 1.0};
}

std::string marked(const std::string& label, std::size_t run) {
  return std::string("<span style=\"color:") + run_colour(run) + "\">&#9632;</span> " + escaped(label);
}

std::string head_row(const Comparison& comparison, const std::string& last) {
  std::string html = "<tr><td></td>";
  for (std::size_t i = 0; i < comparison.runs.size(); ++i)
    html += "<th scope=\"col\">" + marked(comparison.runs[i].label, i) + "</th>";
  return html + (last.empty() ? "" : "<th scope=\"col\">" + last + "</th>") + "</tr>\n";
}

std::string differences_html(const Comparison& comparison) {
  if (comparison.differences.empty())
    return "<p class=\"notes\">The cases of these runs have the same keys and values.</p>\n";
  std::string html = "<table><caption>What differs in the cases</caption>\n" + head_row(comparison, "");
  for (const CaseDifference& difference : comparison.differences) {
    html += "<tr><th scope=\"row\"><code>" + escaped(difference.key) + "</code></th>";
    for (const std::string& value : difference.values) html += "<td><code>" + escaped(value) + "</code></td>";
    html += "</tr>\n";
  }
  return html + "</table>\n";
}

std::string numbers_html(const Comparison& comparison) {
  std::string html =
      "<table><caption>The runs in numbers, with intervals of 95 %</caption>\n" + head_row(comparison, "intervals");
  for (const ComparedRow& row : comparison.rows) {
    html += "<tr><th scope=\"row\">" + row.meaning + "</th>";
    for (const ComparedCell& cell : row.cells) html += "<td>" + escaped(cell_text(row, cell)) + "</td>";
    html += std::string("<td>") +
            (row.apart == Apart::yes  ? "<strong>apart</strong>"
             : row.apart == Apart::no ? "overlap"
                                      : "") +
            "</td></tr>\n";
  }
  html += "</table>\n";
  for (const std::string& sentence : missing_intervals(comparison))
    html += "<p class=\"notes\">" + escaped(sentence) + "</p>\n";
  return html;
}

std::string title_of(const Comparison& comparison) {
  std::string names;
  for (const ComparedRun& run : comparison.runs) names += (names.empty() ? "" : ", ") + escaped(run.label);
  return names + " - comparison of runs";
}

std::string warnings_html(const Comparison& comparison) {
  std::string html;
  for (const ComparedRun& run : comparison.runs) {
    const RunVerdict& verdict = run.data.verdict;
    if (verdict.grade == Grade::bad)
      html += "<p class=\"warning\">The numbers of " + escaped(run.label) + " cannot be believed: its verdict is " +
              escaped(verdict_text(verdict)) + ".</p>\n";
    if (verdict.grade == Grade::doubtful)
      html += "<p class=\"warning\">" + escaped(run.label) + " is " + escaped(verdict_text(verdict)) +
              (stops_short(verdict)
                   ? ". Its contacts had not converged: its loads of a short time are the first to be wrong"
                   : "") +
              ".</p>\n";
  }
  const double first = comparison.runs.front().data.duration_s;
  if (std::any_of(comparison.runs.begin(), comparison.runs.end(),
                  [&](const ComparedRun& run) { return std::abs(run.data.duration_s - first) > 1e-3 * first; }))
    html += "<p class=\"warning\">The runs differ in length. The largest values grow with the duration.</p>\n";
  return html;
}

}  // namespace

std::string cell_text(const ComparedRow& row, const ComparedCell& cell) {
  if (!cell.text.empty()) return cell.text;
  if (!cell.value) return cell.is_absent ? "-" : "not resolved";
  double largest = 0.0;  // one unit for the whole row
  for (const ComparedCell& each : row.cells) largest = std::max(largest, std::abs(each.value.value_or(0.0)));
  if (row.name.ends_with("_m") && largest < kLeastMotion) return "none";
  const Unit unit = unit_of(row.name, largest);
  const bool count = unit.name.empty() && *cell.value == std::floor(*cell.value);
  std::string text = count ? number_text(*cell.value) : rounded_text(*cell.value / unit.size, 3);
  if (cell.interval)
    text += " [" + rounded_text(cell.interval->low / unit.size, 3) + ", " +
            rounded_text(cell.interval->high / unit.size, 3) + "]";
  return text + (unit.name.empty() ? "" : " " + unit.name) + (cell.not_converged ? " (not converged)" : "");
}

void write_comparison(const Comparison& comparison, const std::string& out_dir) {
  const std::filesystem::path folder(out_dir);
  const std::string title = title_of(comparison);
  check_page_folder(folder, title, "comparison of these runs");
  const PlotFolder plots(folder / "figures", comparison.runs.front().data.identity.source);
  const std::string from = comparison.from_s > 0.0 ? ", from " + time_text(comparison.from_s) + " of each run on" : "";
  write_page(
      folder,
      html_page(title, "<header><h1>Comparison of " + std::to_string(comparison.runs.size()) +
                           " runs</h1>\n<p>Ice loads on a platform" + from + "</p></header>\n" +
                           warnings_html(comparison) + differences_html(comparison) + numbers_html(comparison) +
                           figure_section("The runs over each other", compare_figures(comparison.runs, plots), true) +
                           kCompareNotes));
}

}  // namespace gem
