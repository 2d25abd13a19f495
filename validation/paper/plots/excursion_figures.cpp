// Largest excursion against the drift speed.
#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "gem/base/number_text.h"
#include "gem/report/display.h"
#include "gem/report/figures/plot_folder.h"
#include "validation/paper/plots/paper_figures.h"
#include "validation/paper/statements/folder_numbers.h"

namespace gem {
namespace {

struct Sheet {
  std::string number;
  std::string ice;  // the first part of the condition's name
  std::string meaning;
};

PaperFigure draw(const Sheet& sheet, const std::vector<ExcursionPoint>& points, const std::string& stamp,
                 const std::filesystem::path& out) {
  const PlotFolder plots(out, stamp);
  double top = 0.0;
  std::map<double, Csv> lines;
  for (const ExcursionPoint& point : points) {
    Csv& csv = lines.try_emplace(point.gap_m, "current [m/s],mean [m],smallest [m],largest [m],low [m],high [m],runs")
                   .first->second;
    const auto [least, most] = std::minmax_element(point.largest_m.begin(), point.largest_m.end());
    top = std::max(top, *most);
    const IntervalEstimate own{point.mean(), point.mean(), point.mean()};
    const IntervalEstimate mean = point.mean_interval().value_or(own);
    csv.row({point.current_m_per_s, mean.value, *least, *most, mean.low, mean.high,
             static_cast<double>(point.largest_m.size())});
  }
  std::ostringstream plot;
  plot << "set key outside bottom left horizontal\nset xlabel 'drift velocity [m/s]' offset 0,0.4\nset ylabel 'maximum "
          "excursion [m]'\nset xrange [0:1.1]\n"
       << "set yrange [0:" << number_text(1.08 * top, 3) << "]\nplot ";
  int style = 1;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line, ++style) {
    const std::string name = "excursion_" + sheet.ice + "_" + number_text(line->first);
    plots.write_csv(name, line->second);
    // Bars side by side, because the gaps have the same currents.
    const std::string x = "($1" + std::string(style == 1 ? "-0.006" : style == 3 ? "+0.006" : "") + ")";
    plot << (style == 1 ? "" : ", ") << quoted(name + ".csv") << " using 1:2 with lines linestyle " << style
         << " notitle, '' using " << x << ":2:3:4 with yerrorbars linestyle " << style
         << " lw 0.5 ps 0 notitle, '' using " << x << ":2:5:6 with yerrorbars linestyle " << style
         << " lw 2 pt 7 ps 0.6 title " << quoted("W = " + number_text(line->first) + " m");
  }
  plots.draw({"excursion_" + sheet.ice, "Maximum excursion, " + sheet.meaning, "", ""}, {1000, 420}, plot.str() + "\n");
  return {sheet.number, "Maximum platform excursion against drift velocity, " + sheet.meaning,
          out / ("excursion_" + sheet.ice)};
}

std::string stamp(const PaperFolder& folder, const std::vector<ExcursionPoint>& points, const Sheet& sheet) {
  std::size_t least = SIZE_MAX;
  std::size_t most = 0;
  std::set<std::string> builds;
  for (const ExcursionPoint& point : points) {
    least = std::min(least, point.largest_m.size());
    most = std::max(most, point.largest_m.size());
    for (const PaperRun& run : folder.of(point.condition)) builds.insert(run.resolution + "  " + run.source);
  }
  std::string text = sheet.ice + "_www_uu, " + std::to_string(least);
  if (most > least) text += " to " + std::to_string(most);
  text += " seeds";
  for (const std::string& build : builds) text += ", " + build;
  return text;
}

}  // namespace

std::vector<PaperFigure> excursion_figures(const PaperFolder& folder, const std::vector<TableRow>& rows,
                                           const std::filesystem::path& out) {
  const Sheet sheets[] = {{"17", "004", "4/10 thin ice (0.5 m)"},
                          {"18", "040", "4/10 medium ice (0.7 m)"},
                          {"19", "400", "4/10 thick ice (1.2 m)"},
                          {"20", "121", "mixed thin, medium and thick ice"}};
  const std::vector<ExcursionPoint> points = excursion_points(folder, rows);
  std::vector<PaperFigure> figures;
  for (const Sheet& sheet : sheets) {
    std::vector<ExcursionPoint> own;
    for (const ExcursionPoint& point : points)
      if (point.condition.starts_with(sheet.ice + "_")) own.push_back(point);
    if (!own.empty()) figures.push_back(draw(sheet, own, stamp(folder, own, sheet), out));
  }
  return figures;
}

}  // namespace gem
