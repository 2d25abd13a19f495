// Distance between repeats with sums without a fixed order.
#include "gem/base/number_text.h"
#include "gem/report/figures/plot_folder.h"
#include "gem/report/figures/series.h"
#include "validation/paper/plots/paper_figures.h"

namespace gem {
namespace {

constexpr std::size_t kPoints = 2000;
constexpr double kHour = 3600.0;  // time after which the paper's repeat parts, roughly [s]

/// Drawn are repeats and shifted floes. Pairs with the ordered run also contain rounding.
bool drawn(const UnorderedPairs& pairs) { return pairs.repeats || pairs.sums.starts_with("moved"); }

std::string title_of(const UnorderedPairs& pairs) {
  const std::string what = pairs.sums == "zero"       ? "repeats"
                           : pairs.sums == "velocity" ? "repeats, added to the velocity"
                                                      : "floe " + pairs.sums + " m";
  return pairs.contacts + ": " + what;
}

Csv curves_of(const UnorderedPairs& pairs, double interval_s) {
  Csv csv("t [h],distance [m]");
  for (const std::vector<double>& distance : pairs.distances) {
    for (const std::size_t i : every(distance.size(), kPoints))
      if (distance[i] > 0.0) csv.row({interval_s * static_cast<double>(i) / kHour, distance[i]});
    csv.gap();
  }
  return csv;
}

}  // namespace

std::vector<PaperFigure> unordered_figures(const UnorderedStudy& study, const std::filesystem::path& out) {
  if (study.pairs.empty()) return {};
  const PlotFolder plots(out,
                         "004_400_25: sums in single precision in no fixed order  gem " + study.runs.front().commit);
  std::string plot;
  int style = 0;
  for (const UnorderedPairs& pairs : study.pairs) {
    if (!drawn(pairs)) continue;
    const std::string name = "unordered_" + std::to_string(style + 1);
    plots.write_csv(name, curves_of(pairs, study.interval_s));
    plot += (style == 0 ? "plot " : ", ") + quoted(name + ".csv") + " using 1:2 with lines linestyle " +
            std::to_string(style % 4 + 1) + (style >= 4 ? " dt (3,3)" : "") + " title " + quoted(title_of(pairs));
    ++style;
  }
  const std::string swing = number_text(study.pairs.front().swing_m, 4);
  plots.draw(
      {"unordered", "Distance of repeats without order", "", ""}, {1000, 460},
      "set key outside bottom left horizontal\nset logscale y\nset format y '10^{%L}'\nset termoption enhanced\n"
      "set logscale x\nset autoscale xfix\nset xtics (0.05,0.1,0.2,0.5,1,2)\nset xlabel 'time [h]' offset 0,0.4\nset "
      "ylabel 'distance of "
      "the platforms [m]'\n"
      "set arrow 1 from graph 0, first " +
          swing + " to graph 1, first " + swing +
          " nohead lc rgb '#3c4149' dt (6,4) front\nset label 1 'deviation of the motion' at graph 0.01, first " +
          swing +
          " offset 0,0.6 textcolor rgb '#3c4149' front\n"
          "set arrow 2 from first 1, graph 0 to first 1, graph 1 nohead lc rgb '#3c4149' dt (2,4) front\n" +
          plot + "\n");
  return {{"-",
           "Distance of repeats of run 1 whose sums are taken in single precision in no fixed order; the dotted line "
           "is the paper's hour",
           out / "unordered"}};
}

}  // namespace gem
