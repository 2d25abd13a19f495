// What dynamic positioning held: offset, yaw error and used thrust over the run.
#include <cmath>
#include <sstream>

#include "gem/report/display.h"
#include "gem/report/figures/figures.h"
#include "gem/report/figures/series.h"

namespace gem {
namespace {

constexpr std::size_t kDpBins = 1500;

void write_dp_curve(const RunData& run, const std::vector<double>& values, const char* name, const char* column,
                    const PlotFolder& folder) {
  const Unit time = time_unit(run.duration_s);
  Csv csv("t [" + time.name + "]," + column);
  for (const std::size_t i : envelope(values, kDpBins)) csv.row({run.platform.time[i] / time.size, values[i]});
  folder.write_csv(name, csv);
}

}  // namespace

std::vector<Figure> dp_figures(const RunData& run, const PlotFolder& folder) {
  if (run.dp.thruster.empty() || run.platform.time.size() < kSamplesForStatistics) return {};
  const Unit time = time_unit(run.duration_s);
  std::vector<double> used, yaw;
  for (std::size_t i = 0; i < run.dp.offset.size(); ++i) {
    used.push_back(100.0 * thrust_utilisation(run.dp, i));
    yaw.push_back(180.0 / std::acos(-1.0) * run.dp.yaw[i]);
  }
  write_dp_curve(run, run.dp.offset, "dp_offset", "offset [m]", folder);
  write_dp_curve(run, yaw, "dp_yaw", "yaw from its set point [deg]", folder);
  write_dp_curve(run, used, "dp_thrust", "used thrust [%]", folder);
  std::ostringstream commands;
  commands
      << "set multiplot layout 3,1\nset xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\nset xrange [0:"
      << rounded_text(run.duration_s / time.size, 6) << "]\nset offsets graph 0, 0, 0.08, 0\n"
      << "set ylabel 'offset [m]'\nset xlabel\nplot 'dp_offset.csv' using 1:2 with lines linestyle 1 notitle\n"
      << "unset label 99\nset ylabel 'yaw error [deg]'\nplot 'dp_yaw.csv' using 1:2 with lines linestyle 2 notitle\n"
      << "set ylabel 'used thrust [%]'\nset xlabel 'time [" << time.name
      << "]' offset 0,0.4\nplot 'dp_thrust.csv' using 1:2 with lines linestyle 3 notitle\nunset multiplot\n";
  return {folder.draw({"dp", "Dynamic positioning: offset, yaw error and used thrust",
                       "Dynamic positioning. Top: distance from the set point. Middle: yaw from its set point. Bottom: "
                       "thrust of all thrusters over the sum of their largest.",
                       ""},
                      {1000, 620}, commands.str())};
}

}  // namespace gem
