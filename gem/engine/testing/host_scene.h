// For tests: a device scene in host memory, run by thread groups of host threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

#include "gem/engine/device/phases.h"
#include "gem/engine/device/scene_image.h"
#include "gem/engine/device/scene_layout.h"
#include "gem/engine/step/books.h"
#include "gem/engine/testing/host_group.h"
#include "gem/engine/testing/one_thread_group.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/scene/scene_drive.h"

namespace gem::test {

/// A device scene in host memory.
class HostScene {
 public:
  HostScene(const SceneDef& scene, const Bodies& bodies, int blocks = 1, int threads = 1, std::int32_t rows = 0,
            std::size_t shared_memory = 1 << 20)
      : mooring_(mooring_tables(scene.mooring.law, scene.mooring_design)),
        dp_(dp_law_of(scene, bodies)),
        field_(make_field_state(bodies, step_constants(scene, bodies, mooring_.view(), &dp_))),
        sizes_(scene_sizes(field_)),
        scene_(scene_constants(field_)),
        drives_(drive_schedule(scene)),
        threads_(threads),
        shared_memory_(shared_memory) {
    allow_for(scene, sizes_);
    sizes_.blocks = blocks;
    running_.start = total(field_);
    if (rows > 0) sizes_.rows = rows;
    sizes_.samples = 32;
    sizes_.drives = drives_.varies();
    scene_.wants_events = scene_.wants_samples = 1;
    memory_[0].resize(place_field(scene_, sizes_, nullptr));
    place_field(scene_, sizes_, memory_[0].data());
    grow();
    write_field(field_, 0, scene_);
  }

  /// Records events only.
  void without_samples() { scene_.wants_samples = 0; }
  /// Sets the number of time steps done since t = 0. Only before the first call.
  void begin_at(std::int64_t step) { write_field(field_, step, scene_); }

  /// Runs each phase separately from now on. `solver_shared_memory`: shared memory of the phases that iterate [bytes].
  void use_phases(std::size_t solver_shared_memory = 1 << 20) {
    phases_ = true;
    solver_shared_memory_ = solver_shared_memory;
  }
  void use_resident() { phases_ = false; }
  /// Sets from which size on islands are solved by a block and by all blocks (IslandMemory).
  void divide_islands(std::int32_t small, std::int32_t large) {
    scene_.island.small_island = small;
    scene_.island.large_island = large;
  }
  /// Sets the shared memory of each block from the next call on [bytes].
  void give_space(std::size_t bytes) { shared_memory_ = bytes; }

  void advance(std::int64_t steps, StepLog& log) {
    if (has_contact_forces()) scene_.wants_forces = log.wants_forces ? ForcesWanted::all : ForcesWanted::last;
    while (steps > 0) {
      const std::int32_t some = static_cast<std::int32_t>(std::min<std::int64_t>(steps, sizes_.samples));
      if (scene_.drive) write_drives(drives_, scene_.status->step, some, const_cast<Drive*>(scene_.drive));
      if (phases_)
        run_phases(some);
      else
        run_steps(some);
      const DeviceStatus& status = *scene_.status;
      append_log(field_, scene_, status, phases_ ? 1 : sizes_.blocks, log);
      take_forces(log);
      steps -= status.samples;
      if (status.stop == DeviceStop::list_full) {
        sizes_.rows = std::max(sizes_.rows, status.rows_needed);
        sizes_.platform_rows = std::max(sizes_.platform_rows, status.platform_needed);
        const std::vector<CarriedMemory> carried = memory();
        grow();
        std::copy(carried.begin(), carried.end(), scene_.carried);
        ++growths_;
      }
      if (status.stop == DeviceStop::not_finite || status.stop == DeviceStop::solver_full) break;
    }
    read_state(scene_.state, field_);
  }

  /// A call without a time step, as for a finished scene of a batch that still runs.
  void wait() {
    OneThreadGroup group;
    advance_scene(scene_, group, 0);
  }

  Ledger ledger(const Ledger& start) {
    Ledger running;
    running.start = start.start;
    field_.books.assign(scene_.books, scene_.books + field_.books.size());
    field_.mooring_force = scene_.platform->mooring_force;
    field_.broken = scene_.platform->broken;
    if (scene_.dp) field_.dp = *scene_.dp;
    return closed_books(field_, running);
  }

  /// Goes on from a saved state. Like the cuda engine's.
  void restore(const EngineState& state) {
    field_ = make_field_state(state.bodies, field_.constants);
    open_books(field_, state);
    running_ = state.ledger;
    last_forces_.clear();
    const std::vector<CarriedMemory> carried = carried_memory(state);
    sizes_.rows = std::max(sizes_.rows, static_cast<std::int32_t>(2 * carried.size()));
    grow();
    write_field(field_, state.step, scene_);
    scene_.status->carried = static_cast<std::int32_t>(carried.size());
    std::copy(carried.begin(), carried.end(), scene_.carried);
  }

  /// The state after restore() and some time steps. Like the cuda engine's.
  EngineState save() {
    field_.books.assign(scene_.books, scene_.books + field_.books.size());
    field_.mooring_force = scene_.platform->mooring_force;
    field_.broken = scene_.platform->broken;
    if (scene_.dp) field_.dp = *scene_.dp;
    EngineState state{scene_.status->step, field_.bodies, saved_books(field_, running_), field_.books, {}, {},
                      field_.broken,       field_.dp};
    save_memory(memory(), state);
    return state;
  }

  std::vector<CarriedMemory> memory() const { return {scene_.carried, scene_.carried + scene_.status->carried}; }

  double asked_residual() const { return field_.constants.asked_residual(); }
  bool has_contact_forces() const { return sizes_.forces != ForcesWanted::none; }
  const std::vector<ContactForce>& contact_forces() const { return last_forces_; }
  /// Makes the ring of forces as small as it may be, so that calls end early.
  void shorten_forces() {
    short_forces_ = true;
    scene_.forces_capacity = 2 * contacts_capacity(scene_.rows_capacity);
  }
  /// Calls that ended early.
  int short_calls() const { return short_calls_; }

  const Bodies& bodies() const { return field_.bodies; }
  const DeviceStatus& status() const { return *scene_.status; }
  int growths() const { return growths_; }
  /// Number of pairs that sleep now, if the scene was run on the phases route.
  std::int32_t asleep() const {
    std::int32_t count = 0;
    for (std::int32_t p = 0; p < scene_.counters->pairs; ++p)
      count += scene_.wake[p] > static_cast<float>(scene_.status->clock) ? 1 : 0;
    return count;
  }
  /// The solver workspace of a block in the last time step, if the scene is coupled and was run on the phases route.
  const SolverWorkspace& solver_workspace(int block) const { return scene_.solver_workspace[block]; }
  std::int32_t longest_lower_row() const {
    std::int32_t longest = 0;
    for (std::int32_t i = 0; i < scene_.bodies; ++i) longest = std::max(longest, scene_.motion[i].lower_count);
    return longest;
  }

 private:
  void take_forces(StepLog& log) {
    const DeviceStatus& status = *scene_.status;
    short_calls_ += status.stop == DeviceStop::ring_full ? 1 : 0;
    if (!has_contact_forces() || status.samples == 0) return;
    const std::vector<StepForce> forces = forces_of_call(scene_, status);
    last_forces_ = forces_of_last_step(forces, status.step);
    if (log.wants_forces) log.forces.insert(log.forces.end(), forces.begin(), forces.end());
  }

  void run_steps(std::int32_t steps) {
    if (sizes_.blocks == 1 && threads_ == 1) {
      OneThreadGroup group;
      advance_scene(scene_, group, steps);
      return;
    }
    run_team<HostGroup>(sizes_.blocks, threads_, shared_memory_,
                        [&](auto& group) { advance_scene(scene_, group, steps); });
  }

  void run_phases(std::int32_t steps) {
    alarms_ = 0;
    const auto run = [&](Stage stage) {
      if (stage == Stage::open_call)
        open_call(scene_, steps);
      else if (stage == Stage::plan)
        lists_ = plan_step(scene_, alarms_);
      else if (stage == Stage::list)
        renew_list_if_worn();
      else if (stage == Stage::move)
        move_and_plan();
      else if (stage == Stage::iterate && is_splitting(scene_))
        run_islands();
      else if (is_coupled(scene_) || !is_of_solver(stage))
        run_stage_now(stage);
    };
    for (const Stage stage : call_begins) run(stage);
    for (std::int32_t k = 0; k < steps; ++k)
      for (const Stage stage : time_step_stages) run(stage);
    for (const Stage stage : call_ends) run(stage);
  }

  void run_islands() {
    run_team<PhaseTeam>(sizes_.blocks, threads_, islands_shared_bytes(threads_, team_warp), [&](PhaseTeam& group) {
      group.raise_in(alarms_);
      solve_islands(scene_, group, 0);
    });
  }

  void move_and_plan() {
    lists_ = false;
    if (!moves(scene_)) return;
    run_stage_now(Stage::move);
    lists_ = plan_step(scene_, alarms_);
  }

  void renew_list_if_worn() {
    if (lists_)
      run_team<HostGroup>(sizes_.blocks, threads_, shared_memory_, [&](auto& group) { renew_list(scene_, group); });
  }

  void run_stage_now(Stage stage) {
    run_if<Stage::first_solo_events>(stage);
    run_if<Stage::candidates>(stage);
    run_if<Stage::narrow_phase>(stage);
    run_by_solver<Stage::contact_events>(stage);
    run_if<Stage::gather>(stage);
    run_if<Stage::iterate>(stage);
    run_if<Stage::settle>(stage);
    run_by_solver<Stage::move>(stage);
    run_if<Stage::last_books>(stage);
    run_if<Stage::close_call>(stage);
  }
  template <Stage stage>
  void run_by_solver(Stage now) {
    if (is_coupled(scene_))
      run_if<stage, ContactSolver::coupled>(now);
    else
      run_if<stage>(now);
  }

  /// Runs the phase `stage` if `now` is that phase, with a new team. Alarms are kept.
  template <Stage stage, ContactSolver solver = ContactSolver::independent>
  void run_if(Stage now) {
    using Team = std::conditional_t<stage == Stage::settle, SettleTeam, PhaseTeam>;
    if (now == stage)
      run_team<Team>(sizes_.blocks, threads_, is_of_solver(stage) ? solver_shared_memory_ : shared_memory_,
                     [&](Team& group) {
                       group.raise_in(alarms_);
                       run_stage<stage, solver>(scene_, group);
                     });
  }

  void grow() {
    memory_[1].resize(place_list(scene_, sizes_, nullptr));
    std::memset(memory_[1].data(), 0xff, memory_[1].size());
    place_list(scene_, sizes_, memory_[1].data());
    *scene_.counters = {};
    memory_[2].resize(place_rings(scene_, sizes_, nullptr));
    place_rings(scene_, sizes_, memory_[2].data());
    if (short_forces_) scene_.forces_capacity = 2 * contacts_capacity(scene_.rows_capacity);
  }

  MooringTables mooring_;
  DpLaw dp_;
  FieldState field_;
  Ledger running_;  // of the restored state
  SceneSizes sizes_;
  DeviceScene scene_;
  DriveSchedule drives_;
  int threads_;
  std::size_t shared_memory_, solver_shared_memory_ = 0;
  bool phases_ = false, short_forces_ = false;
  bool lists_ = false;        // phases route: the next time step needs a new list
  std::uint32_t alarms_ = 0;  // phases route
  std::vector<std::byte> memory_[3];
  std::vector<ContactForce> last_forces_;  // of the last time step
  int growths_ = 0, short_calls_ = 0;
};

/// Checks of coupled time steps beyond those of all: the warm start and the quality of the contacts.
inline void expect_same_coupled(const HostScene& device, const StepLog& log, Engine& cpu, const StepLog& expected) {
  EngineState state;
  save_memory(device.memory(), state);
  expect_same_memory(state, cpu.save());
  expect_same_judgement(log, expected);
  EXPECT_GT(state.impulse_key.size(), 20u);
}

}  // namespace gem::test
