// The resistance of the ice along the path of a ship in transit.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "gem/analysis/statistics/moments.h"
#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/figures/figures.h"
#include "gem/report/figures/series.h"

namespace gem {
namespace {

constexpr std::size_t kTransitBins = 1500;

/// Mean from the start up to each sample.
std::vector<double> running_mean(const std::vector<double>& values) {
  std::vector<double> means;
  double sum = 0.0;
  for (const double value : values) {
    sum += value;
    means.push_back(sum / static_cast<double>(means.size() + 1));
  }
  return means;
}

/// Where a sample stands in the figure: along the path, or in time for a ship that may stand still.
const std::vector<double>& abscissa(const TransitRecord& transit) {
  return transit.free ? transit.time : transit.distance;
}

const char* abscissa_label(const TransitRecord& transit) {
  return transit.free ? "time [s]" : "distance along the path [m]";
}

void write_column(const TransitRecord& transit, const std::vector<double>& values, const char* name, const Unit& unit,
                  const PlotFolder& folder) {
  Csv csv(std::string(abscissa_label(transit)) + "," + name + " [" + unit.name + "]");
  for (const std::size_t i : envelope(values, kTransitBins)) csv.row({abscissa(transit)[i], values[i] / unit.size});
  folder.write_csv(name, csv);
}

/// Resistance, and for a ship that runs free what its thrust gives.
std::string resistance_plot(const RunData& run, const Unit& unit) {
  return "set ylabel 'resistance [" + unit.name +
         "]'\nset xlabel\nplot 'resistance.csv' using 1:2 with lines linestyle 1 lw 0.7 title 'mean over " +
         number_text(run.force_window_s, 6) +
         " s', 'resistance_mean.csv' using 1:2 with lines linestyle 2 lw 2 title 'mean so far'" +
         (run.transit.free ? ", 'thrust.csv' using 1:2 with lines linestyle 4 lw 1.5 title 'net thrust'" : "") +
         "\nunset label 99\n";
}

std::string caption_of(const TransitRecord& transit) {
  if (transit.free)
    return "A ship in transit that runs free. Top: its speed along the path. Middle: force of the ice against its "
           "course, and the thrust that open water leaves. Bottom: force of the ice to its left. Forces of the ice are "
           "means over output.force_window_s.";
  return "A ship in transit at " + number_text(transit.speed, 4) +
         " m/s. Top: force of the ice against its course. Bottom: force to its left. Both are means over "
         "output.force_window_s; open water is no part of them.";
}

}  // namespace

std::vector<Figure> transit_figures(const RunData& run, const PlotFolder& folder) {
  const TransitRecord& transit = run.transit;
  if (transit.distance.size() < kSamplesForStatistics) return {};
  double largest = std::max(std::abs(maximum_excursion(transit.resistance_window).value),
                            std::abs(maximum_excursion(transit.side_window).value));
  if (transit.free) largest = std::max(largest, std::abs(maximum_excursion(transit.pull).value));
  const Unit unit = force_unit(largest), speed{"m/s", 1.0};
  write_column(transit, transit.resistance_window, "resistance", unit, folder);
  write_column(transit, running_mean(transit.resistance), "resistance_mean", unit, folder);
  write_column(transit, transit.side_window, "side_force", unit, folder);
  std::ostringstream commands;
  commands << "set multiplot layout " << (transit.free ? 3 : 2)
           << ",1\nset xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\n"
           << "set xrange [0:" << rounded_text(abscissa(transit).back(), 6) << "]\nset offsets graph 0, 0, 0.08, 0\n";
  if (transit.free) {
    write_column(transit, transit.made_good, "speed", speed, folder);
    write_column(transit, transit.pull, "thrust", unit, folder);
    commands
        << "set ylabel 'speed [m/s]'\nset xlabel\nplot 'speed.csv' using 1:2 with lines linestyle 1 lw 1.5 notitle\n"
        << "unset label 99\n";
  }
  commands << resistance_plot(run, unit) << "set ylabel 'force to the left [" << unit.name << "]'\nset xlabel '"
           << abscissa_label(transit) << "' offset 0,0.4\n"
           << "plot 'side_force.csv' using 1:2 with lines linestyle 3 lw 0.7 notitle\nunset multiplot\n";
  const std::string title =
      transit.free ? "Speed, resistance of the ice and thrust" : "Resistance of the ice along the path";
  return {
      folder.draw({"resistance", title, caption_of(transit), ""}, {1000, transit.free ? 780 : 560}, commands.str())};
}

}  // namespace gem
