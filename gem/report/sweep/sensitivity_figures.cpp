// Bars of shares, and scatter pictures, drawn by gnuplot.
#include "gem/report/sweep/sensitivity_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/page_frame.h"

namespace gem {
namespace {

constexpr std::size_t kPanelsAcross = 4;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

std::size_t rows_of(std::size_t panels) { return (panels + kPanelsAcross - 1) / kPanelsAcross; }

Figure bars_figure(const SensitivityPage& page, std::size_t condition, const PlotFolder& folder) {
  const ConditionEffects& effects = page.effects[condition];
  const std::string name = "shares_" + std::to_string(condition + 1);
  const std::size_t inputs = page.study.inputs.size();
  Csv csv("input,output,share [%],low [%],high [%]");
  for (std::size_t o = 0; o < effects.outputs.size(); ++o)
    for (std::size_t k = 0; k < inputs; ++k) {
      const auto share = leading_share(page.study.inputs[k], effects.outputs[o].inputs[k]);
      const IntervalEstimate e = share.value_or(IntervalEstimate{kNothing, kNothing, kNothing});
      csv.row({static_cast<double>(k + 1), static_cast<double>(o + 1), 100.0 * e.value, 100.0 * e.low, 100.0 * e.high});
    }
  folder.write_csv(name, csv);
  std::ostringstream commands;
  commands << "set xrange [0.4:" << inputs
           << ".6]\nset yrange [0:105]\nset tmargin 5\nset ylabel 'share of the variance [%]'\n"
           << "set xtics (";
  for (std::size_t k = 0; k < inputs; ++k)
    commands << (k > 0 ? ", " : "") << quoted(page.study.inputs[k].name) << ' ' << k + 1;
  commands << ")\nset boxwidth " << 0.8 / static_cast<double>(effects.outputs.size()) << "\n";
  static const char* const colours[] = {"#31688e", "#c2571a", "#35a37a", "#8a8f98", "#6a329f", "#b58900"};
  const double width = 0.8 / static_cast<double>(effects.outputs.size());
  for (std::size_t o = 0; o < effects.outputs.size(); ++o) {
    const double shift = (static_cast<double>(o) - 0.5 * static_cast<double>(effects.outputs.size() - 1)) * width;
    const char* const colour = colours[o % 6];
    const std::string rows = "'" + name + ".csv' using (column(2)==" + std::to_string(o + 1) + " ? column(1)+(" +
                             decimal_text(shift, 4) + ") : NaN)";
    commands << (o == 0 ? "plot " : ", \\\n  ") << rows << ":3 with boxes linecolor rgb '" << colour << "' title "
             << quoted(output_words(effects.outputs[o].output)) << ", \\\n  " << rows << ":4:(0):(column(5)-column(4))"
             << " with vectors nohead linewidth 1.4 linecolor rgb '#1f2530'";
  }
  commands << '\n';
  return folder.draw({name, "Shares of the variance of each result",
                      "How much of the variance of each result comes from each input, with 95 % intervals.", ""},
                     {1000, 380}, commands.str());
}

/// A little more than the range, and three tics at round numbers: long numbers would run into each other.
std::string x_axis(double low, double high) {
  const double margin = 0.08 * (high > low ? high - low : 1.0);
  std::string text = "set xrange [" + number_text(low - margin) + ":" + number_text(high + margin) + "]\nset xtics (";
  for (const double at : {low, 0.5 * (low + high), high}) {
    const std::string label = number_text(at, 2);
    text += (text.back() == '(' ? "" : ", ") + quoted(label) + " " + label;
  }
  return text + ")\n";
}

std::string panel(const SensitivityPage& page, const std::string& name, std::size_t input) {
  const auto less = [input](const StudyRun& a, const StudyRun& b) { return a.inputs[input] < b.inputs[input]; };
  const auto [low, high] = std::minmax_element(page.study.runs.begin(), page.study.runs.end(), less);
  std::ostringstream commands;
  commands << "set xlabel " << quoted(page.study.inputs[input].name) << " offset 0,0.4\n"
           << x_axis(low->inputs[input], high->inputs[input]) << (input % kPanelsAcross == 0 ? "" : "unset ylabel\n")
           << "plot '" << name << ".csv' using " << input + 1 << ':' << page.study.inputs.size() + 1
           << " with points pointtype 7 pointsize 0.35 linecolor rgb '#31688e'\n";
  return commands.str();
}

Figure scatter_figure(const SensitivityPage& page, std::size_t condition, std::size_t output,
                      const PlotFolder& folder) {
  const OutputEffects& effects = page.effects[condition].outputs[output];
  const std::string name = "scatter_" + std::to_string(condition + 1) + "_" + std::to_string(output + 1);
  const std::size_t inputs = page.study.inputs.size();
  const double size = std::max(std::abs(effects.smallest), std::abs(effects.largest));
  Unit unit{"", 1.0};
  if (effects.output.ends_with("_N")) unit = force_unit(size);
  if (effects.output.ends_with("_m")) unit = length_unit(size);
  std::string header;
  for (std::size_t k = 0; k < inputs; ++k) header += "input " + std::to_string(k + 1) + ",";
  Csv csv(header + "result [" + (unit.name.empty() ? "1" : unit.name) + "]");
  for (const StudyRun& run : page.study.runs) {
    if (run.condition != page.effects[condition].condition) continue;
    std::vector<double> row = run.inputs;
    row.push_back(run.outputs[output] / unit.size);
    csv.row(row);
  }
  folder.write_csv(name, csv);
  std::ostringstream commands;
  commands << "set lmargin 9\nset bmargin 3.4\nset tmargin 1\nset xtics font ',10'\nset ytics font ',9'\n"
           << "set ylabel " << quoted(unit.name.empty() ? "result" : "[" + unit.name + "]") << " offset 1,0\n"
           << "set multiplot layout " << rows_of(inputs) << ',' << std::min(inputs, kPanelsAcross) << '\n';
  for (std::size_t k = 0; k < inputs; ++k) commands << panel(page, name, k);
  commands << "unset multiplot\n";
  return folder.draw(
      {name, "Result against each input: " + output_words(effects.output),
       "Each point is a run: " + escaped(output_words(effects.output)) + " against each drawn input.", ""},
      {1000, static_cast<int>(230 * rows_of(inputs))}, commands.str());
}

}  // namespace

std::vector<Figure> sensitivity_figures(const SensitivityPage& page, std::size_t condition, const PlotFolder& folder) {
  std::vector<Figure> figures = {bars_figure(page, condition, folder)};
  for (std::size_t output = 0; output < page.study.outputs.size(); ++output)
    figures.push_back(scatter_figure(page, condition, output, folder));
  return figures;
}

}  // namespace gem
