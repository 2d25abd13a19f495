// Draws one curve per run, in the order and colour of the table.
#include "gem/report/compare/compare_figures.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/figures/series.h"

namespace gem {
namespace {

constexpr std::size_t kPoints = 3000;  // of a curve

/// One picture of all runs: axes, and the file of each curve is NAME_NUMBER.csv with x in column 1 and y in column 2.
struct Overlay {
  std::string name, title, caption;
  std::string axes;  // gnuplot commands
  PlotSize size = {1000, 340};
};

std::string curve_file(const std::string& name, std::size_t run) { return name + "_" + std::to_string(run + 1); }

/// Colours repeat after six runs with another dash.
std::string curve_style(std::size_t run) {
  return std::string("lc rgb '") + run_colour(run) + "' lw 1.1 dt " + (run < 6 ? "solid" : "(8,3)");
}

Figure draw_overlay(const std::vector<ComparedRun>& runs, const Overlay& overlay, const PlotFolder& folder) {
  std::ostringstream commands;
  commands << overlay.axes << "plot ";
  for (std::size_t i = 0; i < runs.size(); ++i)
    commands << (i == 0 ? "" : ", ") << quoted(curve_file(overlay.name, i) + ".csv") << " using 1:2 with lines "
             << curve_style(i) << " title " << quoted(runs[i].label);
  commands << '\n';
  return folder.draw({overlay.name, overlay.title, overlay.caption, ""}, overlay.size, commands.str());
}

double longest(const std::vector<ComparedRun>& runs) {
  double duration = 0.0;
  for (const ComparedRun& run : runs) duration = std::max(duration, run.data.duration_s);
  return duration;
}

/// Axes of a record against time.
std::string time_axes(const std::vector<ComparedRun>& runs, const std::string& label) {
  double from = HUGE_VAL;
  for (const ComparedRun& run : runs) from = std::min(from, run.data.platform.time.front());
  const Unit time = time_unit(longest(runs));
  return "set xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\nset xlabel 'time [" + time.name +
         "]' offset 0,0.4\nset xrange [" + rounded_text(from / time.size, 6) + ":" +
         rounded_text(longest(runs) / time.size, 6) + "]\nset ylabel '" + label + "'\n";
}

template <class Value>
void write_record(const ComparedRun& run, const std::vector<std::size_t>& kept, const std::string& file,
                  const Unit& time, const Value& value, const PlotFolder& folder) {
  Csv csv("t [" + time.name + "],value");
  for (const std::size_t i : kept) csv.row({run.data.platform.time[i] / time.size, value(run.data, i)});
  folder.write_csv(file, csv);
}

double largest_length(const std::vector<double>& x, const std::vector<double>& y) {
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::hypot(x[i], y[i]));
  return largest;
}

Unit force_unit_of(const std::vector<ComparedRun>& runs) {
  double largest = 0.0;
  for (const ComparedRun& run : runs)
    largest = std::max(largest, largest_length(run.data.platform.ice_force_mean_x, run.data.platform.ice_force_mean_y));
  return force_unit(largest);
}

std::string windows_text(const std::vector<ComparedRun>& runs) {
  const double first = runs.front().data.force_window_s;
  const bool same =
      std::all_of(runs.begin(), runs.end(), [&](const ComparedRun& run) { return run.data.force_window_s == first; });
  return same ? number_text(first, 6) + " s" : "the force window of each run";
}

Figure draw_force(const std::vector<ComparedRun>& runs, const PlotFolder& folder) {
  const Unit unit = force_unit_of(runs);
  const Unit time = time_unit(longest(runs));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto force = [&](const RunData& run, std::size_t k) { return run.platform.ice_force_mean_x[k] / unit.size; };
    write_record(runs[i], envelope(runs[i].data.platform.ice_force_mean_x, kPoints / 2), curve_file("force", i), time,
                 force, folder);
  }
  return draw_overlay(
      runs,
      {"force", "Ice force, x", "x component of the ice force averaged over " + windows_text(runs) + ", against time.",
       time_axes(runs, "ice force, x [" + unit.name + "]")},
      folder);
}

/// Values at which the share of samples above is drawn: all of the largest, fewer of the others.
Csv exceedance_csv(const ComparedRun& run, const Unit& unit) {
  const PlatformRecord& p = run.data.platform;
  std::vector<double> force;
  for (std::size_t i = 0; i < p.time.size(); ++i)
    force.push_back(std::hypot(p.ice_force_mean_x[i], p.ice_force_mean_y[i]) / unit.size);
  std::sort(force.begin(), force.end(), std::greater<>());
  Csv csv("ice force [" + unit.name + "],share of the time above");
  const double samples = static_cast<double>(force.size());
  for (std::size_t rank = 0; rank < force.size(); rank = std::max(rank + 1, rank + rank / 50))
    csv.row({force[rank], (static_cast<double>(rank) + 1.0) / samples});
  return csv;
}

Figure draw_exceedance(const std::vector<ComparedRun>& runs, const PlotFolder& folder) {
  const Unit unit = force_unit_of(runs);
  for (std::size_t i = 0; i < runs.size(); ++i)
    folder.write_csv(curve_file("exceedance", i), exceedance_csv(runs[i], unit));
  return draw_overlay(runs,
                      {"exceedance", "Share of the time above an ice force",
                       "Share of the samples in which the ice force averaged over " + windows_text(runs) +
                           " (magnitude in the plane) is at least the value on the axis.",
                       "set xlabel 'ice force [" + unit.name +
                           "]' offset 0,0.4\nset ylabel 'share of the time'\nset logscale y\nset format y '10^{%L}'\n"
                           "set termoption enhanced\nset xrange [0:*]\n"},
                      folder);
}

Figure draw_motion(const std::vector<ComparedRun>& runs, const std::string& axis, const PlotFolder& folder) {
  double largest = 0.0;
  for (const ComparedRun& run : runs) largest = std::max(largest, run.findings.radial_excursion);
  const Unit unit = length_unit(largest);
  const Unit time = time_unit(longest(runs));
  const std::string name = "motion_" + axis;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto place = [&](const RunData& run, std::size_t k) {
      return (axis == "x" ? run.platform.x[k] - run.rest.x : run.platform.y[k] - run.rest.y) / unit.size;
    };
    write_record(runs[i], every(runs[i].data.platform.time.size(), kPoints), curve_file(name, i), time, place, folder);
  }
  return draw_overlay(
      runs,
      {name,
       "Platform motion " + axis + "(t)",
       std::string("Platform position ") + (axis == "x" ? "along" : "across") + " the current from rest, against time.",
       time_axes(runs, axis + " [" + unit.name + "]"),
       {1000, 300}},
      folder);
}

/// Four times the highest main or natural frequency; without either, all that the shortest spectrum has [Hz].
double frequency_limit(const std::vector<ComparedRun>& runs) {
  double base = 0.0, end = HUGE_VAL;
  for (const ComparedRun& run : runs) {
    const Spectrum& x = run.findings.x.spectrum;
    end = std::min(end, x.frequency(x.density.size() - 1));
    if (run.data.natural_period_s > 0.0) base = std::max(base, 1.0 / run.data.natural_period_s);
    if (run.findings.x.spectral) base = std::max(base, 1.0 / run.findings.x.spectral->period);
  }
  return base > 0.0 ? std::min(4.0 * base, end) : end;
}

Figure draw_spectra(const std::vector<ComparedRun>& runs, const PlotFolder& folder) {
  const double limit = frequency_limit(runs);
  double largest = 1e-20;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Spectrum& x = runs[i].findings.x.spectrum;
    Csv csv("f [mHz],S_x [m2/Hz]");
    for (std::size_t k = 1; k < x.density.size() && x.frequency(k) <= limit; ++k) {
      csv.row({1e3 * x.frequency(k), std::max(x.density[k], 1e-30)});  // a logarithmic axis has no zero
      largest = std::max(largest, x.density[k]);
    }
    folder.write_csv(curve_file("spectrum_x", i), csv);
  }
  const double top = std::pow(10.0, std::ceil(std::log10(largest) + 0.2));
  return draw_overlay(
      runs,
      {"spectrum_x", "Power spectra of x", "Power spectra of x (multitaper, NW = 2.5, four tapers).",
       "set xlabel 'frequency [mHz]' offset 0,0.4\nset ylabel 'power spectral density [m²/Hz]'\nset logscale y\n"
       "set format y '10^{%L}'\nset termoption enhanced\nset xrange [0:" +
           rounded_text(1e3 * limit, 4) + "]\nset yrange [" + exponent_text(1e-8 * top) + ":" + exponent_text(top) +
           "]\n"},
      folder);
}

}  // namespace

const char* run_colour(std::size_t run) {
  static const char* colours[] = {"#31688e", "#c2571a", "#35a37a", "#7a3d8f", "#a8900c", "#3c4149"};
  return colours[run % 6];
}

std::vector<Figure> compare_figures(const std::vector<ComparedRun>& runs, const PlotFolder& folder) {
  return {draw_force(runs, folder), draw_exceedance(runs, folder), draw_motion(runs, "x", folder),
          draw_motion(runs, "y", folder), draw_spectra(runs, folder)};
}

}  // namespace gem
