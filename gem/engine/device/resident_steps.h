// The time steps of a device scene by blocks that stay with it for a whole call. The stages of gem/engine/step/stages.h
// are made together as follows:
//
// | stages                                   | made as                                                                |
// |------------------------------------------|------------------------------------------------------------------------|
// | list                                     | a new list of near pairs, when the list is stale                       |
// | candidates, narrow_phase, contact_events | the pair stages, one pass for each workspace of pairs; then a barrier  |
// | gather, iterate, settle                  | the coupled solver, with barriers of its own                           |
// | books, move, solo_events of the next     | the body stages, all three for one body after another; then a barrier  |
#pragma once

#include "gem/engine/device/bodies.h"
#include "gem/engine/device/list.h"
#include "gem/engine/device/pairs.h"
#include "gem/engine/device/platform.h"
#include "gem/engine/solver/device/device_solver.h"
#include "gem/engine/step/stages.h"

namespace gem {

/// Makes the solo events up to the first pair events of a call: those of its time step 0. carry_pieces() has to follow
/// a barrier later, when all blocks have copied their bodies.
template <class Group>
GEM_DEVICE inline void first_solo_events(const DeviceScene& s, const Group& group, const Workspace& workspace) {
  for (std::int32_t i = workspace.first_body; i < workspace.bodies.end; i += workspace.body_step) {
    if (i == 0 || workspace.body[i].kind != BodyKind::floe || !workspace.body[i].active) continue;
    Mover mover = mover_of(workspace.body[i]);
    kick_body(s, i, workspace.body[i], mover, workspace.motion[i], s.after[i], s.book(Channel::drag, i), 0);
    write_mover(workspace.body[i], mover);
    write_mover(s.body[i], mover);
  }
  if (!workspace.platform || group.warp().rank() != 0) return;
  Mover mover = mover_of(workspace.body[0]);
  PlatformLoaded loaded = load_platform(s);
  platform_first_half(s, loaded, mover, turn_of(workspace.body[0], workspace.motion[0], mover.rotation, mover.rotation),
                      s.platform->spin, 0);
  store_platform(s, loaded);
  write_mover(workspace.body[0], mover);
  write_mover(s.body[0], mover);
}

/// Moves the bodies of the block by one time step.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void move_bodies(const DeviceScene& s, Group& group, const Workspace& workspace,
                                   const StepIndex& step) {
  for (std::int32_t i = workspace.first_body; i < workspace.bodies.end; i += workspace.body_step)
    move_body<solver>(s, group, workspace, i, step);
  if (workspace.platform) move_platform<solver>(s, group, workspace, step);
}

/// The body stages of one time step.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void body_stages(const DeviceScene& s, Group& group, const Workspace& workspace,
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
      s.counters->halo_overflow = 0;
    }
  }
  move_bodies<solver>(s, group, workspace, step);
}

/// Brings the books of contact work up to date for all contacts.
template <class Group>
GEM_DEVICE inline void close_work(const DeviceScene& s, Group& group, const Workspace& workspace, std::int32_t step) {
  const std::int32_t stamp = -2 - step;  // unlike the stamp of any time step
  work_of_last_step(s, group, workspace, stamp);
  group.barrier();
  if (group.thread() == 0) group.shared().touched = 0;
  for (std::int32_t i = workspace.first_body; i < workspace.bodies.end; i += workspace.body_step)
    add_row_work(s, i, workspace.motion[i], stamp);
}

/// Writes the state that the host fetches after a call.
template <class Group>
GEM_DEVICE inline void write_state(const DeviceScene& s, const Group& group) {
  for (std::int32_t i = rank_of(group); i < s.bodies; i += size_of(group)) {
    const BodyCell& cell = s.body[i];
    const bool platform = s.constants.is_platform(i);
    const Vec2 velocity = platform ? s.platform->velocity : s.after[i].velocity;
    const double spin = platform ? s.platform->spin : s.after[i].spin;
    s.state[i] = {cell.position, cell.rotation, velocity, spin, cell.active};
  }
}

/// The life of the list of near pairs.
struct ListLife {
  std::int64_t begin = 0;    // time step at whose start the list was built
  std::int64_t horizon = 1;  // planned life in time steps; if not valid: of the next list
  bool valid = false;

  GEM_DEVICE explicit ListLife(const DeviceStatus& status)
      : begin(status.list_step), horizon(status.horizon), valid(status.list_valid != 0) {}

  GEM_DEVICE bool is_over(std::int64_t step, std::uint32_t alarms) const {
    return !valid || step - begin >= horizon || (alarms & alarm_strayed);
  }
  /// Ends the list. The next list is built for twice the life of this one: fast floes leave their assumed paths early,
  /// and a longer horizon would only make the list longer.
  GEM_DEVICE void end(const DeviceScene& s, std::int64_t step) {
    constexpr std::int64_t shortest = 4;
    if (!valid) return;
    const std::int64_t next = 2 * (step - begin) > shortest ? 2 * (step - begin) : shortest;
    horizon = next < s.horizon ? next : s.horizon;
    valid = false;
  }
};

/// advance_scene() for one solver. A class for both would take more registers.
template <ContactSolver solver, class Group>
class ResidentSteps {
 public:
  GEM_DEVICE ResidentSteps(const DeviceScene& s, Group& group, std::int32_t steps)
      : s_(s), group_(group), steps_(steps), start_(s.status->step), list_(*s.status) {}

  GEM_DEVICE void advance() {
    begin();
    for (; done_ < steps_ && goes_on(); ++done_) {
      for_each_stage([&](auto stage) {
        if (stop_ == DeviceStop::done) run<stage.value>();
      });
      if (stop_ != DeviceStop::done) break;
    }
    end();
  }

 private:
  static constexpr bool coupled = solver == ContactSolver::coupled;

  GEM_DEVICE std::int32_t step() const { return static_cast<std::int32_t>(start_) + done_; }

  template <Stage stage>
  GEM_DEVICE void run() {
    if constexpr (stage == Stage::list) {
      if (list_.is_over(step(), group_.alarms())) renew_list();
    }
    if constexpr (stage == Stage::candidates) {  // with narrow_phase and contact_events
      pair_stages<solver>(s_, group_, workspace_, step());
      group_.barrier();
    }
    if constexpr (stage == Stage::gather && coupled)  // with iterate and settle
      resolve_coupled(s_, group_, workspace_, step());
    if constexpr (stage == Stage::move) {  // with books, and solo_events of the next time step
      carried_ = false;
      const double elapsed = static_cast<double>(step() + 1 - list_.begin) * s_.constants.dt;
      body_stages<solver>(s_, group_, workspace_, {step(), done_, elapsed, done_ + 1 < steps_});
      group_.barrier();
    }
  }

  GEM_DEVICE void begin() {
    if (group_.thread() == 0) group_.shared() = {};
    group_.block_barrier();
    workspace_ = make_workspace(s_, group_);
    load_bodies(s_, group_, workspace_);
    load_pairs(s_, group_, workspace_);
    group_.block_barrier();
    if (!s_.status->solo_events_done) first_solo_events(s_, group_, workspace_);
    group_.barrier();
    if (rank_of(group_) == 0) {
      carry_pieces(s_);
      s_.status->solo_events_done = 1;
      s_.status->events = s_.status->forces = 0;
    }
    for (std::int32_t k = rank_of(group_); k < 2 * OverlapCount::classes; k += size_of(group_)) s_.overlap_count[k] = 0;
    group_.barrier();
  }

  /// Whether no alarm stops the call.
  GEM_DEVICE bool goes_on() {
    const std::uint32_t alarms = group_.alarms();
    if (alarms & alarm_not_finite)
      stop_ = DeviceStop::not_finite;
    else if (alarms & alarm_ring_full)
      stop_ = DeviceStop::ring_full;
    return stop_ == DeviceStop::done;
  }

  GEM_DEVICE void renew_list() {
    list_.end(s_, step());
    store(false);
    build_list(s_, group_, step(), list_.horizon);
    load_bodies(s_, group_, workspace_);
    load_pairs(s_, group_, workspace_);
    group_.block_barrier();
    list_.valid = !(group_.alarms() & alarm_list_full);
    list_.begin = step();
    if (!list_.valid)
      stop_ = DeviceStop::list_full;
    else if constexpr (coupled)
      hand_out_memory(s_, group_, step());
  }

  /// Brings the scene's memory up to date. `last`: the call ends.
  GEM_DEVICE void store(bool last) {
    if constexpr (coupled)
      if (!carried_) carry_memory(s_, group_, workspace_);
    carried_ = true;
    if (records_forces(s_, last)) note_forces(s_, group_, workspace_, std::int64_t{step()} - 1);
    close_work(s_, group_, workspace_, step());
    group_.block_barrier();
    store_bodies(s_, group_, workspace_);
    store_pairs(s_, group_, workspace_);
  }

  GEM_DEVICE void end() {
    if (stop_ == DeviceStop::done && (group_.alarms() & alarm_not_finite)) stop_ = DeviceStop::not_finite;
    if (group_.alarms() & alarm_strayed) list_.end(s_, step());
    store(true);
    write_state(s_, group_);
    group_.barrier();
    if (rank_of(group_) != 0) return;
    DeviceStatus& status = *s_.status;
    status.step = start_ + done_;
    status.samples = done_;
    status.list_valid = list_.valid;
    status.horizon = list_.horizon;
    status.solo_events_done = done_ < steps_;
    status.barriers = group_.barriers();
    status.stop = stop_;
    status.visits = 0;  // counted only on the phases route
  }

  const DeviceScene& s_;
  Group& group_;
  std::int32_t steps_;
  std::int64_t start_;
  ListLife list_;
  Workspace workspace_;
  bool carried_ = true;  // the last impulses stand in DeviceScene::carried, not in the list
  DeviceStop stop_ = DeviceStop::done;
  std::int32_t done_ = 0;
};

/// Moves the scene on by `steps` time steps, or by fewer if the host has to act first. DeviceStatus says how many and
/// why.
template <class Group>
GEM_DEVICE inline void advance_scene(const DeviceScene& s, Group& group, std::int32_t steps) {
  // a scene that waits for others of its batch stays as it is
  if (steps == 0) return;
  switch (s.constants.solver) {  // others are refused by check_solver()
    case ContactSolver::coupled:
      ResidentSteps<ContactSolver::coupled, Group>(s, group, steps).advance();
      break;
    case ContactSolver::independent:
      ResidentSteps<ContactSolver::independent, Group>(s, group, steps).advance();
      break;
    case ContactSolver::compliant:
      break;
  }
}

}  // namespace gem
