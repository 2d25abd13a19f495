// The rounds of iterations of a coupled time step on a device: the same as CoupledRounds on the host. One thread visits
// each point. One thread or three move each floe. One warp moves the platform.
#pragma once

#include <cstring>

#include "gem/engine/solver/device/device_halo_round.h"
#include "gem/engine/solver/device/device_visits.h"
#include "gem/engine/solver/iteration_control.h"

namespace gem {

/// The bits of a number that is not negative. They compare as the number does, so an integer maximum serves.
GEM_DEVICE inline std::uint32_t ordered_bits(float x) {
  std::uint32_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
GEM_DEVICE inline float from_ordered_bits(std::uint32_t bits) {
  float x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

/// The rounds of one time step.
template <class Group>
class SolverRounds {
 public:
  /// All rounds of a time step in one launch, by blocks with halos. Returns whether they met the residual.
  GEM_DEVICE static bool iterate(const DeviceScene& s, Group& group) {
    static_assert(Group::has_halos);
    RoundProgress progress = beginning(s);
    each_point(group, [&](std::int32_t i) { Visits::load(s, group, i, true); });
    const bool done = run_round(s, group, progress, true);
    return finish(s, group, progress, done);
  }

  /// The rounds in three launches: prepare(), run_first(), run_rest(). This is the first: it writes the points to the
  /// scene's memory for the first round.
  GEM_DEVICE static void prepare(const DeviceScene& s, Group& group) {
    const LoadedTable table(s, group.shared_memory(), group.shared().workspace);
    each_point(group, [&](std::int32_t i) {
      LoadedPoint loaded;
      Visits::enter(s, i, true, table[i], loaded);
      table[i].save_numbers(loaded);
    });
  }
  /// The second launch: the first round, usually the only one.
  GEM_DEVICE static void run_first(const DeviceScene& s, Group& group) {
    SolverList<Group>(s, group, 0, group.shared_bytes()).load();
    const LoadedTable table(s, group.shared_memory(), group.shared().workspace);
    each_point(group, [&](std::int32_t i) {
      if (table.is_in_shared(i)) table[i].copy_numbers(table.in_global(i));
      const PointCell& point = s.taken_point[i];
      table[i].set_places(Visits::place_of(s, group, point.a), Visits::place_of(s, group, point.b));
    });
    group.barrier();  // another block must not write to shared memory before its owner has cleared it
    RoundProgress progress = beginning(s);
    const bool done = run_round_by_law(s, group, progress, true);
    each_point(group, [&](std::int32_t i) {
      if (table.is_in_shared(i)) table.in_global(i).copy_additions(table[i]);
    });
    if (rank_of(group) == 0) *s.progress = {progress, done};
  }
  /// The third launch: the end of the first round, and further rounds if any. They are rare (only a tight residual
  /// needs them), so these blocks use no shared memory. Returns whether the residual was met.
  GEM_DEVICE static bool run_rest(const DeviceScene& s, Group& group) {
    static_assert(!Group::reads_other_blocks);
    SolverList<Group>(s, group, 0, group.shared_bytes()).load();
    RoundProgress progress = s.progress->progress;
    return finish(s, group, progress, s.progress->done);
  }

 private:
  using Visits = SolverVisits<Group>;

  GEM_DEVICE static RoundProgress beginning(const DeviceScene& s) {
    const StepConstants& c = s.constants;
    return {IterationControl(c.residual_speed, c.iterations_maximum, c.tight_residual, s.momentum_coefficients), 0.0F,
            0};
  }

  /// Ends a round, then runs further rounds until one was the last. Returns whether that met the residual.
  GEM_DEVICE static bool finish(const DeviceScene& s, Group& group, RoundProgress& progress, bool done) {
    SolverBase<Group> base(s, group);
    for (;;) {
      each_point(group, [&](std::int32_t i) { Visits::add_to_base(s, group, i); });
      group.barrier();
      base.apply_base();
      group.barrier();
      if (done) break;
      each_point(group, [&](std::int32_t i) { Visits::load(s, group, i, false); });
      group.barrier();
      done = run_round(s, group, progress, false);
    }
    if (rank_of(group) == 0) {
      group.shared().iterations = static_cast<std::int32_t>(progress.control.iteration());
      group.shared().residual = static_cast<double>(progress.residual);
    }
    return static_cast<double>(progress.residual) <= s.constants.residual_speed;
  }

  /// For kernels that do more than iterate: not inlined, to keep their code small.
  GEM_DEVICE GEM_NOINLINE static bool run_round(const DeviceScene& s, Group& group, RoundProgress& progress,
                                                bool fresh) {
    return run_round_by_law(s, group, progress, fresh);
  }

  GEM_DEVICE GEM_INLINE static bool run_round_by_law(const DeviceScene& s, Group& group, RoundProgress& progress,
                                                     bool fresh) {
    switch (s.constants.point_friction) {
      case PointFriction::none:
        return run_round_of<PointFriction::none>(s, group, progress, fresh);
      case PointFriction::coulomb:
        return run_round_of<PointFriction::coulomb>(s, group, progress, fresh);
      default:
        return run_round_of<PointFriction::fixed_direction>(s, group, progress, fresh);
    }
  }

  GEM_DEVICE static void reduce_residual(Group& group, std::uint32_t* residual_bits, float most) {
    const auto warp = group.warp();
    const std::uint32_t all = warp.highest(ordered_bits(most));
    if (warp.rank() == 0 && all != 0) group.highest(residual_bits, all);
  }

  GEM_DEVICE GEM_INLINE static void read_residual(const Group& group, std::uint32_t* residual_bits, std::uint32_t most,
                                                  RoundProgress& progress) {
    progress.residual = from_ordered_bits(most);
    // other threads may write to the next place already, so the one after it is cleared
    if (rank_of(group) == 0) residual_bits[(progress.turn + 2) % 3] = 0;
    progress.turn = (progress.turn + 1) % 3;
  }

  /// Runs the iterations of one round. `fresh`: no point has pushed yet. Returns whether the round was the last.
  template <PointFriction law>
  GEM_DEVICE GEM_INLINE static bool run_round_of(const DeviceScene& s, Group& outer, RoundProgress& state, bool fresh) {
    if constexpr (Group::has_halos)
      if (outer.shared().workspace.has_halo) return run_halo_round_of<law>(s, outer, state, fresh);
    Group group = outer;  // a copy in registers
    RoundProgress progress = state;
    const SolverWorkspace& workspace = group.shared().workspace;
    std::uint32_t* const residual_bits = s.counters->residual_bits;
    typename Visits::KeptPoints own;
    Visits::load(s, group, workspace, own);
    auto next = IterationControl::Next::iteration;
    for (; next == IterationControl::Next::iteration; fresh = false) {
      const float momentum_coefficient = progress.control.momentum_coefficient();
      if (!fresh) {
        SolverMoves<Group>::move(s, group, workspace);
        group.barrier();
      }
      if (progress.control.judged()) {
        reduce_residual(
            group, residual_bits + progress.turn,
            Visits::template visit_all<law, true>(s, group, workspace, own, momentum_coefficient, Visits::plain));
      } else {
        Visits::template visit_all<law, false>(s, group, workspace, own, momentum_coefficient, Visits::plain);
      }
      group.barrier();
      if (progress.control.judged()) read_residual(group, residual_bits, residual_bits[progress.turn], progress);
      next = progress.control.after(progress.residual);
    }
    Visits::save(s, group, workspace, own);
    state = progress;
    return next == IterationControl::Next::end;
  }

  /// run_round_of() by blocks with halos. The blocks meet at the start, at the end and where all need the residual.
  /// Otherwise a block waits only for the records that it needs.
  /// No record is overwritten too early. Records of two successive iterations have separate places. A block writes the
  /// records of iteration n + 2 only after it has read those of n + 1. Their writers had by then read all records of n
  /// that they need.
  template <PointFriction law>
  GEM_DEVICE GEM_INLINE static bool run_halo_round_of(const DeviceScene& s, Group& outer, RoundProgress& state,
                                                      bool fresh) {
    Group group = outer;  // a copy in registers
    RoundProgress progress = state;
    const SolverWorkspace& workspace = group.shared().workspace;
    const HaloRecords<Group> records(s, group, workspace);
    const HaloMoves<Group> moves(s, group, workspace);
    std::uint32_t* const residual_bits = s.counters->residual_bits;
    typename Visits::KeptPoints own;
    Visits::load(s, group, workspace, own);
    std::uint32_t number = Visits::first_number;
    if (!fresh) {
      records.fetch(number);
      group.block_barrier();
      moves.move();
      group.block_barrier();
    }
    auto next = IterationControl::Next::iteration;
    for (; next == IterationControl::Next::iteration; fresh = false) {
      const float momentum_coefficient = progress.control.momentum_coefficient();
      // the first iteration of all is judged too: all blocks have to meet in it
      const bool judged = progress.control.judged();
      ++number;
      if (judged) {
        reduce_residual(group, &group.shared().block_residual,
                        Visits::template visit_all<law, true>(s, group, workspace, own, momentum_coefficient, number));
        group.arrive_with_residual(residual_bits + progress.turn);
        if (fresh)
          // until all blocks have cleared the numbers of their records
          group.wait_for_residual(residual_bits + progress.turn);
      } else {
        Visits::template visit_all<law, false>(s, group, workspace, own, momentum_coefficient, number);
      }
      // arrive_with_residual() has this barrier too. Threads without points would otherwise poll memory and slow down
      // the writers.
      if (!judged) group.block_barrier();
      records.fetch(number);
      group.block_barrier();
      moves.move();  // done before the residual is known; after the last iteration the motions are not used
      if (judged && !fresh)
        group.wait_for_residual(residual_bits + progress.turn);
      else
        group.block_barrier();
      if (judged) read_residual(group, residual_bits, group.shared().grid_residual, progress);
      next = progress.control.after(progress.residual);
    }
    group.barrier();  // all blocks have read the records of this round
    Visits::save(s, group, workspace, own);
    state = progress;
    return next == IterationControl::Next::end;
  }
};

}  // namespace gem
