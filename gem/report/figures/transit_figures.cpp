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

void write_along_path(const TransitRecord& transit, const std::vector<double>& force, const char* name,
                      const Unit& unit, const PlotFolder& folder) {
  Csv csv("distance along the path [m],force [" + unit.name + "]");
  for (const std::size_t i : envelope(force, kTransitBins)) csv.row({transit.distance[i], force[i] / unit.size});
  folder.write_csv(name, csv);
}

}  // namespace

std::vector<Figure> transit_figures(const RunData& run, const PlotFolder& folder) {
  const TransitRecord& transit = run.transit;
  if (transit.distance.size() < kSamplesForStatistics) return {};
  const double largest = std::max(std::abs(maximum_excursion(transit.resistance_window).value),
                                  std::abs(maximum_excursion(transit.side_window).value));
  const Unit unit = force_unit(largest);
  write_along_path(transit, transit.resistance_window, "resistance", unit, folder);
  write_along_path(transit, running_mean(transit.resistance), "resistance_mean", unit, folder);
  write_along_path(transit, transit.side_window, "side_force", unit, folder);
  std::ostringstream commands;
  commands << "set multiplot layout 2,1\nset xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\nset xrange [0:"
           << rounded_text(transit.distance.back(), 6) << "]\nset offsets graph 0, 0, 0.08, 0\nset ylabel 'resistance ["
           << unit.name << "]'\nset xlabel\n"
           << "plot 'resistance.csv' using 1:2 with lines linestyle 1 lw 0.7 title 'mean over "
           << number_text(run.force_window_s, 6)
           << " s', 'resistance_mean.csv' using 1:2 with lines linestyle 2 lw 2 title 'mean so far'\n"
           << "unset label 99\nset ylabel 'force to the left [" << unit.name
           << "]'\nset xlabel 'distance along the path [m]' offset 0,0.4\n"
           << "plot 'side_force.csv' using 1:2 with lines linestyle 3 lw 0.7 notitle\nunset multiplot\n";
  const std::string caption = "A ship in transit at " + number_text(transit.speed, 4) +
                              " m/s. Top: force of the ice against its course. Bottom: force to its left. Both are "
                              "means over output.force_window_s; open water is no part of them.";
  return {
      folder.draw({"resistance", "Resistance of the ice along the path", caption, ""}, {1000, 560}, commands.str())};
}

}  // namespace gem
