// What the platform feels: net ice force with a short window, and ice against mooring.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "gem/analysis/moments.h"
#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/figures.h"
#include "gem/report/series.h"

namespace gem {
namespace {

constexpr double kWindow = 33.0;  // length of the extract [s]
constexpr std::size_t kBins = 2500;

struct Window {
  double from;
  double to;
};

/// The window around the record's largest ice force, moved inside the record.
Window window_around_largest(const RunData& run) {
  const PlatformRecord& p = run.platform;
  const double middle = p.time[maximum_excursion(p.ice_force_x).sample];
  const double last = p.time.back();
  const double from = std::clamp(middle - 0.5 * kWindow, p.time.front(), std::max(p.time.front(), last - kWindow));
  return {from, std::min(from + kWindow, last)};
}

void write_whole(const RunData& run, const std::vector<double>& force, const std::string& name, const Unit& unit,
                 const PlotFolder& folder) {
  const Unit time = time_unit(run.duration_s);
  Csv csv("t [" + time.name + "],force [" + unit.name + "]");
  for (const std::size_t i : envelope(force, kBins)) csv.row({run.platform.time[i] / time.size, force[i] / unit.size});
  folder.write_csv(name, csv);
}

/// The extract at full resolution, and the crushing peaks of its events. Returns the largest force drawn [N].
double write_window(const RunData& run, const Window& window, const Unit& unit, const PlotFolder& folder) {
  const PlatformRecord& p = run.platform;
  const SampleRange range = samples_within(p.time, window.from, window.to);
  Csv samples("t [s],mean over a sample [" + unit.name + "],mean over the window [" + unit.name + "]");
  for (std::size_t i = range.begin; i < range.end; ++i)
    samples.row({p.time[i], p.ice_force_x[i] / unit.size, p.ice_force_mean_x[i] / unit.size});
  folder.write_csv("ice_force_window", samples);
  Csv peaks("t [s],x component of the crushing peak [" + unit.name + "]");
  double largest = 0.0;
  const SampleRange events = samples_within(run.events.time, window.from, window.to);
  for (std::size_t i = events.begin; i < events.end; ++i) {
    // The normal points into the ice; the platform feels the opposite.
    const double force = -run.events.nx[i] * run.events.force_peak[i];
    peaks.row({run.events.time[i], force / unit.size});
    largest = std::max(largest, std::abs(force));
  }
  folder.write_csv("ice_force_peaks", peaks);
  return largest;
}

std::string window_plot(const RunData& run, const Window& window, const std::string& sample, bool has_events) {
  std::ostringstream commands;
  commands << "set xrange [" << rounded_text(window.from, 7) << ':' << rounded_text(window.to, 7) << "]\n"
           << "set xlabel 'time [s]' offset 0,0.4\nplot ";
  if (has_events)
    commands << "'ice_force_peaks.csv' using 1:2 with impulses lc rgb '#d9c3b4' lw 1.4, '' using 1:2 with points pt 7 "
                "ps 0.3 lc rgb '#c2571a' title 'crushing peak of each event (closed form)', ";
  commands << "'ice_force_window.csv' using 1:2 with fsteps linestyle 1 title 'impulse of each " << sample
           << " s, over " << sample << " s', '' using 1:3 with lines lc rgb '#440154' lw 1.8 title 'mean over "
           << number_text(run.force_window_s, 6) << " s'\n";
  return commands.str();
}

Figure draw_ice_force(const RunData& run, const PlotFolder& folder) {
  const PlatformRecord& p = run.platform;
  const Unit unit = force_unit(std::abs(maximum_excursion(p.ice_force_x).value));
  const Unit time = time_unit(run.duration_s);
  const Window window = window_around_largest(run);
  write_whole(run, p.ice_force_x, "ice_force", unit, folder);
  const double peak = write_window(run, window, unit, folder);
  const std::string sample = number_text(sample_interval(p.time), 6);
  std::ostringstream commands;
  commands << "set multiplot layout 2,1\nset xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\nset ylabel 'ice force, x ["
           << unit.name << "]'\nset offsets graph 0, 0, 0.12, 0.02\n"
           << window_plot(run, window, sample, peak > 0.0) << "unset label 99\n"
           << "set xrange [0:" << rounded_text(run.duration_s / time.size, 6) << "]\nset xlabel 'time [" << time.name
           << "]' offset 0,0.4\nset object 1 rectangle from first " << rounded_text(window.from / time.size, 7)
           << ", graph 0 to first " << rounded_text(window.to / time.size, 7)
           << ", graph 1 behind fillcolor rgb '#f3d9c8' fillstyle solid noborder\n"
           << "plot 'ice_force.csv' using 1:2 with lines linestyle 1 lw 0.7\nunset multiplot\n";
  const std::string caption =
      "Net x force of the ice on the platform. Below: the whole record, each sample the net impulse of " + sample +
      " s divided by " + sample + " s. Above: the " + number_text(window.to - window.from, 2) +
      " s around the record's largest value (marked below), with the mean over " + number_text(run.force_window_s, 6) +
      " s and, as stems, the closed-form crushing peak of every single event, which an impulse over a sample cannot "
      "show.";
  return folder.draw({"ice_force", "Net x force of the ice on the platform", caption, ""}, {1000, 640}, commands.str());
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
  if (run.platform.time.size() < kSamplesForStatistics) return {};
  return {draw_ice_force(run, folder), draw_ice_and_mooring(run, folder)};
}

}  // namespace gem
