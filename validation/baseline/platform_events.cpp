#include "validation/baseline/platform_events.h"

#include <cstddef>
#include <map>

namespace gem::baseline {

PlatformEvents platform_events(const RunFile& file) {
  return {file.column("events/time"), file.column("events/body_b"), file.column("events/closing_speed")};
}

PlatformEvents faster_than(double closing_speed, const PlatformEvents& events) {
  PlatformEvents fast;
  for (std::size_t k = 0; k < events.time.size(); ++k) {
    if (events.closing_speed[k] <= closing_speed) continue;
    fast.time.push_back(events.time[k]);
    fast.floe.push_back(events.floe[k]);
    fast.closing_speed.push_back(events.closing_speed[k]);
  }
  return fast;
}

double first_after(double gap_s, const PlatformEvents& events, double from_s, double to_s) {
  std::map<double, double> last;
  double count = 0.0;
  for (std::size_t k = 0; k < events.time.size(); ++k) {
    const double time = events.time[k];
    const auto [entry, first] = last.emplace(events.floe[k], time);
    const bool counts = first || time - entry->second > gap_s;
    if (counts && time >= from_s && time <= to_s) count += 1.0;
    entry->second = time;
  }
  return count;
}

}  // namespace gem::baseline
