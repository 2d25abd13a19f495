// Runs that should be equal in one picture, and the growth of their distance.
#include <algorithm>
#include <cmath>
#include <limits>

#include "gem/analysis/statistics/moments.h"
#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/figures/plot_folder.h"
#include "gem/report/figures/series.h"
#include "validation/paper/plots/paper_figures.h"
#include "validation/paper/statements/settings_check.h"

namespace gem {
namespace {

constexpr std::size_t kPoints = 4000;
constexpr double kInterval = 1.0;  // [s]
constexpr double kFloor = 1e-16;   // where a distance of zero is drawn on a logarithmic axis [m]
const std::vector<std::string> kMovedAlone = {"floes.moved_floe", "floes.moved_by_m"};

struct Curve {
  const PaperRun* run;
  std::string title;
};

/// Run 1, its repetition, and the run of the same seed with the smallest shift of a floe.
std::vector<Curve> curves(const PaperFolder& folder) {
  std::vector<Curve> list;
  if (folder.of("004_400_25").empty()) return list;
  const PaperRun& one = folder.of("004_400_25").front();
  list.push_back({&one, "run 1"});
  for (const PaperRun& again : folder.of("004_400_25(2)"))
    if (again.seed == one.seed && differing_options(one.scene, again.scene).empty())
      list.push_back({&again, "the same again (1a)"});
  const PaperRun* nearest = nullptr;
  for (const auto& [condition, runs] : folder.conditions)
    for (const PaperRun& run : runs) {
      const double moved = length(run.scene.floes.moved_by_m);
      if (run.scene.floes.moved_floe < 0 || moved == 0.0 || run.seed != one.seed) continue;
      if (differing_options(one.scene, run.scene) != kMovedAlone) continue;
      if (nearest == nullptr || moved < length(nearest->scene.floes.moved_by_m)) nearest = &run;
    }
  if (nearest != nullptr)
    list.push_back({nearest, "one floe moved by " + number_text(length(nearest->scene.floes.moved_by_m)) + " m"});
  return list;
}

PaperFigure draw_repetition(const std::vector<Curve>& list, const std::filesystem::path& out) {
  const PlotFolder plots(out, conditions_text(*list.front().run));
  const Unit time{"h", 3600.0};
  std::string plot = "plot ";
  double largest = 0.0;
  for (const Curve& curve : list)
    if (const auto own = curve.run->numbers.find("orbit_largest_m")) largest = std::max(largest, own->value);
  const Unit metre = length_unit(largest);
  for (std::size_t c = 0; c < list.size(); ++c) {
    const PlatformPath path = path_of(*list[c].run, kInterval);
    Csv csv("t [" + time.name + "],x [" + metre.name + "]");
    for (const std::size_t i : every(path.x.size(), kPoints))
      csv.row({path.interval_s * static_cast<double>(i) / time.size, path.x[i] / metre.size});
    const std::string name = "repeated_" + std::to_string(c + 1);
    plots.write_csv(name, csv);
    const char* styles[] = {"linestyle 1 lw 2", "linestyle 2 dt (6,4)", "linestyle 3"};
    plot += (c == 0 ? "" : ", ") + quoted(name + ".csv") + " using 1:2 with lines " + styles[c] + " title " +
            quoted(list[c].title);
  }
  plots.draw(
      {"repeated", "Runs with identical properties", "", ""}, {1000, 340},
      "set key outside bottom left horizontal\nset xzeroaxis lc rgb '#8a8f98' lw 0.8 dt solid\nset xlabel 'time [" +
          time.name + "]' offset 0,0.4\nset ylabel 'x [" + metre.name + "]'\n" + plot + "\n");
  return {"12", "Runs with identical properties, and one that differs by a hair", out / "repeated"};
}

std::string conditions(const PaperFolder& folder) {
  for (const auto& [condition, runs] : folder.conditions)
    for (const PaperRun& run : runs)
      if (run.scene.floes.moved_floe >= 0 && length(run.scene.floes.moved_by_m) > 0.0) return conditions_text(run);
  return "";
}

/// The pairs by the shift of their floe, including those that the disturbance never reached.
std::map<double, std::vector<const DivergingPair*>> by_move(const DivergenceStudy& study) {
  std::map<double, std::vector<const DivergingPair*>> groups;
  for (const DivergingPair& pair : study.pairs) groups[pair.moved_m].push_back(&pair);
  return groups;
}

/// Time at which the median pair of each group has parted; the latest of all groups [s].
double latest_parting(const DivergenceStudy& study) {
  double latest = 0.0;
  for (const auto& [moved, pairs] : by_move(study)) {
    std::vector<double> times;
    for (const DivergingPair* pair : pairs)
      times.push_back(parting_time(pair->distance, study.interval_s, study.swing_m));
    std::sort(times.begin(), times.end());
    latest = std::max(latest, times[(times.size() - 1) / 2]);
  }
  return latest;
}

/// Median distance of the pairs over time, and the range of eight pairs of ten. No rows while most distances are zero.
Csv middle_distance(const std::vector<const DivergingPair*>& pairs, double interval_s, double until_s) {
  Csv csv("t [min],middle [m],tenth [m],nine tenths [m]");
  const auto count = static_cast<std::size_t>(until_s / interval_s);
  for (std::size_t i = 0; i < count; ++i) {
    std::vector<double> now;
    for (const DivergingPair* pair : pairs)
      if (i < pair->distance.size()) now.push_back(std::max(pair->distance[i], kFloor));
    if (now.size() < pairs.size()) break;
    const double middle = percentile(now, 0.5);
    if (middle > kFloor)
      csv.row({interval_s * static_cast<double>(i) / 60.0, middle, percentile(now, 0.1), percentile(now, 0.9)});
  }
  return csv;
}

/// Labels of a picture of distances.
struct DistanceLabels {
  std::string name, title, axis, level;  // level: meaning of the line at the swing
};

PaperFigure draw_distances(const DivergenceStudy& study, const DistanceLabels& labels, const std::string& stamp,
                           const std::filesystem::path& out) {
  const PlotFolder plots(out, stamp);
  const double parted = latest_parting(study);
  const double until_s = std::isfinite(parted) ? 3.0 * parted : std::numeric_limits<double>::infinity();
  const double shown_s = std::min(until_s, study.interval_s * static_cast<double>(study.pairs.front().distance.size()));
  std::string bands, lines;
  int style = 1;
  for (const auto& [moved, pairs] : by_move(study)) {
    const std::string name = labels.name + "_" + number_text(moved), file = quoted(name + ".csv");
    plots.write_csv(name, middle_distance(pairs, study.interval_s, shown_s));
    const std::string line = "linestyle " + std::to_string(style);
    bands += (style == 1 ? "" : ", ") + file + " using 1:3:4 with filledcurves " + line + " fs transparent solid 0.12";
    lines += ", " + file + " using 1:2 with lines " + line + " lw 2 title " +
             quoted("moved by " + number_text(moved) + " m (" + std::to_string(pairs.size()) + " pairs)");
    style = style % 4 + 1;
  }
  const std::string level = number_text(study.swing_m, 4);
  plots.draw({labels.name, labels.title, "", ""}, {1000, 420},
             "set key outside bottom left horizontal\nset logscale y\nset format y '10^{%L}'\nset termoption enhanced\n"
             "set xlabel 'time [min]' offset 0,0.4\nset xrange [0:" +
                 number_text(shown_s / 60.0, 3) + "]\nset ylabel " + quoted(labels.axis) +
                 "\nset arrow 1 from graph 0, first " + level + " to graph 1, first " + level +
                 " nohead lc rgb '#3c4149' dt (6,4) front\nset label 1 " + quoted(labels.level) +
                 " at graph 0.01, first " + level + " offset 0,0.6 textcolor rgb '#3c4149' front\nplot " + bands +
                 lines + "\n");
  return {"-", labels.title, out / labels.name};
}

}  // namespace

std::vector<PaperFigure> repeat_figures(const PaperFolder& folder, const DivergenceStudy& study,
                                        const std::filesystem::path& out) {
  std::vector<PaperFigure> figures;
  const std::vector<Curve> list = curves(folder);
  if (list.size() > 1) figures.push_back(draw_repetition(list, out));
  const bool apart = std::any_of(study.pairs.begin(), study.pairs.end(),
                                 [](const DivergingPair& pair) { return pair.distance.back() > 0.0; });
  if (apart && study.swing_m > 0.0)
    figures.push_back(draw_distances(
        study,
        {"distances",
         "Distance of the platforms of runs that differ by the place of one floe: the middle pair and eight of ten",
         "distance of the platforms [m]", "deviation of the motion"},
        conditions(folder), out));
  return figures;
}

std::vector<PaperFigure> ice_figures(const IceStudy& study, const std::filesystem::path& out) {
  std::vector<PaperFigure> figures;
  for (const auto& [contacts, own] : study.of_contacts)
    figures.push_back(draw_distances(own,
                                     {"ice_" + contacts,
                                      "Distance of the ice of runs that differ by the place of one floe, " + contacts +
                                          " contacts: the middle pair and eight of ten",
                                      "distance of the ice, rms [m]", "parted"},
                                     "004_400_25: " + contacts + ", seeds 1 to 5  gem " + study.commit, out));
  return figures;
}

}  // namespace gem
