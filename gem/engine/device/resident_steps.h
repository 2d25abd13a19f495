// The time steps of a device scene: the order of the phases and what is done between them.
//
//   solo events of the first time step
//   repeat:  the list of near pairs, where it has worn out
//            pairs phase                               | barrier
//            coupled: the iterations                   | barrier
//            bodies phase, with the solo events of the next time step | barrier
//   the books of the last time step
#pragma once

#include "gem/engine/device/bodies.h"
#include "gem/engine/device/list.h"
#include "gem/engine/device/pairs.h"
#include "gem/engine/device/platform.h"
#include "gem/engine/solver/device_solver.h"

namespace gem {

/// Solo events up to the instant of the first time step's pair events.
template <class Group>
GEM_DEVICE inline void first_solo_events(const DeviceScene& s, const Group& group, const Workspace& workspace) {
  for (std::int32_t i = workspace.first_body; i < workspace.bodies.end; i += workspace.body_step) {
    if (i == 0 || workspace.body[i].kind != BodyKind::floe || !workspace.body[i].active) continue;
    Mover mover = mover_of(workspace.body[i]);
    kick_body(s, mover, workspace.motion[i], s.after[i], s.book(Channel::drag, i));
    write_mover(workspace.body[i], mover);
    write_mover(s.body[i], mover);
  }
  if (!workspace.platform || group.warp().rank() != 0) return;
  Mover mover = mover_of(workspace.body[0]);
  PlatformLoaded loaded = load_platform(s);
  platform_first_half(s, loaded, mover, workspace.motion[0].mass, s.after[0].spin);
  store_platform(s, loaded);
  write_mover(workspace.body[0], mover);
  write_mover(s.body[0], mover);
}

/// The bodies of one time step move.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void move_bodies(const DeviceScene& s, Group& group, const Workspace& workspace,
                                   const StepIndex& step) {
  for (std::int32_t i = workspace.first_body; i < workspace.bodies.end; i += workspace.body_step)
    move_body<solver>(s, group, workspace, i, step);
  if (workspace.platform) move_platform<solver>(s, group, workspace, step);
}

/// The bodies phase of one time step.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void bodies_phase(const DeviceScene& s, Group& group, const Workspace& workspace,
                                    const StepIndex& step) {
  BlockCell& shared = group.shared();
  if (group.thread() == 0) {
    if (s.wants_samples)
      s.quality[step.sample * group.blocks() + group.block()] = {
          shared.overlap,  shared.share,          shared.contacts,        shared.iterations,
          shared.residual, shared.energy_created, shared.complementarity, shared.cone_excess};
    shared.overlap = shared.share = shared.complementarity = shared.cone_excess = 0;
    shared.contacts = shared.touching_count = shared.points = shared.iterations = 0;
    shared.residual = shared.energy_created = 0.0;
    if (group.block() == 0) {
      s.counters->points = s.counters->taken_points = 0;
      s.counters->crowded = 0;
    }
  }
  move_bodies<solver>(s, group, workspace, step);
}

/// Brings the books of contact work up to date; no contact is left waiting.
template <class Group>
GEM_DEVICE inline void close_work(const DeviceScene& s, Group& group, const Workspace& workspace, std::int32_t step) {
  const std::int32_t stamp = -2 - step;  // unlike the stamp of any time step
  work_of_last_step(s, group, workspace, stamp);
  group.barrier();
  if (group.thread() == 0) group.shared().touched = 0;
  for (std::int32_t i = workspace.first_body; i < workspace.bodies.end; i += workspace.body_step)
    gather_work(s, i, workspace.motion[i], stamp);
}

/// The state at rest, for the host.
template <class Group>
GEM_DEVICE inline void write_state(const DeviceScene& s, const Group& group) {
  for (std::int32_t i = rank_of(group); i < s.bodies; i += size_of(group)) {
    const BodyCell& cell = s.body[i];
    const Vec2 velocity = i == 0 ? s.platform->velocity : s.after[i].velocity;
    s.state[i] = {cell.position, cell.rotation, velocity, s.after[i].spin, cell.active};
  }
}

/// How long the list of near pairs may still be used.
struct ListLife {
  std::int64_t begin = 0;    // time step at whose start the list was built
  std::int64_t horizon = 1;  // time steps that it was built for, or that the next one is
  bool valid = false;

  GEM_DEVICE explicit ListLife(const DeviceStatus& status)
      : begin(status.list_step), horizon(status.horizon), valid(status.list_valid != 0) {}

  GEM_DEVICE bool is_over(std::int64_t step, std::uint32_t alarms) const {
    return !valid || step - begin >= horizon || (alarms & alarm_strayed);
  }
  /// Fast floes leave their courses early, and what they might reach later would only make the next list long: it is
  /// built for twice the time that this one lived.
  GEM_DEVICE void end(const DeviceScene& s, std::int64_t step) {
    constexpr std::int64_t shortest = 4;
    if (!valid) return;
    const std::int64_t next = 2 * (step - begin) > shortest ? 2 * (step - begin) : shortest;
    horizon = next < s.horizon ? next : s.horizon;
    valid = false;
  }
};

/// advance_scene() of one solver: what the other needs would only take registers.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void advance_resolved(const DeviceScene& s, Group& group, std::int32_t steps) {
  DeviceStatus& status = *s.status;
  const bool one = rank_of(group) == 0;
  const std::int64_t start = status.step;
  ListLife list(status);
  constexpr bool coupled = solver == ContactSolver::coupled;
  bool carried = true;  // the memory of the last time step stands apart from the list
  if (group.thread() == 0) group.shared() = {};
  group.block_barrier();
  Workspace workspace = make_workspace(s, group);
  load_bodies(s, group, workspace);
  load_pairs(s, group, workspace);
  group.block_barrier();
  if (!status.half_way) first_solo_events(s, group, workspace);
  group.barrier();
  if (one) {
    status.half_way = 1;
    status.events = 0;
  }
  for (std::int32_t k = rank_of(group); k < 2 * OverlapCount::classes; k += size_of(group)) s.overlap_count[k] = 0;
  group.barrier();

  DeviceStop stop = DeviceStop::done;
  std::int32_t done = 0;
  for (; done < steps; ++done) {
    const std::int32_t step = static_cast<std::int32_t>(start) + done;
    const std::uint32_t alarms = group.alarms();
    if (alarms & (alarm_not_finite | alarm_ring_full)) {
      stop = alarms & alarm_not_finite ? DeviceStop::not_finite : DeviceStop::ring_full;
      break;
    }
    if (list.is_over(step, alarms)) {
      list.end(s, step);
      if constexpr (coupled)
        if (!carried) carry_memory(s, group, workspace);
      carried = true;
      close_work(s, group, workspace, step);
      group.block_barrier();
      store_bodies(s, group, workspace);
      store_pairs(s, group, workspace);
      build_list(s, group, step, list.horizon);
      load_bodies(s, group, workspace);
      load_pairs(s, group, workspace);
      group.block_barrier();
      list.valid = !(group.alarms() & alarm_list_full);
      list.begin = step;
      if (!list.valid) {
        stop = DeviceStop::list_full;
        break;
      }
      if constexpr (coupled) hand_out_memory(s, group, step);
    }
    pairs_phase<solver>(s, group, workspace, step);
    group.barrier();
    if constexpr (coupled) resolve_coupled(s, group, workspace, step);
    carried = false;
    const double elapsed = static_cast<double>(step + 1 - list.begin) * s.constants.dt;
    bodies_phase<solver>(s, group, workspace, {step, done, elapsed, done + 1 < steps});
    group.barrier();
  }
  if (stop == DeviceStop::done && (group.alarms() & alarm_not_finite)) stop = DeviceStop::not_finite;
  if (group.alarms() & alarm_strayed) list.end(s, start + done);

  if constexpr (coupled)
    if (!carried) carry_memory(s, group, workspace);
  close_work(s, group, workspace, static_cast<std::int32_t>(start) + done);
  group.block_barrier();
  store_bodies(s, group, workspace);
  store_pairs(s, group, workspace);
  write_state(s, group);
  group.barrier();
  if (one) {
    status.step = start + done;
    status.samples = done;
    status.list_valid = list.valid;
    status.horizon = list.horizon;
    status.half_way = done < steps;
    status.barriers = group.barriers();
    status.stop = stop;
    status.visits = 0;  // counted by phases only
  }
}

/// Moves the scene on by `steps` time steps, or less where something has to be done by the host first: the status says.
template <class Group>
GEM_DEVICE inline void advance_scene(const DeviceScene& s, Group& group, std::int32_t steps) {
  // a scene that waits for others of its batch: its next time step has not begun
  if (steps == 0) return;
  if (s.constants.solver == ContactSolver::coupled)
    advance_resolved<ContactSolver::coupled>(s, group, steps);
  else
    advance_resolved<ContactSolver::independent>(s, group, steps);
}

}  // namespace gem
