// The phases of a call that moves scenes phase by phase, and what one thread for a scene does between its moments: see
// device_phases.h.
#pragma once

#include "gem/engine/device/moments.h"

namespace gem {

enum class DevicePhase {
  open,
  begin,
  plan,
  list,
  choose,
  look,
  resolve,
  gather,
  iterate,
  settle,
  bodies,
  last_work,
  close
};

/// The phases of a call, in their order: once, for every moment, once. Only coupled scenes gather, iterate and settle.
/// Where the bodies have moved, the next moment is planned by the last who moved some.
constexpr DevicePhase first_phases[] = {DevicePhase::open, DevicePhase::begin, DevicePhase::plan};
constexpr DevicePhase moment_phases[] = {DevicePhase::list,    DevicePhase::choose, DevicePhase::look,
                                         DevicePhase::resolve, DevicePhase::gather, DevicePhase::iterate,
                                         DevicePhase::settle,  DevicePhase::bodies};
/// When the last begin, all moments that are wanted have been started: only a scene whose list found no room is open.
constexpr DevicePhase last_phases[] = {DevicePhase::plan, DevicePhase::last_work, DevicePhase::close};

/// Nothing was found in this moment so far.
GEM_DEVICE inline void forget_counts(const DeviceScene& s) {
  ListCounters& counters = *s.counters;
  counters.looks = counters.touches = counters.points = counters.taken_points = 0;
}

/// The call begins: `moments` are wanted.
GEM_DEVICE inline void open_call(const DeviceScene& s, std::int32_t moments) {
  DeviceStatus& status = *s.status;
  status.wanted = moments;
  status.samples = status.events = status.touched = 0;
  status.stop = DeviceStop::done;
  status.step = moments > 0 ? PhaseStep::begins : PhaseStep::ended;
  status.barriers = 0;
  status.visits = 0;
  forget_counts(s);
  // after moments that were made otherwise no pair sleeps until the next list
  if (status.clock_moment != status.moment) status.clock = 1e30;
  status.clock_moment = status.moment;
  status.farthest = 0;
}

/// Whether the scene makes the moment that was planned: a list for it may not have found room.
GEM_DEVICE inline bool moves(const DeviceScene& s) {
  const PhaseStep step = s.status->step;
  return step == PhaseStep::moves || (step == PhaseStep::moves_on_new_list && s.status->list_valid != 0);
}

/// Why the call stops before all its moments are made; done: it does not.
GEM_DEVICE inline DeviceStop stop_of(const DeviceScene& s, std::uint32_t alarms, bool last) {
  if (alarms & alarm_not_finite) return DeviceStop::not_finite;
  if (s.status->step == PhaseStep::moves_on_new_list && !moves(s)) return DeviceStop::list_full;
  return !last && (alarms & alarm_ring_full) ? DeviceStop::ring_full : DeviceStop::done;
}

/// Ends the moment that was made and plans the next one. Returns whether the scene needs a new list for it.
GEM_DEVICE inline bool plan_moment(const DeviceScene& s, std::uint32_t& alarms) {
  DeviceStatus& status = *s.status;
  if (status.step == PhaseStep::ended) return false;
  if (moves(s)) {
    ++status.moment;
    ++status.samples;
    status.touched = s.counters->touches;
    status.clock += 2.0 * strict::double_of(status.farthest);
    status.clock_moment = status.moment;
    status.farthest = 0;
    status.carried = 0;  // what was carried stands in the list now
  }
  forget_counts(s);
  const bool last = status.samples == status.wanted;
  status.stop = stop_of(s, alarms, last);
  status.half_way = !last;
  const bool ends = last || status.stop != DeviceStop::done;
  ListLife list(status);
  const bool lists = !ends && list.is_over(status.moment, alarms);
  if (lists || (ends && (alarms & alarm_strayed))) {
    list.end(s, status.moment);
    status.list_valid = 0;
    status.horizon = list.horizon;
    status.clock = 0.0;
    alarms = 0;
  }
  status.step = ends ? PhaseStep::ended : lists ? PhaseStep::moves_on_new_list : PhaseStep::moves;
  if (!ends && s.wants_samples) s.quality[status.samples] = {};
  return lists;
}

}  // namespace gem
