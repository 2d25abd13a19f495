// Motion of the platform: both coordinates against time, the orbit, the spectra.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "gem/report/display.h"
#include "gem/report/figures/figures.h"
#include "gem/report/figures/series.h"

namespace gem {
namespace {

constexpr std::size_t kCurvePoints = 6000;
constexpr double kOrbitShape = 1.45;        // width over height of the orbit's frame
constexpr std::size_t kOrbitPoints = 6000;  // each point is an SVG path of its own

struct AxisCurve {
  std::string name;    // of the figure
  std::string symbol;  // x or y
  std::string meaning;
  int line_style;
};

Figure draw_axis(const RunData& run, const AxisCurve& curve, const std::vector<double>& position, double rest,
                 const Unit& length, const PlotFolder& folder) {
  const Unit time = time_unit(run.duration_s);
  Csv csv("t [" + time.name + "]," + curve.symbol + " [" + length.name + "]");
  for (const std::size_t i : every(position.size(), kCurvePoints))
    csv.row({run.platform.time[i] / time.size, (position[i] - rest) / length.size});
  folder.write_csv(curve.name, csv);
  std::ostringstream commands;
  commands << "set xlabel 'time [" << time.name << "]' offset 0,0.4\nset ylabel '" << curve.symbol << " ["
           << length.name << "]'\nset xrange [0:" << rounded_text(run.duration_s / time.size, 6) << "]\n"
           << "set xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\n"
           << "plot '" << curve.name << ".csv' using 1:2 with lines linestyle " << curve.line_style << '\n';
  return folder.draw({curve.name, "Platform motion " + curve.symbol + "(t)",
                      "Platform position " + curve.meaning + " from rest, against time.", ""},
                     {1000, 300}, commands.str());
}

/// The smallest frame of the fixed shape that contains the orbit and the rest position [m].
struct OrbitFrame {
  Vec2 middle;
  double half_width;
};

OrbitFrame orbit_frame(const RunData& run) {
  const Moments x = moments(run.platform.x);
  const Moments y = moments(run.platform.y);
  const double left = std::min(x.minimum - run.rest.x, 0.0);
  const double right = std::max(x.maximum - run.rest.x, 0.0);
  const double low = std::min(y.minimum - run.rest.y, 0.0);
  const double high = std::max(y.maximum - run.rest.y, 0.0);
  const double half_width = 0.53 * std::max({right - left, kOrbitShape * (high - low), 1e-9});
  return {{0.5 * (left + right), 0.5 * (low + high)}, half_width};
}

Figure draw_orbit(const RunData& run, const Unit& length, const PlotFolder& folder) {
  const Unit time = time_unit(run.duration_s);
  Csv csv("x [" + length.name + "],y [" + length.name + "],t [" + time.name + "]");
  for (const std::size_t i : every(run.platform.time.size(), kOrbitPoints))
    csv.row({(run.platform.x[i] - run.rest.x) / length.size, (run.platform.y[i] - run.rest.y) / length.size,
             run.platform.time[i] / time.size});
  folder.write_csv("orbit", csv);
  const OrbitFrame frame = orbit_frame(run);
  std::ostringstream commands;
  commands << "set size ratio -1\nset border 15\nset xlabel 'x [" << length.name << "]' offset 0,0.4\nset ylabel 'y ["
           << length.name << "]'\nset cblabel 'time [" << time.name
           << "]'\nset cbrange [0:" << rounded_text(run.duration_s / time.size, 6)
           << "]\nset colorbox noborder\nset rmargin 1\n"
           << "set xrange [" << rounded_text((frame.middle.x - frame.half_width) / length.size, 5) << ':'
           << rounded_text((frame.middle.x + frame.half_width) / length.size, 5) << "]\nset yrange ["
           << rounded_text((frame.middle.y - frame.half_width / kOrbitShape) / length.size, 5) << ':'
           << rounded_text((frame.middle.y + frame.half_width / kOrbitShape) / length.size, 5) << "]\n"
           << "set object 1 circle at 0,0 size graph 0.004 fillcolor rgb '#1f2530' fillstyle solid noborder front\n"
           << "plot 'orbit.csv' using 1:2:3 with lines linewidth 1 linecolor palette\n";
  return folder.draw(
      {"orbit", "Orbit of the platform",
       "Orbit of the platform about its rest position, coloured by time; equal axes, the dot is rest.", ""},
      {1000, 610}, commands.str());
}

/// Highest frequency shown: five times the natural frequency or, without mooring, the main frequency [Hz].
double frequency_limit(const RunData& run, const RunFindings& findings) {
  double base = run.natural_period_s > 0.0 ? 1.0 / run.natural_period_s : 0.0;
  if (findings.x.spectral) base = std::max(base, 1.0 / findings.x.spectral->period);
  return base > 0.0 ? 4.0 * base : findings.x.spectrum.frequency(findings.x.spectrum.density.size() - 1);
}

Figure draw_spectra(const RunData& run, const RunFindings& findings, const PlotFolder& folder) {
  const double limit = frequency_limit(run, findings);
  const Spectrum& x = findings.x.spectrum;
  const Spectrum& y = findings.y.spectrum;
  Csv csv("f [mHz],S_x [m2/Hz],S_y [m2/Hz]");
  double largest = 0.0;
  for (std::size_t i = 1; i < x.density.size() && x.frequency(i) <= limit; ++i) {
    // A logarithmic axis has no zero.
    csv.row({1e3 * x.frequency(i), std::max(x.density[i], 1e-30), std::max(y.density[i], 1e-30)});
    largest = std::max({largest, x.density[i], y.density[i]});
  }
  folder.write_csv("spectrum", csv);
  const double top = std::pow(10.0, std::ceil(std::log10(std::max(largest, 1e-20)) + 0.2));
  std::ostringstream commands;
  commands << "set xlabel 'frequency [mHz]' offset 0,0.4\nset ylabel 'power spectral density [m²/Hz]'\n"
           << "set logscale y\nset format y '10^{%L}'\nset termoption enhanced\n"
           << "set xrange [0:" << rounded_text(1e3 * limit, 4) << "]\nset yrange [" << exponent_text(1e-8 * top) << ':'
           << exponent_text(top) << "]\n";
  if (run.natural_period_s > 0.0) {
    const std::string at = rounded_text(1e3 / run.natural_period_s, 6);
    commands << "set arrow 1 from first " << at << ", graph 0 to first " << at
             << ", graph 1 nohead lc rgb '#3c4149' lw 1 dt (6,4) front\n"
             << "set label 1 'natural period " << rounded_text(run.natural_period_s, 3) << " s' at first " << at
             << ", graph 0.95 offset 0.8,0 textcolor rgb '#3c4149' front\n";
  }
  commands << "plot 'spectrum.csv' using 1:2 with lines linestyle 1 title 'x', '' using 1:3 with lines linestyle 2 "
              "title 'y'\n";
  return folder.draw(
      {"spectrum", "Power spectra of x and y",
       "Power spectra of x and y (multitaper, NW = 2.5, four tapers; two features closer than " +
           rounded_text(2e3 * x.half_bandwidth, 2) + " mHz are one)." +
           (run.natural_period_s > 0.0 ? " The dashed line is the natural period along x, 2&pi;&radic;(M/k)." : ""),
       ""},
      {1000, 380}, commands.str());
}

}  // namespace

std::vector<Figure> motion_figures(const RunData& run, const RunFindings& findings, const PlotFolder& folder) {
  if (run.platform.time.size() < kSamplesForStatistics || findings.radial_excursion < kLeastMotion) return {};
  const Unit length = length_unit(findings.radial_excursion);
  const AxisCurve along{"motion_x", "x", "along x", 1};
  const AxisCurve across{"motion_y", "y", "along y", 2};
  std::vector<Figure> figures = {draw_axis(run, along, run.platform.x, run.rest.x, length, folder),
                                 draw_axis(run, across, run.platform.y, run.rest.y, length, folder)};
  if (run.transit.present) return figures;  // a ship on its way does not swing
  figures.push_back(draw_orbit(run, length, folder));
  figures.push_back(draw_spectra(run, findings, folder));
  return figures;
}

}  // namespace gem
