// Lists the series of a summary and adds them as columns.
#include "gem/report/run/summary_series.h"

#include <algorithm>
#include <limits>
#include <map>

namespace gem {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
using Values = std::vector<double>;

PlatformPath& path_in(RunSeries& run) { return run.path ? *run.path : run.path.emplace(); }

SummaryAxis axis_of(const std::string& name, std::size_t length, double interval_s) {
  SummaryAxis axis{name, name == "cycle" ? "1" : "s", "", {}};
  double step = 1.0;
  if (name == "time") {
    axis.long_name = "time since the start of the run";
    step = interval_s;
  } else if (name == "block") {
    axis.long_name = "start of the block";
    step = kBlockLength;
  } else {
    axis.long_name = "natural periods since the start";
  }
  for (std::size_t i = 0; i < length; ++i) axis.values.push_back(step * static_cast<double>(i));
  return axis;
}

}  // namespace

const std::vector<SeriesEntry>& summary_series() {
  static const std::vector<SeriesEntry> list = {
      {"time", "displacement_x", "m", "platform centre from rest, x",
       [](RunSeries& r) -> Values& { return path_in(r).x; }},
      {"time", "displacement_y", "m", "platform centre from rest, y",
       [](RunSeries& r) -> Values& { return path_in(r).y; }},
      {"time", "velocity_x", "m s-1", "platform velocity, x", [](RunSeries& r) -> Values& { return path_in(r).vx; }},
      {"time", "velocity_y", "m s-1", "platform velocity, y", [](RunSeries& r) -> Values& { return path_in(r).vy; }},
      {"cycle", "excursion_peak", "m", "largest distance from rest in each natural period",
       [](RunSeries& r) -> Values& { return r.excursion_peaks; }},
      {"block", "block_mean_x", "m", "mean of x over a block", [](RunSeries& r) -> Values& { return r.blocks.mean_x; }},
      {"block", "block_deviation_x", "m", "standard deviation of x within a block",
       [](RunSeries& r) -> Values& { return r.blocks.deviation_x; }},
      {"block", "block_deviation_y", "m", "standard deviation of y within a block",
       [](RunSeries& r) -> Values& { return r.blocks.deviation_y; }},
      {"block", "block_largest_excursion", "m", "largest distance from rest in a block",
       [](RunSeries& r) -> Values& { return r.blocks.largest_excursion; }},
      {"block", "block_largest_ice_force", "N", "largest mean ice force over output.force_window_s in a block",
       [](RunSeries& r) -> Values& { return r.blocks.largest_ice_force; }}};
  return list;
}

void add_series(SummaryTable& table, const std::vector<RunSeries>& given) {
  std::vector<RunSeries> runs = given;  // a copy, because an entry may also write to its run
  double interval_s = 0.0;
  bool exact = true;
  for (const RunSeries& run : runs) {
    if (!run.path) continue;
    interval_s = std::max(interval_s, run.path->interval_s);
    exact = exact && run.path->exact;
  }
  std::map<std::string, std::size_t> longest;
  for (const SeriesEntry& entry : summary_series())
    for (RunSeries& run : runs) longest[entry.axis] = std::max(longest[entry.axis], entry.values(run).size());
  for (const auto& [axis, length] : longest)
    if (length > 0) table.axes.push_back(axis_of(axis, length, interval_s));
  for (const SeriesEntry& entry : summary_series()) {
    const std::size_t length = longest[entry.axis];
    const bool any = std::any_of(runs.begin(), runs.end(), [&](RunSeries& run) { return !entry.values(run).empty(); });
    if (!any) continue;
    SummarySeries series{entry.name, entry.units, entry.long_name, entry.axis,
                         exact && std::string(entry.axis) == "time"};
    for (RunSeries& run : runs) {
      Values row = entry.values(run);
      row.resize(length, nothing);
      series.values.insert(series.values.end(), row.begin(), row.end());
    }
    table.series.push_back(std::move(series));
  }
}

}  // namespace gem
