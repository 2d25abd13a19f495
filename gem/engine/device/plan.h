// What one thread for each scene does between the time steps of a call that runs stage by stage (phases.h).
#pragma once

#include "gem/engine/device/resident_steps.h"
#include "gem/engine/step/stages.h"

namespace gem {

/// Stages of a call before and after its time steps. The last block that moves bodies of a scene plans its next time
/// step. So when call_ends begins, only a scene whose list did not fit in memory is still open.
constexpr Stage call_begins[] = {Stage::open_call, Stage::first_solo_events, Stage::plan};
constexpr Stage call_ends[] = {Stage::plan, Stage::last_books, Stage::close_call};

/// Stages that a device makes together with `move`: a body's row holds what its books need, and the solo events of the
/// next time step follow at once.
constexpr bool goes_with_move(Stage stage) { return stage == Stage::solo_events || stage == Stage::books; }

/// Resets the counts of a time step.
GEM_DEVICE inline void forget_counts(const DeviceScene& s) {
  ListCounters& counters = *s.counters;
  counters.candidates = counters.touching_count = counters.points = counters.taken_points = 0;
}

/// Begins a call of `steps` time steps.
GEM_DEVICE inline void open_call(const DeviceScene& s, std::int32_t steps) {
  DeviceStatus& status = *s.status;
  status.wanted = steps;
  status.samples = status.events = status.forces = status.touched = 0;
  status.stop = DeviceStop::done;
  status.phase_step = steps > 0 ? PhaseStep::begins : PhaseStep::ended;
  status.barriers = 0;
  status.visits = 0;
  forget_counts(s);
  // time steps by another route do not advance the clock: no pair sleeps until the next list
  if (status.clock_step != status.step) status.clock = 1e30;
  status.clock_step = status.step;
  status.farthest = 0;
}

/// Whether the scene makes the planned time step; it does not if the list for it did not fit in memory.
GEM_DEVICE inline bool moves(const DeviceScene& s) {
  const PhaseStep step = s.status->phase_step;
  return step == PhaseStep::moves || (step == PhaseStep::moves_on_new_list && s.status->list_valid != 0);
}

/// Why the call stops before it has made all its time steps; DeviceStop::done: it does not stop.
GEM_DEVICE inline DeviceStop stop_of(const DeviceScene& s, std::uint32_t alarms, bool last) {
  if (alarms & alarm_not_finite) return DeviceStop::not_finite;
  if (s.status->phase_step == PhaseStep::moves_on_new_list && !moves(s)) return DeviceStop::list_full;
  if (alarms & alarm_solver_full) return DeviceStop::solver_full;
  return !last && (alarms & alarm_ring_full) ? DeviceStop::ring_full : DeviceStop::done;
}

/// Ends a time step and plans the next one. Returns whether the scene needs a new list for it.
GEM_DEVICE inline bool plan_step(const DeviceScene& s, std::uint32_t& alarms) {
  DeviceStatus& status = *s.status;
  if (status.phase_step == PhaseStep::ended) return false;
  carry_pieces(s);  // now no block writes back the pieces as they were
  if (moves(s)) {
    ++status.step;
    ++status.samples;
    status.touched = s.counters->touching_count;
    status.clock += 2.0 * strict::double_of(status.farthest);
    status.clock_step = status.step;
    status.farthest = 0;
    status.carried = 0;  // the new list has taken over the carried impulses
  }
  forget_counts(s);
  const bool last = status.samples == status.wanted;
  status.stop = stop_of(s, alarms, last);
  status.solo_events_done = !last;
  const bool ends = last || status.stop != DeviceStop::done;
  ListLife list(status);
  const bool lists = !ends && list.is_over(status.step, alarms);
  if (lists || (ends && (alarms & alarm_strayed))) {
    list.end(s, status.step);
    status.list_valid = 0;
    status.horizon = list.horizon;
    status.clock = 0.0;
    alarms = 0;
  }
  status.phase_step = ends ? PhaseStep::ended : lists ? PhaseStep::moves_on_new_list : PhaseStep::moves;
  if (!ends && s.wants_samples) s.quality[status.samples] = {};
  return lists;
}

}  // namespace gem
