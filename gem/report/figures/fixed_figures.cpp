// The force of the ice on each [[fixed]] body against time.
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "gem/report/display.h"
#include "gem/report/figures/figures.h"

namespace gem {
namespace {

constexpr const char* colours[] = {"#3b6ea5", "#c2571a", "#440154", "#35b779", "#8a8f98", "#b5367a"};
constexpr std::size_t curves_maximum = std::size(colours);
static_assert(curves_maximum == 6, "the caption names the number");
constexpr std::size_t frames_minimum = 10;

double largest_of(const std::vector<Vec2>& force) {
  double largest = 0.0;
  for (const Vec2 f : force) largest = std::max(largest, length(f));
  return largest;
}

/// The bodies that ice pressed on, those with the largest force first.
std::vector<std::size_t> bodies_by_force(const FixedRecord& fixed) {
  std::vector<double> largest;
  std::vector<std::size_t> bodies;
  for (std::size_t k = 0; k < fixed.force.size(); ++k) {
    largest.push_back(largest_of(fixed.force[k]));
    if (largest[k] > 0.0) bodies.push_back(k);
  }
  std::stable_sort(bodies.begin(), bodies.end(), [&](std::size_t a, std::size_t b) { return largest[a] > largest[b]; });
  return bodies;
}

std::string curve_name(std::size_t body) { return "fixed_force_" + std::to_string(body); }

void write_curve(const RunData& run, std::size_t body, const Unit& unit, const PlotFolder& folder) {
  const Unit time = time_unit(run.duration_s);
  const FixedRecord& fixed = run.on_fixed;
  Csv csv("t [" + time.name + "],force [" + unit.name + "]");
  for (std::size_t n = 0; n < fixed.time.size(); ++n)
    csv.row({fixed.time[n] / time.size, length(fixed.force[body][n]) / unit.size});
  folder.write_csv(curve_name(body), csv);
}

}  // namespace

std::vector<Figure> fixed_figures(const RunData& run, const PlotFolder& folder) {
  std::vector<std::size_t> bodies = bodies_by_force(run.on_fixed);
  if (bodies.empty() || run.on_fixed.time.size() < frames_minimum) return {};
  const bool some = bodies.size() > curves_maximum;
  if (some) bodies.resize(curves_maximum);
  const Unit unit = force_unit(largest_of(run.on_fixed.force[bodies.front()])), time = time_unit(run.duration_s);
  std::ostringstream commands;
  commands << "set xrange [0:" << rounded_text(run.duration_s / time.size, 6) << "]\nset yrange [0:*]\n"
           << "set ylabel 'force [" << unit.name << "]'\nset xlabel 'time [" << time.name << "]' offset 0,0.4\nplot ";
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    write_curve(run, bodies[i], unit, folder);
    commands << (i > 0 ? ", " : "") << "'" << curve_name(bodies[i]) << ".csv' using 1:2 with lines lw 1.2 lc rgb '"
             << colours[i] << "' title 'fixed body " << bodies[i] << "'";
  }
  commands << "\n";
  const std::string which = some ? "the six fixed bodies with the largest force" : "each fixed body that it pressed on";
  return {folder.draw({"fixed_force", "Force of the ice on fixed bodies",
                       "Force of the ice on " + which + ", whatever its direction: the mean over the last time step " +
                           "before each frame.",
                       ""},
                      {1000, 360}, commands.str())};
}

}  // namespace gem
