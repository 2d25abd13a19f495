// Cuts off the beginning of the records of a run.
#include <algorithm>

#include "gem/report/compare/comparison.h"
#include "gem/report/run/platform_series.h"

namespace gem {
namespace {

template <class T>
void drop(std::vector<T>& column, std::size_t count) {
  column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(std::min(count, column.size())));
}

EventColumns events_since(const EventColumns& events, double from_s) {
  EventColumns kept;
  for (std::size_t i = 0; i < events.time.size(); ++i) {
    if (events.time[i] < from_s) continue;
    kept.time.push_back(events.time[i]);
    kept.body_b.push_back(events.body_b[i]);
    kept.nx.push_back(events.nx[i]);
    kept.ny.push_back(events.ny[i]);
    kept.impulse.push_back(events.impulse[i]);
    kept.force_peak.push_back(events.force_peak[i]);
  }
  return kept;
}

void drop_platform(PlatformRecord& p, std::size_t first) {
  for (auto* column : {&p.time, &p.x, &p.y, &p.ice_force_x, &p.ice_force_y, &p.ice_force_mean_x, &p.ice_force_mean_y,
                       &p.mooring_force_x, &p.mooring_force_y, &p.contacts, &p.yaw, &p.drag_force_x, &p.drag_force_y})
    drop(*column, first);
}

void drop_transit(TransitRecord& t, std::size_t first) {
  for (auto* column :
       {&t.time, &t.distance, &t.resistance, &t.resistance_window, &t.side_window, &t.pull, &t.across, &t.made_good})
    drop(*column, first);
}

void drop_thrusters(DpRecord& dp, std::size_t first) {
  for (auto* column : {&dp.offset, &dp.yaw, &dp.demand}) drop(*column, first);
  for (ThrusterSamples& thruster : dp.thruster) {
    drop(thruster.thrust, first);
    drop(thruster.at_limit, first);
  }
}

void drop_fixed(FixedRecord& fixed, double from_s) {
  const auto begin = std::lower_bound(fixed.time.begin(), fixed.time.end(), from_s);
  const auto frames = static_cast<std::size_t>(begin - fixed.time.begin());
  drop(fixed.time, frames);
  for (std::vector<Vec2>& force : fixed.force) drop(force, frames);
}

}  // namespace

RunData since(RunData run, double from_s) {
  const std::size_t first = sample_from(run, from_s);
  drop_platform(run.platform, first);
  drop_transit(run.transit, first);
  drop_thrusters(run.dp, first);
  drop_fixed(run.on_fixed, from_s);
  for (LineRecord& line : run.lines) drop(line.tension, first);
  run.events = events_since(run.events, from_s);
  return run;
}

}  // namespace gem
