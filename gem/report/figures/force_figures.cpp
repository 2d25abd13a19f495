// Forces on the platform: net ice force with a short extract, and ice against mooring.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "gem/analysis/statistics/moments.h"
#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/figures/figures.h"
#include "gem/report/figures/force_window.h"
#include "gem/report/figures/series.h"

namespace gem {
namespace {

constexpr double kWindow = 33.0;  // length of the extract [s]
constexpr std::size_t kBins = 2500;

void write_whole(const RunData& run, const std::vector<double>& force, const std::string& name, const Unit& unit,
                 const PlotFolder& folder) {
  const Unit time = time_unit(run.duration_s);
  Csv csv("t [" + time.name + "],force [" + unit.name + "]");
  for (const std::size_t i : envelope(force, kBins)) csv.row({run.platform.time[i] / time.size, force[i] / unit.size});
  folder.write_csv(name, csv);
}

/// Whether the force window is longer than a sample, so that its mean differs from that of a sample.
bool has_window(const RunData& run) { return run.force_window_s > 1.5 * sample_interval(run.platform.time); }

std::vector<std::size_t> impacts_within(const RunData& run, const TimeWindow& window) {
  std::vector<std::size_t> impacts;
  for (const std::size_t i : opening_events(run.events))
    if (run.events.time[i] >= window.from && run.events.time[i] <= window.to) impacts.push_back(i);
  return impacts;
}

double largest_peak(const RunData& run, const TimeWindow& window) {
  double largest = 0.0;
  for (const std::size_t i : impacts_within(run, window)) largest = std::max(largest, run.events.force_peak[i]);
  return largest;
}

/// What events have: the largest force of their substeps, or the closed form of a rigid hit.
std::string peak_words(const RunData& run) { return run.events.resolved ? "largest force" : "crushing peak"; }

/// The extract at full resolution, and the crushing peaks of its impacts. A mean is recorded at the end of its window;
/// it is drawn at the middle.
void write_window(const RunData& run, const TimeWindow& window, const Unit& unit, const Unit& peak_unit,
                  const PlotFolder& folder) {
  const PlatformRecord& p = run.platform;
  const SampleRange range = samples_within(p.time, window.from, window.to);
  Csv samples("t at the end [s],mean over a sample [" + unit.name + "]");
  for (std::size_t i = range.begin; i < range.end; ++i) samples.row({p.time[i], p.ice_force_x[i] / unit.size});
  folder.write_csv("ice_force_window", samples);
  Csv means("t at the middle [s],mean over the window [" + unit.name + "]");
  for (std::size_t i = range.begin; i < range.end; ++i)
    means.row({p.time[i] - 0.5 * run.force_window_s, p.ice_force_mean_x[i] / unit.size});
  if (has_window(run)) folder.write_csv("ice_force_window_mean", means);
  Csv peaks("t [s],x component of the " + peak_words(run) + " [" + peak_unit.name + "]");
  for (const std::size_t i : impacts_within(run, window))
    // The normal points into the ice; the force on the platform points the other way.
    peaks.row({run.events.time[i], -run.events.nx[i] * run.events.force_peak[i] / peak_unit.size});
  folder.write_csv("ice_force_peaks", peaks);
}

std::string range_text(const TimeWindow& window, double unit) {
  return "set xrange [" + rounded_text(window.from / unit, 7) + ":" + rounded_text(window.to / unit, 7) + "]\n";
}

/// The lower two panels, each with its own axis: impulses, and crushing peaks of the impacts below them.
std::string window_plots(const RunData& run, const TimeWindow& window, const std::string& sample,
                         const Unit& peak_unit) {
  std::ostringstream commands;
  commands << range_text(window, 1.0) << "set xlabel\nset yrange [*:*]\n"
           << "plot 'ice_force_window.csv' using 1:2 with fsteps linestyle 1 title 'over each " << sample << " s'";
  if (has_window(run))
    commands << ", 'ice_force_window_mean.csv' using 1:2 with lines lc rgb '#440154' lw 1.8 title 'over "
             << number_text(run.force_window_s, 6) << " s'";
  commands
      << "\nset xlabel 'time [s]' offset 0,0.4\nset ylabel '" << peak_words(run) << ", x [" << peak_unit.name
      << "]'\nplot 0 with lines lc rgb '#8a8f98' lw 0.8 notitle, 'ice_force_peaks.csv' using 1:2 with impulses lc rgb "
         "'#d9b39c' lw 1.6 notitle, '' using 1:2 with points pt 7 ps 0.35 lc rgb '#c2571a' title 'each impact'\n";
  return commands.str();
}

/// How the extract was chosen.
std::string window_text(const RunData& run) {
  if (run.at_s) return "around " + time_text(*run.at_s);
  return run.events.time.empty() ? "around the record's largest value" : "with the most impacts";
}

Figure draw_ice_force(const RunData& run, const PlotFolder& folder) {
  const PlatformRecord& p = run.platform;
  const Unit unit = force_unit(std::abs(maximum_excursion(p.ice_force_x).value));
  const Unit time = time_unit(run.duration_s);
  const TimeWindow window = force_window(run, kWindow);
  write_whole(run, p.ice_force_x, "ice_force", unit, folder);
  const Unit peak_unit = force_unit(largest_peak(run, window));
  write_window(run, window, unit, peak_unit, folder);
  const std::string sample = number_text(sample_interval(p.time), 6);
  std::ostringstream commands;
  commands << "set multiplot layout 3,1\nset xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\n"
           << range_text({0.0, run.duration_s}, time.size) << "set ylabel 'ice force, x [" << unit.name
           << "]'\nset xlabel 'time [" << time.name << "]' offset 0,0.4\nset object 1 rectangle from first "
           << rounded_text(window.from / time.size, 7) << ", graph 0 to first "
           << rounded_text(window.to / time.size, 7)
           << ", graph 1 behind fillcolor rgb '#f3d9c8' fillstyle solid noborder\n"
           << "plot 'ice_force.csv' using 1:2 with lines linestyle 1 lw 0.7\nunset object 1\nunset label 99\n"
           << window_plots(run, window, sample, peak_unit) << "unset multiplot\n";
  const std::string caption =
      "Net x force of the ice on the platform. Top: the whole record, the impulse of each " + sample +
      " s divided by " + sample + " s. Middle: the " + number_text(window.to - window.from, 2) + " s " +
      window_text(run) + " (marked above)" +
      (has_window(run) ? ", with the mean over the " + number_text(run.force_window_s, 6) + " s about each time" : "") +
      ". Bottom: the " + peak_words(run) + " of each impact in that time, which no impulse over a sample can show.";
  return folder.draw({"ice_force", "Net x force of the ice on the platform", caption, ""}, {1000, 780}, commands.str());
}

Figure draw_ice_and_mooring(const RunData& run, const PlotFolder& folder) {
  const PlatformRecord& p = run.platform;
  const Unit unit = force_unit(
      std::max(std::abs(maximum_excursion(p.ice_force_x).value), std::abs(maximum_excursion(p.mooring_force_x).value)));
  const Unit time = time_unit(run.duration_s);
  write_whole(run, p.ice_force_x, "ice_and_mooring_ice", unit, folder);
  Csv mooring("t [" + time.name + "],mooring force [" + unit.name + "]");
  for (const std::size_t i : every(p.time.size(), 2 * kBins))
    mooring.row({p.time[i] / time.size, p.mooring_force_x[i] / unit.size});
  folder.write_csv("ice_and_mooring_mooring", mooring);
  std::ostringstream commands;
  commands << "set xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\nset ylabel 'force on the platform, x [" << unit.name
           << "]'\nset xlabel 'time [" << time.name
           << "]' offset 0,0.4\nset xrange [0:" << rounded_text(run.duration_s / time.size, 6)
           << "]\nset offsets graph 0, 0, 0.1, 0.02\n"
           << "plot 'ice_and_mooring_ice.csv' using 1:2 with lines lc rgb '#9db8cf' lw 0.7 title 'ice', "
              "'ice_and_mooring_mooring.csv' using 1:2 with lines linestyle 2 title 'mooring'\n";
  return folder.draw({"ice_and_mooring", "Ice force against mooring force",
                      "Ice force (impulse of each sample over its length) against mooring force, x components.", ""},
                     {1000, 360}, commands.str());
}

}  // namespace

std::vector<Figure> force_figures(const RunData& run, const PlotFolder& folder) {
  if (run.platform.time.size() < kSamplesForStatistics) return fixed_figures(run, folder);
  std::vector<Figure> figures = {draw_ice_force(run, folder)};
  if (run.is_held && !run.transit.present) figures.push_back(draw_ice_and_mooring(run, folder));
  for (Figure& figure : transit_figures(run, folder)) figures.push_back(std::move(figure));
  for (Figure& figure : dp_figures(run, folder)) figures.push_back(std::move(figure));
  for (Figure& figure : fixed_figures(run, folder)) figures.push_back(std::move(figure));
  return figures;
}

}  // namespace gem
