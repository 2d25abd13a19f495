// Rounds of iterations on a device: as CoupledRounds, each point by the thread that holds it, each floe
// by one or three, the platform by a warp.
#pragma once

#include <cstring>

#include "gem/engine/solver/device_halo_round.h"
#include "gem/engine/solver/device_visits.h"
#include "gem/engine/solver/iteration_course.h"

namespace gem {

/// Bits of a number that is not negative: they have its order.
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

/// The rounds of one moment.
template <class Crew>
class SolverRounds {
 public:
  /// All rounds of a moment, by blocks with halos.
  GEM_DEVICE static void iterate(const DeviceScene& s, Crew& crew) {
    static_assert(Crew::has_halos);
    Progress progress = beginning(s);
    each_point(crew, [&](std::int32_t i) { Visits::hold(s, crew, i, true); });
    const bool done = run_round(s, crew, progress, true);
    finish(s, crew, progress, done);
  }

  /// The same in three launches. Before the first round: points at rest.
  GEM_DEVICE static void prepare(const DeviceScene& s, Crew& crew) {
    const HeldTable table(s, crew.room(), crew.shared().desk);
    each_point(crew, [&](std::int32_t i) {
      HeldPoint held;
      Visits::enter(s, i, true, table[i], held);
      table[i].save_numbers(held);
    });
  }
  /// The first round, mostly the only one.
  GEM_DEVICE static void run_first(const DeviceScene& s, Crew& crew) {
    SolverList<Crew>(s, crew, 0, crew.room_bytes()).take_up();
    const HeldTable table(s, crew.room(), crew.shared().desk);
    each_point(crew, [&](std::int32_t i) {
      if (table.is_fast(i)) table[i].copy_numbers(table.at_rest(i));
      const PointCell& point = s.taken_point[i];
      table[i].set_places(Visits::place_of(s, crew, point.a), Visits::place_of(s, crew, point.b));
    });
    crew.barrier();  // no block's fast memory is made ready after another has written to it
    Progress progress = beginning(s);
    const bool done = run_round_by_law(s, crew, progress, true);
    each_point(crew, [&](std::int32_t i) {
      if (table.is_fast(i)) table.at_rest(i).copy_additions(table[i]);
    });
    if (rank_of(crew) == 0) *s.progress = {progress, done};
  }
  /// What is left, by blocks that need no fast memory: another round is rare, the residual has to be asked for that.
  GEM_DEVICE static void run_rest(const DeviceScene& s, Crew& crew) {
    static_assert(!Crew::shares_rooms);
    SolverList<Crew>(s, crew, 0, crew.room_bytes()).take_up();
    Progress progress = s.progress->progress;
    finish(s, crew, progress, s.progress->done);
  }

 private:
  using Visits = SolverVisits<Crew>;

  GEM_DEVICE static Progress beginning(const DeviceScene& s) {
    const MomentConstants& c = s.constants;
    return {IterationCourse(c.residual_speed, c.iterations_maximum, c.tight_residual, s.carried_ahead), 0.0F, 0};
  }

  /// The end of a round, and the rounds that follow where it was not the last.
  GEM_DEVICE static void finish(const DeviceScene& s, Crew& crew, Progress& progress, bool done) {
    SolverBase<Crew> base(s, crew);
    for (;;) {
      each_point(crew, [&](std::int32_t i) { Visits::let_go(s, crew, i); });
      crew.barrier();
      base.settle();
      crew.barrier();
      if (done) break;
      each_point(crew, [&](std::int32_t i) { Visits::hold(s, crew, i, false); });
      crew.barrier();
      done = run_round(s, crew, progress, false);
    }
    if (rank_of(crew) == 0) {
      crew.shared().iterations = static_cast<std::int32_t>(progress.course.iteration());
      crew.shared().residual = static_cast<double>(progress.residual);
    }
  }

  /// For kernels that do more than iterate: a function of its own, which keeps their code small.
  GEM_DEVICE GEM_NOINLINE static bool run_round(const DeviceScene& s, Crew& crew, Progress& progress, bool fresh) {
    return run_round_by_law(s, crew, progress, fresh);
  }

  GEM_DEVICE GEM_INLINE static bool run_round_by_law(const DeviceScene& s, Crew& crew, Progress& progress, bool fresh) {
    switch (s.constants.point_friction) {
      case PointFriction::none:
        return run_round_of<PointFriction::none>(s, crew, progress, fresh);
      case PointFriction::coulomb:
        return run_round_of<PointFriction::coulomb>(s, crew, progress, fresh);
      default:
        return run_round_of<PointFriction::fixed_direction>(s, crew, progress, fresh);
    }
  }

  GEM_DEVICE static void note_asked(Crew& crew, std::uint32_t* asked, float most) {
    const auto warp = crew.warp();
    const std::uint32_t all = warp.highest(ordered_bits(most));
    if (warp.rank() == 0 && all != 0) crew.highest(asked, all);
  }

  GEM_DEVICE GEM_INLINE static void take_asked(const Crew& crew, std::uint32_t* asked, std::uint32_t most,
                                               Progress& progress) {
    progress.residual = from_ordered_bits(most);
    // the place after the next: others may write to the next one already
    if (rank_of(crew) == 0) asked[(progress.turn + 2) % 3] = 0;
    progress.turn = (progress.turn + 1) % 3;
  }

  /// Makes the iterations of one round, which no point has begun where `fresh`; returns whether it was the last.
  template <PointFriction law>
  GEM_DEVICE GEM_INLINE static bool run_round_of(const DeviceScene& s, Crew& outer, Progress& state, bool fresh) {
    if constexpr (Crew::has_halos)
      if (outer.shared().desk.has_halo) return run_halo_round_of<law>(s, outer, state, fresh);
    Crew crew = outer;  // for each thread in its registers
    Progress progress = state;
    const SolverDesk& desk = crew.shared().desk;
    std::uint32_t* const asked = s.counters->asked;
    typename Visits::KeptPoints own;
    Visits::load(s, crew, desk, own);
    auto next = IterationCourse::Next::iteration;
    for (; next == IterationCourse::Next::iteration; fresh = false) {
      const float ahead = progress.course.ahead();
      if (!fresh) {
        SolverMoves<Crew>::move(s, crew, desk);
        crew.barrier();
      }
      if (progress.course.judged()) {
        note_asked(crew, asked + progress.turn,
                   Visits::template visit_all<law, true>(s, crew, desk, own, ahead, Visits::plain));
      } else {
        Visits::template visit_all<law, false>(s, crew, desk, own, ahead, Visits::plain);
      }
      crew.barrier();
      if (progress.course.judged()) take_asked(crew, asked, asked[progress.turn], progress);
      next = progress.course.after(progress.residual);
    }
    Visits::save(s, crew, desk, own);
    state = progress;
    return next == IterationCourse::Next::end;
  }

  /// The same by blocks with halos. They meet at the beginning, at the end and where all have to know what the points
  /// ask for; else each waits only for the records that it needs. Meanwhile none of these is written over: who writes
  /// the next but one has read the next of all that read this one.
  template <PointFriction law>
  GEM_DEVICE GEM_INLINE static bool run_halo_round_of(const DeviceScene& s, Crew& outer, Progress& state, bool fresh) {
    Crew crew = outer;  // for each thread in its registers
    Progress progress = state;
    const SolverDesk& desk = crew.shared().desk;
    const HaloRecords<Crew> records(s, crew, desk);
    const HaloMoves<Crew> moves(s, crew, desk);
    std::uint32_t* const asked = s.counters->asked;
    typename Visits::KeptPoints own;
    Visits::load(s, crew, desk, own);
    std::uint32_t number = Visits::first_number;
    if (!fresh) {
      records.bring(number);
      crew.block_barrier();
      moves.move();
      crew.block_barrier();
    }
    auto next = IterationCourse::Next::iteration;
    for (; next == IterationCourse::Next::iteration; fresh = false) {
      const float ahead = progress.course.ahead();
      // so is the first of all, in which all blocks have to meet
      const bool judged = progress.course.judged();
      ++number;
      if (judged) {
        note_asked(crew, &crew.shared().asked,
                   Visits::template visit_all<law, true>(s, crew, desk, own, ahead, number));
        crew.arrive_asking(asked + progress.turn);
        if (fresh) crew.wait_for_asked(asked + progress.turn);  // until all blocks have cleared the numbers
      } else {
        Visits::template visit_all<law, false>(s, crew, desk, own, ahead, number);
      }
      // as in arriving: looks of threads without points would be in the way of what the others write
      if (!judged) crew.block_barrier();
      records.bring(number);
      crew.block_barrier();
      moves.move();  // whatever all ask for: after the last iteration nobody looks at it
      if (judged && !fresh)
        crew.wait_for_asked(asked + progress.turn);
      else
        crew.block_barrier();
      if (judged) take_asked(crew, asked, crew.shared().asked_by_all, progress);
      next = progress.course.after(progress.residual);
    }
    crew.barrier();  // no block reads records of this round any more
    Visits::save(s, crew, desk, own);
    state = progress;
    return next == IterationCourse::Next::end;
  }
};

}  // namespace gem
