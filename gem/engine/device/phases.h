// The time steps of scenes stage by stage (gem/engine/step/stages.h): one launch makes one stage of all scenes. A
// kernel takes only the registers that its stage needs, so more threads run at a time and hide the latency of memory.
// This pays where there is more work than threads.
//
// | stage             | who                         | what                                                          |
// |-------------------|-----------------------------|---------------------------------------------------------------|
// | open_call         | a thread for a scene        | the call begins                                               |
// | first_solo_events | all                         | solo events up to the first pair events                       |
// | plan              | a thread for a scene        | plans the first time step; ends a call that lacks a list      |
// | list              | all, if the list is stale   | brings the books up to date, builds a new list                |
// | candidates        | a thread for a pair         | work of the last time step's contacts; pairs that may touch   |
// | narrow_phase      | lanes for a pair            | where the candidates touch                                    |
// | contact_events    | a thread for a pair         | the event of a touching pair; coupled: its points             |
// | gather            | a cluster of blocks, or one | coupled: assigns the points to blocks, sets where they begin  |
// |                   | block for few points        |                                                               |
// | iterate           | as gather                   | coupled: the first round of iterations, usually the only one  |
// | settle            | as gather                   | coupled: further rounds if any, then the result               |
// | move              | a thread for a body         | books, motion, next solo events (bodies.h); the last block of |
// |                   |                             | a scene plans its next time step                              |
// | last_books        | all                         | the work of the last time step's contacts                     |
// | close_call        | all                         | the books of the last time step, and the state for the host   |
//
// Only the scene's memory and its alarms last from one stage to the next. Within a stage blocks meet only where they
// build a list or iterate.
#pragma once

#include <cstddef>

#include "gem/engine/device/plan.h"
#include "gem/engine/solver/splitting/device/device_splitting.h"

namespace gem {

/// Makes the solo events up to the first pair events of the call.
template <class Group>
GEM_DEVICE inline void begin_call(const DeviceScene& s, Group& group) {
  if (!s.status->solo_events_done) first_solo_events(s, group, share_bodies(s, group));
  for (std::int32_t k = rank_of(group); k < 2 * OverlapCount::classes; k += size_of(group)) s.overlap_count[k] = 0;
}

/// Computes the work of the last time step's contacts, and records their forces. `carries`: also copies their impulses
/// out of the list. `last`: the call ends.
template <class Group>
GEM_DEVICE inline void close_contacts(const DeviceScene& s, Group& group, std::int32_t stamp, bool carries,
                                      bool last = false) {
  const bool records = records_forces(s, last);
  for (std::int32_t k = rank_of(group); k < s.status->touched; k += size_of(group)) {
    const std::int32_t p = s.touched[k];
    work_of_contact(s, s.pair[p], s.contact[p], stamp);
    if (carries) carry_pair(s, group, s.pair[p], s.memory[p]);
    if (records) note_force(s, group, s.contact[p], s.status->step - 1);
  }
}

GEM_HD inline bool is_coupled(const DeviceScene& s) { return s.constants.solver == ContactSolver::coupled; }
GEM_HD inline bool is_splitting(const DeviceScene& s) {
  return is_coupled(s) && s.constants.iteration == Iteration::splitting;
}

/// Stamp of books that are closed between two time steps. No time step has it.
GEM_DEVICE inline std::int32_t closing_stamp(const DeviceScene& s) {
  return -2 - static_cast<std::int32_t>(s.status->step);
}

/// Adds the work of all contacts to the books of the bodies, after close_contacts() of all blocks.
template <class Group>
GEM_DEVICE inline void close_bodies(const DeviceScene& s, Group& group) {
  const std::int32_t stamp = closing_stamp(s);
  for (std::int32_t i = rank_of(group); i < s.bodies; i += size_of(group)) add_row_work(s, i, s.motion[i], stamp);
}

/// Builds a new list, by blocks that meet at barriers.
template <class Group>
GEM_DEVICE inline void renew_list(const DeviceScene& s, Group& group) {
  close_contacts(s, group, closing_stamp(s), is_coupled(s));
  group.barrier();
  close_bodies(s, group);
  build_list(s, group, s.status->step, s.status->horizon);
  if (is_coupled(s) && s.status->list_valid) hand_out_memory(s, group, static_cast<std::int32_t>(s.status->step));
  if (rank_of(group) != 0) return;
  s.status->touched = 0;
  s.status->drift = list_drift(s);
}

/// Pairs that a thread loads together.
constexpr int loaded_pairs = 8;
/// Shared memory of a block in stage `candidates`: the awake ones of its pairs [bytes].
constexpr std::size_t candidate_shared_bytes = loaded_pairs * phase_threads * sizeof(std::int32_t);

/// Lists the pairs of a range that are awake. The clock sums up twice the largest distance that any body moves in a
/// time step [m]. A pair that had a gap sleeps until the clock has advanced by that gap. Most pairs sleep.
template <class Group>
GEM_DEVICE inline void list_awake(const DeviceScene& s, Group& group, Stretch pairs, float clock, std::int32_t* awake) {
  float wake[loaded_pairs];
  const std::int32_t first = pairs.begin + group.thread(), step = group.threads();
  for (int k = 0; k < loaded_pairs; ++k) wake[k] = first + k * step < pairs.end ? s.wake[first + k * step] : 0.0F;
  for (int k = 0; k < loaded_pairs; ++k)
    if (first + k * step < pairs.end && !(wake[k] > clock))
      awake[group.add(&group.shared().candidates, 1)] = first + k * step;
}

/// Finds the pairs that may touch now, one range of pairs after another.
template <class Group>
GEM_DEVICE inline void choose_pairs(const DeviceScene& s, Group& group) {
  close_contacts(s, group, static_cast<std::int32_t>(s.status->step), false);
  const auto next_candidate = [&]() -> CandidatePair& { return s.candidate[group.add(&s.counters->candidates, 1)]; };
  const double clock = s.status->clock;
  auto* const awake = reinterpret_cast<std::int32_t*>(group.shared_memory());
  const std::int32_t pairs = s.counters->pairs, stretch = loaded_pairs * group.threads();
  for (std::int32_t first = group.block() * stretch; first < pairs; first += group.blocks() * stretch) {
    if (group.thread() == 0) group.shared().candidates = 0;
    group.block_barrier();
    list_awake(s, group, {first, first + stretch < pairs ? first + stretch : pairs}, static_cast<float>(clock), awake);
    group.block_barrier();
    for (std::int32_t k = group.thread(); k < group.shared().candidates; k += group.threads()) {
      const std::int32_t p = awake[k];
      const double spare = choose_candidate(s, s.pair[p], p, next_candidate);
      if (spare > 0.0) s.wake[p] = wake_clock(clock, spare);
    }
    group.block_barrier();
  }
}

template <class Group>
GEM_DEVICE inline void narrow_phase(const DeviceScene& s, Group& group) {
  const std::int32_t lane_groups = group.threads() / Group::Lanes::size,
                     first = group.block() * lane_groups + group.thread() / Group::Lanes::size;
  const auto next_touching = [&](int points) {
    return TouchingPlace{group.add(&s.counters->touching_count, 1),
                         is_coupled(s) ? group.add(&s.counters->points, points) : 0};
  };
  narrow_phase_of(s, group, s.pair, reinterpret_cast<WorkspaceOutlines*>(group.shared_memory()), s.candidate, first,
                  s.counters->candidates, group.blocks() * lane_groups, next_touching);
}

/// Adds the quality that a block measured to that of the time step.
template <class Group>
GEM_DEVICE inline void add_quality(const DeviceScene& s, Group& group) {
  group.block_barrier();
  if (group.thread() != 0 || !s.wants_samples) return;
  const BlockCell& shared = group.shared();
  BlockQuality& quality = s.quality[s.status->samples];
  if (shared.overlap > 0) group.highest(&quality.overlap, shared.overlap);
  if (shared.share > 0) group.highest(&quality.share, shared.share);
  if (shared.contacts > 0) group.add(&quality.contacts, shared.contacts);
  if (shared.complementarity > 0) group.highest(&quality.complementarity, shared.complementarity);
  if (shared.cone_excess > 0) group.highest(&quality.cone_excess, shared.cone_excess);
}

/// Resolves the events of all touching pairs; coupled: opens their points.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void resolve_touching(const DeviceScene& s, Group& group) {
  BlockCell& shared = group.shared();
  if (group.thread() == 0) shared = {};
  group.block_barrier();
  const std::int32_t step = static_cast<std::int32_t>(s.status->step), touching_count = s.counters->touching_count;
  for (std::int32_t k = rank_of(group); k < touching_count; k += size_of(group)) {
    const TouchingPair& touching = s.touching[k];
    s.touched[k] = touching.pair;
    if constexpr (solver == ContactSolver::coupled)
      open_touching(s, group, s.pair[touching.pair], touching, step);
    else
      resolve(s, group, s.pair[touching.pair], touching, step);
  }
  add_quality(s, group);
}

/// Whether a scene has nothing to do in a stage.
template <Stage stage>
GEM_DEVICE inline bool is_idle(const DeviceScene& s) {
  if (is_of_solver(stage)) return s.counters->points == 0;
  if (stage == Stage::first_solo_events) return s.status->phase_step == PhaseStep::ended;
  if (stage == Stage::last_books || stage == Stage::close_call) return s.status->wanted == 0;
  return !moves(s);
}

/// Assigns the points of a coupled time step to blocks and prepares them for the launch that iterates. That launch has
/// the same number of blocks as this one, each with group.shared_bytes() of shared memory.
template <class Group>
GEM_DEVICE inline void gather_points(const DeviceScene& s, Group& group) {
  StepSolver<Group>(s, group, static_cast<std::int32_t>(s.status->step), group.shared_bytes()).begin_ahead();
  if (s.constants.iteration == Iteration::gradient) SolverRounds<Group>::prepare(s, group);
}

/// Stage `iterate` with operator splitting, by one of several groups of blocks.
template <class Group>
GEM_DEVICE inline void solve_islands(const DeviceScene& s, Group& group, int group_index) {
  if (is_idle<Stage::iterate>(s)) return;
  IslandsOnDevice<Group>(s, group, s.island.cell[group_index]).solve();
}

/// Computes the result of the iterations. This launch has the same number of blocks as the one that iterates, but they
/// do not reach each other's shared memory.
template <class Group>
GEM_DEVICE inline void settle_points(const DeviceScene& s, Group& group) {
  BlockCell& shared = group.shared();
  if (group.thread() == 0) shared = {};
  group.block_barrier();
  StepSolver<Group> solver(s, group, static_cast<std::int32_t>(s.status->step), group.shared_bytes());
  if (s.constants.iteration == Iteration::splitting)
    solver.end_islands();
  else
    solver.end(SolverRounds<Group>::run_rest(s, group));
  add_quality(s, group);
  if (rank_of(group) != 0) return;
  s.status->visits += static_cast<std::int64_t>(s.counters->points) * shared.iterations;
  if (!s.wants_samples) return;
  BlockQuality& quality = s.quality[s.status->samples];
  quality.iterations = shared.iterations;
  quality.residual = shared.residual;
  quality.energy_created = shared.energy_created;
}

/// The workspace of a block that moves copies of its bodies in shared memory. The rest of the memory is for the
/// platform's terms.
template <class Group>
GEM_DEVICE inline Workspace bodies_workspace(const DeviceScene& s, Group& group) {
  Workspace workspace = share_bodies(s, group);
  const std::size_t cells = workspace.bodies.count() * sizeof(BodyCell),
                    motions = workspace.bodies.count() * sizeof(BodyMotion);
  std::byte* const shared_memory = group.shared_memory();
  workspace.body = reinterpret_cast<BodyCell*>(shared_memory) - workspace.bodies.begin;
  workspace.motion = reinterpret_cast<BodyMotion*>(shared_memory + cells) - workspace.bodies.begin;
  workspace.candidate = reinterpret_cast<CandidatePair*>(shared_memory + cells + motions);
  workspace.scratch_bytes = group.shared_bytes() - cells - motions;
  workspace.writes_through = false;
  return workspace;
}

/// How far a body moved against the drift in this time step, plus how far its rim turned [m].
GEM_DEVICE inline double motion_of_rim(const BodyCell& now, const BodyCell& before, Vec2 drift) {
  return length(now.position - before.position - drift) + now.radius * (now.turn_travel - before.turn_travel);
}

/// Notes how far the bodies of the block moved. The scene's cells still hold the positions before.
template <class Group>
GEM_DEVICE inline void note_farthest(const DeviceScene& s, Group& group, const Workspace& workspace) {
  const auto warp = group.warp();
  const Vec2 drift = s.constants.dt * s.status->drift;
  double most = 0.0;
  for (std::int32_t i = workspace.bodies.begin + group.thread(); i < workspace.bodies.end; i += group.threads())
    most = larger(most, motion_of_rim(workspace.body[i], s.body[i], drift));
  for (int step = 1; step < Group::Warp::size; step *= 2) most = larger(most, warp.partner(most, step));
  if (warp.rank() == 0) group.highest(&s.status->farthest, strict::bits_of(most));
  group.block_barrier();
}

/// Writes back the words of the block's bodies that change while they move. The word with `kind` stays out: others read
/// it.
template <class Group>
GEM_DEVICE inline void store_moved(const DeviceScene& s, Group& group, const Workspace& workspace) {
  constexpr int words = 8, kind = 3, cell_end = 6, motion_begin = 2, motion_end = 4;
  static_assert(sizeof(BodyCell) == words * sizeof(CopyWord) && sizeof(BodyMotion) == sizeof(BodyCell));
  static_assert(offsetof(BodyCell, kind) / sizeof(CopyWord) == kind &&
                offsetof(BodyCell, active) / sizeof(CopyWord) == kind &&
                offsetof(BodyCell, velocity) >= (kind + 1) * sizeof(CopyWord) &&
                offsetof(BodyCell, spin) + sizeof(double) <= cell_end * sizeof(CopyWord));
  static_assert(offsetof(BodyMotion, path_correction) >= motion_begin * sizeof(CopyWord) &&
                offsetof(BodyMotion, angle_correction) + sizeof(double) <= motion_end * sizeof(CopyWord));
  const std::int32_t first = workspace.bodies.begin, count = workspace.bodies.count();
  copy_parts<words, 0, kind>(group, s.body + first, workspace.body + first, count);
  copy_parts<words, kind + 1, cell_end>(group, s.body + first, workspace.body + first, count);
  copy_parts<words, motion_begin, motion_end>(group, s.motion + first, workspace.motion + first, count);
}

/// Moves the bodies.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void move_by_blocks(const DeviceScene& s, Group& group) {
  const DeviceStatus& status = *s.status;
  const Workspace workspace = bodies_workspace(s, group);
  load_bodies(s, group, workspace);
  group.block_barrier();
  const std::int64_t done = status.step + 1 - status.list_step;
  const StepIndex step{static_cast<std::int32_t>(status.step), status.samples,
                       static_cast<double>(done) * s.constants.dt, status.samples + 1 < status.wanted};
  move_bodies<solver>(s, group, workspace, step);
  group.block_barrier();
  note_farthest(s, group, workspace);
  store_moved(s, group, workspace);
}

/// Shared memory of a block that moves bodies: copies of the bodies, and terms of a platform with a usual number of
/// contacts [bytes].
constexpr std::size_t bodies_shared_bytes = phase_threads * (sizeof(BodyCell) + sizeof(BodyMotion)) + 8 * 1024;

/// Runs one stage of a scene by one block. Only contact_events and move depend on `solver`.
template <Stage stage, ContactSolver solver, class Group>
GEM_DEVICE inline void run_stage(const DeviceScene& s, Group& group) {
  if (is_idle<stage>(s)) return;
  if constexpr (stage == Stage::first_solo_events) begin_call(s, group);
  if constexpr (stage == Stage::candidates) choose_pairs(s, group);
  if constexpr (stage == Stage::narrow_phase) narrow_phase(s, group);
  if constexpr (stage == Stage::contact_events) resolve_touching<solver>(s, group);
  if constexpr (stage == Stage::gather) gather_points(s, group);
  if constexpr (stage == Stage::iterate) SolverRounds<Group>::run_first(s, group);
  if constexpr (stage == Stage::settle) settle_points(s, group);
  if constexpr (stage == Stage::move) move_by_blocks<solver>(s, group);
  if constexpr (stage == Stage::last_books) close_contacts(s, group, closing_stamp(s), is_coupled(s), true);
  if constexpr (stage == Stage::close_call) {
    close_bodies(s, group);
    write_state(s, group);
  }
}

}  // namespace gem
