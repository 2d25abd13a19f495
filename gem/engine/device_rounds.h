// Rounds of iterations on a device: as CoupledRounds, each point by the thread that holds it, each floe
// by one or three, the platform by a warp.
#pragma once

#include <cstring>

#include "gem/engine/device_halo_round.h"
#include "gem/engine/device_held.h"
#include "gem/engine/device_settle.h"
#include "gem/engine/iteration_course.h"

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
  /// All rounds of a moment.
  GEM_DEVICE static void iterate(const DeviceScene& s, Crew& crew) {
    Progress progress = beginning(s);
    each_point(crew, [&](std::int32_t i) { hold(s, crew, i, true); });
    crew.lap(stage_frames);
    const bool done = run_round(s, crew, progress, true);
    crew.lap(stage_iterations);
    finish(s, crew, progress, done);
  }

  /// The same in three launches. Before the first round: points at rest.
  GEM_DEVICE static void prepare(const DeviceScene& s, Crew& crew) {
    const HeldTable table(s, crew.room(), crew.shared().desk);
    each_point(crew, [&](std::int32_t i) {
      HeldPoint held;
      enter(s, i, true, table[i], held);
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
      table[i].set_places(place_of(s, crew, point.a), place_of(s, crew, point.b));
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
  GEM_DEVICE static Progress beginning(const DeviceScene& s) {
    const MomentConstants& c = s.constants;
    return {IterationCourse(c.residual_speed, c.iterations_maximum, c.tight_residual, s.carried_ahead), 0.0F, 0};
  }

  /// The end of a round, and the rounds that follow where it was not the last.
  GEM_DEVICE static void finish(const DeviceScene& s, Crew& crew, Progress& progress, bool done) {
    SolverBase<Crew> base(s, crew);
    for (;;) {
      each_point(crew, [&](std::int32_t i) { let_go(s, crew, i); });
      crew.barrier();
      base.settle();
      crew.barrier();
      if (done) break;
      each_point(crew, [&](std::int32_t i) { hold(s, crew, i, false); });
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

  GEM_DEVICE static PushRecord* record_at(const DeviceScene& s, Crew& crew, std::int32_t place, std::int32_t room) {
    if (Crew::shares_rooms && room >= 0)
      return reinterpret_cast<PushRecord*>(crew.room_of(room >> 16)) + (room & 0xffff);
    if (place < 0) return nullptr;
    if (Crew::has_halos && crew.shared().desk.has_halo) return reinterpret_cast<PushRecord*>(s.push_base + place);
    return s.push + place;
  }
  GEM_DEVICE static const AddedMotion* motion_at(const DeviceScene& s, Crew& crew, const PointSide& side) {
    if (Crew::shares_rooms && side.motion >= 0)
      return reinterpret_cast<const AddedMotion*>(crew.room_of(side.motion >> 16)) + (side.motion & 0xffff);
    if (Crew::has_halos && crew.shared().desk.has_halo && side.place >= 0)
      return crew.shared().desk.motion + side.motion;
    return s.added + side.body;
  }
  GEM_DEVICE static HeldPlace place_of(const DeviceScene& s, Crew& crew, const PointSide& side) {
    return {motion_at(s, crew, side), record_at(s, crew, side.place, side.room)};
  }

  GEM_DEVICE static Motion<double> solved_motion(const DeviceScene& s, std::int32_t body) {
    const SolvedMotion& m = s.solved[body];
    return {m.part[0], m.part[1], m.part[4], m.part[2], m.part[3], m.part[5]};
  }

  /// The numbers of a point at the start of a round; `carried` is what the last one left, less what is in the base now.
  GEM_DEVICE GEM_INLINE static void enter(const DeviceScene& s, std::int32_t i, bool fresh, const HeldCell& cell,
                                          HeldPoint& held) {
    if (fresh)
      held.carried = {0.0F, 0.0F, 0.0F};
    else
      cell.load_additions(held);
    const PointCell& point = s.taken_point[i];
    const PointGeometry<double> geometry = s.points.geometry(i);
    enter_geometry(held.frame, geometry);
    enter_base(held.frame, geometry, s.points.impulse(i), solved_motion(s, point.a.body),
               solved_motion(s, point.b.body));
    held.at = {0.0F, 0.0F, 0.0F};
  }

  /// A point at the start of a round.
  GEM_DEVICE GEM_INLINE static void hold(const DeviceScene& s, Crew& crew, std::int32_t i, bool fresh) {
    const HeldCell cell = HeldTable(s, crew.room(), crew.shared().desk)[i];
    HeldPoint held;
    enter(s, i, fresh, cell, held);
    const PointCell& point = s.taken_point[i];
    held.a = place_of(s, crew, point.a);
    held.b = place_of(s, crew, point.b);
    cell.save_numbers(held);
    cell.set_places(held.a, held.b);
    if constexpr (Crew::has_halos)
      if (crew.shared().desk.has_halo) {
        clear_numbers(held.a.record);
        clear_numbers(held.b.record);
        if (!fresh) push(held, first_number);
        return;
      }
    if (!fresh) push(held, plain);
  }

  /// The additions of a round enter the base.
  GEM_DEVICE GEM_INLINE static void let_go(const DeviceScene& s, Crew& crew, std::int32_t i) {
    const HeldCell cell = HeldTable(s, crew.room(), crew.shared().desk)[i];
    HeldPoint held = cell.load();
    const PointGeometry<double> g = s.points.geometry(i);
    write_base(s, i, s.taken_point[i], g,
               with_additions(s.constants.point_friction, g, s.points.impulse(i), held.at, held.frame.least,
                              held.frame.most, held.frame.repair_least));
    held.carried.normal -= held.at.normal;
    held.carried.tangential -= held.at.tangential;
    held.carried.repair -= held.at.repair;
    cell.save_additions(held);
  }

  GEM_DEVICE GEM_INLINE static void write(PushRecord* record, const PointPush<float>& p, float twist, float turn,
                                          std::uint32_t number) {
    if (!record) return;  // a fixed body
    if constexpr (Crew::has_halos)
      if (number != plain) {
        NumberedPush* const to = reinterpret_cast<NumberedPush*>(record) + number % 2;
        Crew::write_whole(&to->half[0], {{p.x, p.y, p.shift_x}, number});
        Crew::write_whole(&to->half[1], {{p.shift_y, twist, turn}, number});
        return;
      }
    record->pair[0] = {{p.x, p.y}};
    record->pair[1] = {{p.shift_x, p.shift_y}};
    record->pair[2] = {{twist, turn}};
  }
  /// `number`: of the iteration, where there are halos; or plain.
  GEM_DEVICE GEM_INLINE static void push(const HeldPoint& held, std::uint32_t number) {
    const PointPush<float> p = push_of(held.frame, held.carried);
    write(held.a.record, p, p.twist_a, p.turn_a, number);
    write(held.b.record, p, p.twist_b, p.turn_b, number);
  }
  static constexpr std::uint32_t plain = 0, first_number = 1;

  /// The base's records stood where those of the round will: no part of them must be taken for a number, once all
  /// blocks have met and wait for records.
  GEM_DEVICE static void clear_numbers(PushRecord* record) {
    if (record)
      for (int k = 0; k < 4; ++k) Crew::write_whole(&reinterpret_cast<NumberedHalf*>(record)[k], {});
  }

  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_INLINE static float visit(MomentPace<float> pace, HeldPoint& held, float ahead, std::uint32_t number) {
    const AddedMotion a = *held.a.motion, b = *held.b.motion;
    const FloatPair &turn_a = a.pair[2], &turn_b = b.pair[2];
    const Approach<float> w{b.pair[0].part[0] - a.pair[0].part[0],
                            b.pair[0].part[1] - a.pair[0].part[1],
                            b.pair[1].part[0] - a.pair[1].part[0],
                            b.pair[1].part[1] - a.pair[1].part[1],
                            turn_a.part[0],
                            turn_a.part[1],
                            turn_b.part[0],
                            turn_b.part[1]};
    const PointImpulse<float> step = visit_point<law>(held.frame, w, pace, ahead, held.at, held.carried);
    push(held, number);  // first of all: others wait for it
    return judged ? speed_asked<law>(held.frame, step, pace) : 0.0F;
  }

  /// Points of a thread that stay in its registers while a round runs.
  static constexpr int kept = Crew::kept_points;
  struct KeptPoints {
    HeldPoint point[kept > 0 ? kept : 1];
    std::int32_t count = 0;
    bool more = false;  // the block has points that no thread keeps
  };

  /// Visits the points of this thread; returns, where `judged`, the largest speed that one asked for.
  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_INLINE static float visit_all(const DeviceScene& s, Crew& crew, const SolverDesk& desk,
                                               KeptPoints& own, float ahead, std::uint32_t number) {
    float most = 0.0F;
    const MomentPace<float> pace = desk.pace;
    const auto visit_held = [&](HeldPoint& held) {
      most = larger(visit<law, judged>(pace, held, ahead, number), most);
    };
    for (int k = 0; k < kept; ++k)
      if (k < own.count) visit_held(own.point[k]);
    if (!own.more) return most;
    const auto visit_cell = [&](const HeldCell& cell) {
      HeldPoint held = cell.load();
      visit_held(held);
      cell.save_additions(held);
    };
    // each kind of memory by itself: the compiler has faster instructions where it knows which it is
    const HeldTable table(s, crew.room(), desk);
    const std::int32_t size = crew.threads(), end = desk.points.end;
    std::int32_t i = desk.points.begin + crew.thread() + kept * size;
    if constexpr (Crew::shares_rooms)
      for (; i < desk.fast.end; i += size) visit_cell(table.fast(i));
    for (; i < end; i += size) visit_cell(table.at_rest(i));
    return most;
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

  GEM_DEVICE GEM_INLINE static void load(const DeviceScene& s, Crew& crew, const SolverDesk& desk, KeptPoints& own) {
    const std::int32_t size = crew.threads(), first = desk.points.begin + crew.thread(), end = desk.points.end;
    own.more = desk.points.count() > kept * size;
    for (int k = 0; k < kept; ++k)
      if (first + k * size < end) {
        own.point[k] = HeldTable(s, crew.room(), desk)[first + k * size].load();
        own.count = k + 1;
      }
  }
  GEM_DEVICE GEM_INLINE static void save(const DeviceScene& s, Crew& crew, const SolverDesk& desk,
                                         const KeptPoints& own) {
    const std::int32_t size = crew.threads(), first = desk.points.begin + crew.thread(), end = desk.points.end;
    for (int k = 0; k < kept; ++k)
      if (first + k * size < end) HeldTable(s, crew.room(), desk)[first + k * size].save_additions(own.point[k]);
  }

  /// Makes the iterations of one round, which no point has begun where `fresh`; returns whether it was the last.
  template <PointFriction law>
  GEM_DEVICE GEM_INLINE static bool run_round_of(const DeviceScene& s, Crew& outer, Progress& state, bool fresh) {
    if constexpr (Crew::has_halos)
      if (outer.shared().desk.has_halo) return run_halo_round_of<law>(s, outer, state, fresh);
    decltype(auto) crew = outer.at_hand();
    Progress progress = state;
    const SolverDesk& desk = crew.shared().desk;
    std::uint32_t* const asked = s.counters->asked;
    KeptPoints own;
    load(s, crew, desk, own);
    auto next = IterationCourse::Next::iteration;
    for (; next == IterationCourse::Next::iteration; fresh = false) {
      const float ahead = progress.course.ahead();
      if (!fresh) {
        SolverMoves<Crew>::move(s, crew, desk);
        crew.barrier();
      }
      if (progress.course.judged()) {
        note_asked(crew, asked + progress.turn, visit_all<law, true>(s, crew, desk, own, ahead, plain));
      } else {
        visit_all<law, false>(s, crew, desk, own, ahead, plain);
      }
      crew.barrier();
      if (progress.course.judged()) take_asked(crew, asked, asked[progress.turn], progress);
      next = progress.course.after(progress.residual);
    }
    save(s, crew, desk, own);
    outer.came_back(crew);
    state = progress;
    return next == IterationCourse::Next::end;
  }

  /// The same by blocks with halos. They meet at the beginning, at the end and where all have to know what the points
  /// ask for; else each waits only for the records that it needs. Meanwhile none of these is written over: who writes
  /// the next but one has read the next of all that read this one.
  template <PointFriction law>
  GEM_DEVICE GEM_INLINE static bool run_halo_round_of(const DeviceScene& s, Crew& outer, Progress& state, bool fresh) {
    decltype(auto) crew = outer.at_hand();
    Progress progress = state;
    const SolverDesk& desk = crew.shared().desk;
    const HaloRecords<Crew> records(s, crew, desk);
    const HaloMoves<Crew> moves(s, crew, desk);
    std::uint32_t* const asked = s.counters->asked;
    KeptPoints own;
    load(s, crew, desk, own);
    std::uint32_t number = first_number;
    if (!fresh) {
      records.bring(number);
      crew.block_barrier();
      moves.move();
      crew.block_barrier();
    }
    auto next = IterationCourse::Next::iteration;
    for (; next == IterationCourse::Next::iteration; fresh = false) {
      const float ahead = progress.course.ahead();
      const bool judged = progress.course.judged();  // as is the first of all
      ++number;
      if (judged) {
        note_asked(crew, &crew.shared().asked, visit_all<law, true>(s, crew, desk, own, ahead, number));
        crew.arrive_asking(asked + progress.turn);
        if (fresh) crew.wait_for_asked(asked + progress.turn);  // until all blocks have cleared the numbers
      } else {
        visit_all<law, false>(s, crew, desk, own, ahead, number);
      }
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
    save(s, crew, desk, own);
    outer.came_back(crew);
    state = progress;
    return next == IterationCourse::Next::end;
  }
};

}  // namespace gem
