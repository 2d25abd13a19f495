// Figures of run 1 that the paper does not have.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "gem/analysis/extremes/exceedance.h"
#include "gem/analysis/spectra/hilbert.h"
#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/figures/plot_folder.h"
#include "gem/report/figures/series.h"
#include "gem/report/run/load_run.h"
#include "gem/report/run/platform_series.h"
#include "validation/paper/plots/paper_figures.h"

namespace gem {
namespace {

constexpr std::size_t kPoints = 3000;
constexpr const char* kCondition = "004_400_25";
const Unit kMillimetre{"mm", 1e-3};

/// Envelope of both axes around the natural period, without its disturbed ends.
PaperFigure draw_envelope(const PaperRun& run, const PlatformSeries& series, const std::filesystem::path& out) {
  const PlotFolder plots(out, conditions_text(run));
  const double low = 0.5 / series.natural_period;
  const HilbertEnvelope x = hilbert_envelope(series.x, series.interval, low, 3.0 * low);
  const HilbertEnvelope y = hilbert_envelope(series.y, series.interval, low, 3.0 * low);
  const auto end = static_cast<std::size_t>(series.natural_period / series.interval);
  Csv csv("t [h],amplitude of x [mm],amplitude of y [mm]");
  for (const std::size_t i : every(series.x.size(), kPoints))
    if (i >= end && i + end < series.x.size())
      csv.row({series.interval * static_cast<double>(i) / 3600.0, x.amplitude[i] / kMillimetre.size,
               y.amplitude[i] / kMillimetre.size});
  plots.write_csv("envelope", csv);
  plots.draw({"envelope", "Amplitude of x and y", "", ""}, {1000, 320},
             "set key outside bottom left horizontal\nset xlabel 'time [h]' offset 0,0.4\nset ylabel 'amplitude "
             "[mm]'\nset yrange [0:*]\n"
             "set arrow 1 from first 1, graph 0 to first 1, graph 1 nohead lc rgb '#3c4149' dt (6,4) front\n"
             "plot 'envelope.csv' using 1:2 with lines linestyle 1 title 'x', '' using 1:3 with lines linestyle 2 "
             "title 'y'\n");
  return {"-", "Amplitude about the natural period over time; the dashed line is one hour", out / "envelope"};
}

/// Exceedance of the peaks of swings over all seeds, with the Rayleigh curve of a normal process of equal deviation.
PaperFigure draw_exceedance(const std::vector<PaperRun>& runs, const std::filesystem::path& out) {
  std::vector<double> peaks;
  for (const PaperRun& run : runs) peaks.insert(peaks.end(), run.excursion_peaks.begin(), run.excursion_peaks.end());
  const ExceedanceCurve curve = exceedance(peaks);
  double squares = 0.0;
  for (const double peak : peaks) squares += peak * peak / static_cast<double>(peaks.size());
  const PlotFolder plots(out, conditions_text(runs.front()) + ", " + std::to_string(runs.size()) + " seeds");
  Csv csv("peak [mm],exceeded,low,high,Rayleigh");
  for (std::size_t i = 0; i < curve.level.size(); ++i)
    csv.row({curve.level[i] / kMillimetre.size, curve.probability[i] > 0.0 ? curve.probability[i] : std::nan(""),
             std::max(1e-9, curve.probability[i] - curve.band), std::min(1.0, curve.probability[i] + curve.band),
             std::exp(-curve.level[i] * curve.level[i] / squares)});
  plots.write_csv("exceedance", csv);
  std::ostringstream commands;
  commands
      << "set key outside bottom left horizontal\nset logscale y\nset format y '%g'\nset xlabel 'excursion peak [mm]' "
         "offset 0,0.4\n"
      << "set ylabel 'share of peaks above'\nset yrange [" << number_text(0.5 / static_cast<double>(peaks.size()), 3)
      << ":1]\nplot 'exceedance.csv' using 1:3:4 with filledcurves lc rgb '#dbe6ee' title '95 % band', '' using 1:2 "
      << "with steps linestyle 1 title 'runs', '' using 1:5 with lines linestyle 4 title 'Rayleigh of the same size'\n";
  plots.draw({"exceedance", "Exceedance of excursion peaks", "", ""}, {1000, 420}, commands.str());
  return {"-", "Exceedance of the peaks of the excursion, one per natural period, above its median",
          out / "exceedance"};
}

}  // namespace

std::vector<PaperFigure> extra_figures(const PaperFolder& folder, const std::filesystem::path& out) {
  const std::vector<PaperRun>& runs = folder.of(kCondition);
  if (runs.empty() || runs.front().excursion_peaks.size() < 10) return {};
  std::vector<PaperFigure> figures;
  if (const PaperRun* run = folder.with_file(kCondition))
    figures.push_back(draw_envelope(*run, platform_series(load_run(run->file, false)), out));
  figures.push_back(draw_exceedance(runs, out));
  return figures;
}

}  // namespace gem
