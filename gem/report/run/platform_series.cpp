// Takes the ends of columns, measured from the rest position.
#include "gem/report/run/platform_series.h"

#include <algorithm>

#include "gem/report/run/run_findings.h"

namespace gem {
namespace {

/// The end of a column from a sample on, minus a constant. A column that the run does not have stays empty.
std::vector<double> tail(const std::vector<double>& column, std::size_t first, double less = 0.0) {
  if (column.empty()) return {};
  std::vector<double> kept(column.begin() + static_cast<std::ptrdiff_t>(first), column.end());
  for (double& value : kept) value -= less;
  return kept;
}

}  // namespace

std::size_t sample_from(const RunData& run, double from_s) {
  const std::vector<double>& time = run.platform.time;
  return static_cast<std::size_t>(std::lower_bound(time.begin(), time.end(), from_s) - time.begin());
}

PlatformSeries platform_series(const RunData& run, std::size_t first) {
  const PlatformRecord& p = run.platform;
  // without a mooring the control sets the period, if there is one
  const double period = run.natural_period_s > 0.0 ? run.natural_period_s : run.dp.period;
  return {sample_interval(p.time),         period,
          tail(p.x, first, run.rest.x),    tail(p.y, first, run.rest.y),
          tail(p.ice_force_x, first),      tail(p.ice_force_y, first),
          tail(p.ice_force_mean_x, first), tail(p.ice_force_mean_y, first),
          tail(p.mooring_force_x, first),  tail(p.mooring_force_y, first),
          tail(p.contacts, first),         tail(p.drag_force_x, first),
          tail(p.drag_force_y, first)};
}

}  // namespace gem
