// Lays out the tables of a sensitivity study around its pictures.
#include "gem/report/sweep/sensitivity_page.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/page_frame.h"
#include "gem/report/plain_text.h"
#include "gem/report/sweep/sensitivity_figures.h"

namespace gem {
namespace {

constexpr std::size_t kConditionsDrawn = 6;  // more have tables only

std::string cells(const std::vector<std::string>& texts) {
  std::string html;
  for (const std::string& text : texts) html += "<td>" + text + "</td>";
  return html;
}

std::string head_row(const std::vector<std::string>& texts) {
  std::string html = "<tr>";
  for (const std::string& text : texts) html += "<th scope=\"col\">" + text + "</th>";
  return html + "</tr>\n";
}

std::string row_html(const std::string& name, const std::vector<std::string>& texts) {
  return "<tr><th scope=\"row\">" + name + "</th>" + cells(texts) + "</tr>\n";
}

std::string table_html(const std::string& caption, const std::string& rows) {
  return "<table class=\"runs\"><caption>" + caption + "</caption>\n" + rows + "</table>\n";
}

std::string inputs_html(const Study& study) {
  std::string rows = head_row({"input", "key", "distribution", "smallest and largest that was drawn"});
  for (std::size_t k = 0; k < study.inputs.size(); ++k) {
    const auto less = [k](const StudyRun& a, const StudyRun& b) { return a.inputs[k] < b.inputs[k]; };
    const auto [low, high] = std::minmax_element(study.runs.begin(), study.runs.end(), less);
    const StudyInput& input = study.inputs[k];
    rows += row_html(escaped(input.name), {"<code>" + escaped(input.key) + "</code>", escaped(input.law),
                                           number_text(low->inputs[k], 6) + ", " + number_text(high->inputs[k], 6)});
  }
  return table_html("What was drawn", rows);
}

std::string loads_html(const ConditionEffects& condition) {
  std::string rows = head_row({"result", "mean", "standard deviation", "90 % quantile", "smallest", "largest", "runs"});
  for (const OutputEffects& effects : condition.outputs) {
    const auto text = [&](const std::optional<IntervalEstimate>& estimate) {
      return estimate ? output_text(effects.output, *estimate) : std::string("-");
    };
    rows += row_html(
        escaped(output_words(effects.output)),
        {text(effects.mean), text(effects.deviation), text(effects.p90), output_text(effects.output, effects.smallest),
         output_text(effects.output, effects.largest), std::to_string(effects.runs)});
  }
  return table_html("Results over the draws, with 95 % intervals", rows);
}

std::string coefficient_text(const IntervalEstimate& c) {
  return decimal_text(c.value, 2) + " [" + decimal_text(c.low, 2) + ", " + decimal_text(c.high, 2) + "]";
}

std::string shares_html(const Study& study, const OutputEffects& effects) {
  std::string rows = head_row({"input", "effect", "linear trend", "monotone trend", "first order", "total"});
  for (std::size_t k = 0; k < study.inputs.size(); ++k) {
    const InputEffect& effect = effects.inputs[k];
    const auto share = [](const std::optional<TrendShare>& trend) {
      return share_text(trend ? std::optional(trend->share) : std::nullopt);
    };
    rows += row_html(escaped(study.inputs[k].name),
                     {effect.linear ? coefficient_text(effect.linear->coefficient) : "-", share(effect.linear),
                      share(effect.monotone), share_text(effect.first), share_text(effect.total)});
  }
  if (effects.linear_explained) {
    const auto percent = [](double value) { return decimal_text(100.0 * value, 0) + " %"; };
    const double linear = std::max(*effects.linear_explained, 0.0);
    const double monotone = std::max(*effects.monotone_explained, 0.0);
    rows += row_html("all trends together", {"-", percent(linear), percent(monotone), "-", "-"});
    rows +=
        row_html("rest: seeds, curvature, interplay", {"-", percent(1.0 - linear), percent(1.0 - monotone), "-", "-"});
  }
  std::string caption = "Shares of the variance: " + escaped(output_words(effects.output)) + " (" +
                        std::to_string(effects.draws) + " draws, " + std::to_string(effects.runs) + " runs)";
  if (!(effects.largest > effects.smallest)) return "<p>" + caption + ": all results are equal.</p>\n";
  return table_html(caption, rows);
}

/// One row per condition with the share that the pictures show.
std::string matrix_html(const SensitivityPage& page) {
  if (page.effects.size() < 2) return "";
  std::string html;
  for (std::size_t output = 0; output < page.study.outputs.size(); ++output) {
    std::vector<std::string> head = {"condition"};
    for (const StudyInput& input : page.study.inputs) head.push_back(escaped(input.name));
    std::string rows = head_row(head);
    for (const ConditionEffects& condition : page.effects) {
      std::vector<std::string> texts;
      for (std::size_t k = 0; k < page.study.inputs.size(); ++k)
        texts.push_back(share_text(leading_share(page.study.inputs[k], condition.outputs[output].inputs[k])));
      rows += row_html(escaped(condition.condition), texts);
    }
    html += table_html("Shares by condition: " + escaped(output_words(page.study.outputs[output])), rows);
  }
  return html;
}

std::string notes_html(const SensitivityPage& page) {
  std::string from = page.from_s > 0.0 ? " The first " + time_text(page.from_s) + " of each run were left out." : "";
  return "<p class=\"notes\">Shares are parts of the variance of a result over all runs; brackets are 95 % intervals "
         "by "
         "resampling the draws." +
         from +
         " <em>Effect</em>: standard deviations of the result for one of the input, in a "
         "linear regression on all inputs. <em>Linear trend</em>: its square. <em>Monotone trend</em>: the same with "
         "ranks, "
         "which a curved trend or a few large loads disturb less. <em>First order</em>: Sobol index, what the input "
         "explains "
         "alone, of any form. <em>Total</em>: what it explains alone and together with others; for seeds the scatter "
         "between "
         "runs that differ in nothing else. Estimates below 0 are chance. An interval that begins at 0 does not show "
         "any effect. The square of a "
         "coefficient is a little too large when its interval is wide. In a Latin hypercube intervals are too wide "
         "rather "
         "than too narrow. A largest load is a single draw of its run: part of its scatter is the seed of the "
         "field.</p>\n";
}

std::string condition_html(const SensitivityPage& page, std::size_t condition, const PlotFolder& plots) {
  const ConditionEffects& effects = page.effects[condition];
  std::string html;
  if (!effects.condition.empty()) html += "<h2>" + escaped(effects.condition) + "</h2>\n";
  html += loads_html(effects);
  for (const OutputEffects& output : effects.outputs) html += shares_html(page.study, output);
  if (condition < kConditionsDrawn)
    html += figure_section("Pictures", sensitivity_figures(page, condition, plots), false);
  return html;
}

std::string csv_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : plain_text(text)) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

void write_sensitivity_runs(const SensitivityPage& page, const std::filesystem::path& path) {
  std::ofstream file(path, std::ios::binary);
  file << "run,condition,draw,part,repeat";
  for (const StudyInput& input : page.study.inputs) file << ',' << csv_text(input.name);
  for (const std::string& output : page.study.outputs) file << ',' << csv_text(output);
  file << '\n';
  for (const StudyRun& run : page.study.runs) {
    file << csv_text(run.name) << ',' << csv_text(run.condition) << ',' << run.draw << ',' << csv_text(run.part) << ','
         << run.repeat;
    for (const double value : run.inputs) file << ',' << number_text(value);
    for (const double value : run.outputs) file << ',' << (std::isfinite(value) ? number_text(value) : "");
    file << '\n';
  }
  file.close();
  if (!file)
    throw Error(ExitCode::file_system,
                "cannot write " + path.string() + " (disk full or no permission); choose another output folder");
}

void write_sensitivity_page(const SensitivityPage& page, const std::string& out_dir) {
  const std::filesystem::path folder(out_dir);
  const std::string title = escaped(page.sweep) + " - scatter of a sweep";
  check_page_folder(folder, title, "page of the scatter of " + page.sweep);
  const PlotFolder plots(folder / "figures", "");
  std::string body = "<header><h1>" + escaped(page.sweep) +
                     "</h1>\n<p>Where the scatter comes from: " + std::to_string(page.study.runs.size()) + " of " +
                     std::to_string(page.listed) + " runs, " + std::to_string(page.study.inputs.size()) +
                     " drawn inputs</p></header>\n";
  body += inputs_html(page.study) + matrix_html(page);
  for (std::size_t condition = 0; condition < page.effects.size(); ++condition)
    body += condition_html(page, condition, plots);
  body += notes_html(page) + "<p class=\"notes\"><a href=\"runs.csv\">All runs as CSV</a></p>\n";
  write_page(folder, html_page(title, body));
  write_sensitivity_runs(page, folder / "runs.csv");
}

}  // namespace gem
