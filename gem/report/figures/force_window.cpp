// Slides a window over the impacts and keeps the fullest.
#include "gem/report/figures/force_window.h"

#include <algorithm>
#include <cmath>

#include "gem/analysis/statistics/moments.h"
#include "gem/report/figures/series.h"
#include "gem/report/run/run_findings.h"

namespace gem {
namespace {

TimeWindow around(const PlatformRecord& p, double middle, double length_s) {
  const double latest = std::max(p.time.front(), p.time.back() - length_s);
  const double from = std::clamp(middle - 0.5 * length_s, p.time.front(), latest);
  return {from, std::min(from + length_s, p.time.back())};
}

double largest_force_within(const PlatformRecord& p, const TimeWindow& window) {
  const SampleRange range = samples_within(p.time, window.from, window.to);
  double largest = 0.0;
  for (std::size_t i = range.begin; i < range.end; ++i) largest = std::max(largest, std::abs(p.ice_force_x[i]));
  return largest;
}

/// Times of the impacts within the record, ascending.
std::vector<double> impact_times(const RunData& run) {
  std::vector<double> times;
  for (const std::size_t i : opening_events(run.events)) {
    const double time = run.events.time[i];
    if (time >= run.platform.time.front() && time <= run.platform.time.back()) times.push_back(time);
  }
  std::sort(times.begin(), times.end());
  return times;
}

}  // namespace

TimeWindow force_window(const RunData& run, double length_s) {
  const PlatformRecord& p = run.platform;
  if (run.at_s) return around(p, *run.at_s, length_s);
  const std::vector<double> times = impact_times(run);
  if (times.empty()) return around(p, p.time[maximum_excursion(p.ice_force_x).sample], length_s);
  TimeWindow best{};
  std::size_t most = 0, end = 0;
  double force = -1.0;
  for (std::size_t begin = 0; begin < times.size(); ++begin) {
    while (end < times.size() && times[end] <= times[begin] + length_s) ++end;
    if (end - begin < most) continue;
    const TimeWindow window = around(p, 0.5 * (times[begin] + times[end - 1]), length_s);
    const double largest = largest_force_within(p, window);
    if (end - begin == most && largest <= force) continue;
    best = window;
    most = end - begin;
    force = largest;
  }
  return best;
}

}  // namespace gem
