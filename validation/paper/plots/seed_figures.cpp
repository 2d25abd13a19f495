// Figures of many seeds of one condition: growth of the motion with time, and of its largest value with duration.
#include <cmath>
#include <optional>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/report/figures/plot_folder.h"
#include "validation/paper/plots/paper_figures.h"
#include "validation/paper/studies/seed_extremes.h"
#include "validation/paper/studies/stationarity.h"

namespace gem {
namespace {

constexpr const char* kCondition = "004_400_25";
constexpr const char* kDay = "day_";
constexpr double kMillimetre = 1e-3;

double hours(double blocks) { return blocks * kBlockLength / 3600.0; }

/// Mean over the seeds of each block with its interval, at the middle of the block [mm].
void write_band(const PlotFolder& plots, const std::string& name, const std::vector<IntervalEstimate>& values) {
  Csv csv("t [h],mean [mm],low [mm],high [mm]");
  for (std::size_t i = 0; i < values.size(); ++i)
    csv.row({hours(static_cast<double>(i) + 0.5), values[i].value / kMillimetre, values[i].low / kMillimetre,
             values[i].high / kMillimetre});
  plots.write_csv(name, csv);
}

PaperFigure draw_growth(const std::vector<PaperRun>& runs, const std::string& stamp, const std::filesystem::path& out) {
  const PlotFolder plots(out, stamp);
  write_band(plots, "growth_x", over_seeds(runs, &RunBlocks::deviation_x));
  write_band(plots, "growth_y", over_seeds(runs, &RunBlocks::deviation_y));
  write_band(plots, "growth_offset", over_seeds(runs, &RunBlocks::mean_x));
  plots.draw(
      {"growth", "Swing and offset over time", "", ""}, {1000, 380},
      "set key outside bottom left horizontal\nset xlabel 'time [h]' offset 0,0.4\nset ylabel '[mm]'\n"
      "set xrange [0:*]\nset xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\n"
      "plot 'growth_x.csv' using 1:2:3:4 with yerrorbars linestyle 1 pt 7 ps 0.5 title 'swing of x', '' using "
      "1:2 with lines linestyle 1 notitle, "
      "'growth_y.csv' using ($1+0.01):2:3:4 with yerrorbars linestyle 2 pt 7 ps 0.5 title 'swing of y', '' using "
      "($1+0.01):2 with lines linestyle 2 notitle, "
      "'growth_offset.csv' using ($1-0.01):2:3:4 with yerrorbars linestyle 3 pt 7 ps 0.5 title 'mean of x', '' "
      "using ($1-0.01):2 with lines linestyle 3 notitle\n");
  return {"-", "Swing (deviation within 600 s) and mean over time, run 1: mean over the seeds and its 95 % interval",
          out / "growth"};
}

PaperFigure draw_convergence(const std::vector<PaperRun>& runs, const std::string& stamp,
                             const std::filesystem::path& out) {
  const PlotFolder plots(out, stamp);
  Csv seeds("duration [h],largest so far [mm]");
  std::vector<std::vector<double>> at_end;
  for (const PaperRun& run : runs) {
    const std::vector<double> largest = largest_so_far(run.blocks);
    if (at_end.size() < largest.size()) at_end.resize(largest.size());
    for (std::size_t i = 0; i < largest.size(); ++i) {
      seeds.row({hours(static_cast<double>(i + 1)), largest[i] / kMillimetre});
      at_end[i].push_back(largest[i]);
    }
    seeds.gap();
  }
  plots.write_csv("convergence", seeds);
  Csv mean("duration [h],mean [mm],low [mm],high [mm]");
  for (std::size_t i = 0; i < at_end.size(); ++i) {
    if (at_end[i].size() < 2) continue;
    const IntervalEstimate over = mean_of_runs(at_end[i]);
    mean.row(
        {hours(static_cast<double>(i + 1)), over.value / kMillimetre, over.low / kMillimetre, over.high / kMillimetre});
  }
  plots.write_csv("convergence_mean", mean);
  const std::string over = runs.size() < 2
                               ? ""
                               : ", 'convergence_mean.csv' using 1:2:3:4 with yerrorbars linestyle 2 lw 2 pt "
                                 "7 ps 0.6 title 'mean over the seeds, 95 %'";
  plots.draw({"convergence", "Largest excursion against duration", "", ""}, {1000, 380},
             "set key outside bottom left horizontal\nset xlabel 'duration [h]' offset 0,0.4\nset ylabel 'largest "
             "excursion so far [mm]'\nset xrange [0:*]\nset yrange [0:*]\nplot 'convergence.csv' using 1:2 with lines "
             "linestyle 1 lw 0.5 title 'one seed each'" +
                 over + "\n");
  return {"-", "Largest excursion against the duration of the run, one line per seed", out / "convergence"};
}

/// Swing of x over a day, one line per condition; empty without such runs.
std::optional<PaperFigure> draw_day(const PaperFolder& folder, const std::filesystem::path& out) {
  std::vector<const PaperRun*> days;
  for (const auto& [condition, runs] : folder.conditions)
    if (condition.starts_with(kDay) && runs.front().blocks.count() > 1) days.push_back(&runs.front());
  if (days.empty()) return std::nullopt;
  const PlotFolder plots(out, conditions_text(*days.front()));
  std::string plot = "plot ";
  for (std::size_t i = 0; i < days.size(); ++i) {
    Csv csv("t [h],swing of x [mm],mean of x [mm]");
    const RunBlocks& blocks = days[i]->blocks;
    for (std::size_t block = 0; block < blocks.count(); ++block)
      csv.row({hours(static_cast<double>(block) + 0.5), blocks.deviation_x[block] / kMillimetre,
               blocks.mean_x[block] / kMillimetre});
    plots.write_csv(days[i]->condition, csv);
    plot += (i == 0 ? "" : ", ") + quoted(days[i]->condition + ".csv") + " using 1:2 with lines linestyle " +
            std::to_string(i % 4 + 1) + " title " + quoted(days[i]->condition.substr(std::string(kDay).size()));
  }
  plots.draw({"day", "Swing of x over a day", "", ""}, {1000, 380},
             "set key outside bottom left horizontal\nset xlabel 'time [h]' offset 0,0.4\nset ylabel 'swing of x "
             "[mm]'\nset xrange [0:*]\nset yrange [0:*]\n" +
                 plot + "\n");
  return PaperFigure{"-", "Swing of x (deviation within 600 s) over 24 hours, one run each", out / "day"};
}

}  // namespace

std::vector<PaperFigure> seed_figures(const PaperFolder& folder, const std::filesystem::path& out) {
  std::vector<PaperFigure> figures;
  if (auto day = draw_day(folder, out)) figures.push_back(std::move(*day));
  const std::vector<PaperRun>& runs = folder.of(kCondition);
  if (runs.empty() || runs.front().blocks.count() < 2) return figures;
  const std::string stamp = conditions_text(runs.front()) + ", " + std::to_string(runs.size()) + " seeds";
  if (runs.size() > 1) figures.push_back(draw_growth(runs, stamp, out));
  figures.push_back(draw_convergence(runs, stamp, out));
  return figures;
}

}  // namespace gem
