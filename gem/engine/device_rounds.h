// Rounds of iterations on a device: as CoupledRounds, each point by the thread that holds it, each floe
// by two, the platform by a warp.
#pragma once

#include <cstring>

#include "gem/engine/device_held.h"
#include "gem/engine/device_settle.h"

namespace gem {

/// How far the iterations of a moment are.
struct Progress {
  IterationCourse course;
  double residual = 0.0;
  int turn = 0;  // of the two places for residuals
};

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

/// The rounds of one moment. Its functions hold no state but the desk: a point is in the registers of its thread.
template <class Crew>
class SolverRounds {
 public:
  GEM_DEVICE static void iterate(const DeviceScene& s, Crew& crew, const SolverDesk& desk) {
    const MomentConstants& c = s.constants;
    SolverBase<Crew> base(s, crew, desk);
    Progress progress{IterationCourse(c.residual_speed, c.iterations_maximum, c.tight_residual)};
    for (bool done = false; !done;) {
      done = run_round_by_law(s, crew, desk, progress);
      crew.barrier();
      base.settle();
      crew.barrier();
    }
    if (rank_of(crew) == 0) {
      crew.shared().iterations = static_cast<std::int32_t>(progress.course.iteration());
      crew.shared().residual = progress.residual;
    }
  }

 private:
  GEM_DEVICE static bool run_round_by_law(const DeviceScene& s, Crew& crew, const SolverDesk& desk,
                                          Progress& progress) {
    switch (s.constants.point_friction) {
      case PointFriction::none:
        return run_round<PointFriction::none>(s, crew, desk, progress);
      case PointFriction::coulomb:
        return run_round<PointFriction::coulomb>(s, crew, desk, progress);
      default:
        return run_round<PointFriction::fixed_direction>(s, crew, desk, progress);
    }
  }

  GEM_DEVICE static PushRecord* record_at(const DeviceScene& s, Crew& crew, std::int32_t place, std::int32_t room) {
    if (room >= 0) return reinterpret_cast<PushRecord*>(crew.room_of(room >> 16)) + (room & 0xffff);
    return place >= 0 ? s.push + place : nullptr;
  }

  GEM_DEVICE static const AddedMotion* motion_at(const DeviceScene& s, Crew& crew, std::int32_t room,
                                                 std::int32_t body) {
    return room >= 0 ? reinterpret_cast<const AddedMotion*>(crew.room_of(room >> 16)) + (room & 0xffff)
                     : s.added + body;
  }

  GEM_DEVICE static Motion<double> solved_motion(const DeviceScene& s, std::int32_t body) {
    const SolvedMotion& m = s.solved[body];
    return {m.part[0], m.part[1], m.part[4], m.part[2], m.part[3], m.part[5]};
  }

  /// A point at the start of a round; `carried` is what the last one left, less what is in the base now.
  GEM_DEVICE GEM_INLINE static void hold(const DeviceScene& s, Crew& crew, std::int32_t i, bool fresh,
                                         HeldPoint& held) {
    if (fresh)
      held.carried = {0.0F, 0.0F, 0.0F};
    else
      HeldTable(s).load_additions(i, held);
    const PointCell point = s.taken_point[i];
    held.a = {motion_at(s, crew, point.motion_a, point.a), record_at(s, crew, point.place_a, point.room_a)};
    held.b = {motion_at(s, crew, point.motion_b, point.b), record_at(s, crew, point.place_b, point.room_b)};
    const PointGeometry<double> geometry = s.points.geometry(i);
    enter_geometry(held.frame, geometry);
    enter_base(held.frame, geometry, s.points.impulse(i), solved_motion(s, point.a), solved_motion(s, point.b));
    held.at = {0.0F, 0.0F, 0.0F};
    if (!fresh) push(held);
  }

  /// The additions of a round enter the base.
  GEM_DEVICE GEM_INLINE static void let_go(const DeviceScene& s, std::int32_t i, HeldPoint& held) {
    const PointGeometry<double> g = s.points.geometry(i);
    write_base(s, i, g,
               with_additions(s.constants.point_friction, g, s.points.impulse(i), held.at, held.frame.least,
                              held.frame.most, held.frame.repair_least));
    held.carried.normal -= held.at.normal;
    held.carried.tangential -= held.at.tangential;
    held.carried.repair -= held.at.repair;
    HeldTable(s).save_additions(i, held);
  }

  GEM_DEVICE GEM_INLINE static void push(const HeldPoint& held) {
    const PointPush<float> p = push_of(held.frame, held.carried);
    if (held.a.record) *held.a.record = {{{{p.x, p.y, p.shift_x, p.shift_y}}, {{p.twist_a, p.turn_a, 0.0F, 0.0F}}}};
    if (held.b.record) *held.b.record = {{{{p.x, p.y, p.shift_x, p.shift_y}}, {{p.twist_b, p.turn_b, 0.0F, 0.0F}}}};
  }

  /// Motions by the additions of the round: as CoupledRounds::move(). The platform, first of all where it is among the
  /// block's bodies, has a long row: the last warp is left to it.
  GEM_DEVICE GEM_INLINE static void move(const DeviceScene& s, Crew& crew, const SolverDesk& desk) {
    constexpr int warp = Crew::Warp::size;
    const bool alone = crew.threads() <= warp;
    const int rest = desk.platform && !alone ? crew.threads() - warp : crew.threads();
    if (desk.platform && (alone || crew.thread() >= rest)) move_platform(s, crew, desk);
    if (crew.thread() < rest) move_floes(s, crew, desk, rest);
  }

  /// A body has two threads, one for what moves it and one for what turns it; each fetches a few records together
  /// before it adds them in their order.
  GEM_DEVICE GEM_INLINE static void move_floes(const DeviceScene& s, Crew& crew, const SolverDesk& desk, int threads) {
    constexpr int together = 4;
    const auto* const room = reinterpret_cast<const PushRecord*>(crew.room());
    for (std::int32_t k = crew.thread() + (desk.platform ? 2 : 0); k < 2 * desk.own.count(); k += threads) {
      const std::int32_t e = desk.own.begin + k / 2, half = k % 2;
      const SolverEntry entry = desk.entry[e];
      const PushRecord* const record = entry.room >= 0 ? room + entry.room : s.push + entry.place;
      FloatQuad to_b{}, to_a{};
      for (std::int32_t first = 0; first < entry.count; first += together) {
        FloatQuad some[together];
        for (int j = 0; j < together; ++j)
          if (first + j < entry.count) some[j] = record[first + j].half[half];
        for (int j = 0; j < together; ++j) {
          if (first + j < entry.as_b)
            add(to_b, some[j]);
          else if (first + j < entry.count)
            add(to_a, some[j]);
        }
      }
      const float answer = half == 0 ? entry.inverse_mass : entry.inverse_inertia;
      (desk.motion ? desk.motion[e] : s.added[entry.body]).half[half] = {
          {answer * (to_b.part[0] - to_a.part[0]), answer * (to_b.part[1] - to_a.part[1]),
           answer * (to_b.part[2] - to_a.part[2]), answer * (to_b.part[3] - to_a.part[3])}};
    }
  }

  /// A lane for each number of the platform's motion; its records are brought to the block's fast memory, if they do
  /// not stand there. It has the lowest id: no record is one of a body B.
  GEM_DEVICE GEM_INLINE static void move_platform(const DeviceScene& s, Crew& crew, const SolverDesk& desk) {
    constexpr int parts = sizeof(PushRecord) / sizeof(float);
    const auto warp = crew.warp();
    const SolverEntry entry = desk.entry[desk.own.begin];
    const auto* record = reinterpret_cast<const float*>(s.push + entry.place);
    auto* const room = reinterpret_cast<float*>(crew.room());
    if (entry.room >= 0) {
      record = room + parts * entry.room;
    } else if (static_cast<std::size_t>(entry.count) * sizeof(PushRecord) <= desk.stage_bytes) {
      for (std::int32_t k = warp.rank(); k < parts * entry.count; k += Crew::Warp::size) room[k] = record[k];
      warp.sync();
      record = room;
    }
    float* const motion = reinterpret_cast<float*>(desk.motion ? &desk.motion[desk.own.begin] : &s.added[entry.body]);
    for (int part = warp.rank(); part < parts; part += Crew::Warp::size) {
      float sum = 0.0F;
      for (std::int32_t k = 0; k < entry.count; ++k) sum += record[parts * k + part];
      motion[part] = (part < parts / 2 ? entry.inverse_mass : entry.inverse_inertia) * (0.0F - sum);
    }
    warp.sync();
  }

  GEM_DEVICE GEM_INLINE static void add(FloatQuad& sum, const FloatQuad& term) {
    for (int c = 0; c < 4; ++c) sum.part[c] += term.part[c];
  }

  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_INLINE static float visit(MomentPace<float> pace, HeldPoint& held, float ahead) {
    const AddedMotion a = *held.a.motion, b = *held.b.motion;
    const FloatQuad &go_a = a.half[0], &go_b = b.half[0], &turn_a = a.half[1], &turn_b = b.half[1];
    const Approach<float> w{go_b.part[0] - go_a.part[0],
                            go_b.part[1] - go_a.part[1],
                            go_b.part[2] - go_a.part[2],
                            go_b.part[3] - go_a.part[3],
                            turn_a.part[0],
                            turn_a.part[1],
                            turn_b.part[0],
                            turn_b.part[1]};
    const float asked = visit_point<law, judged>(held.frame, w, pace, ahead, held.at, held.carried);
    push(held);
    return asked;
  }

  /// Visits the points of this thread; returns, where `judged`, the largest speed that one asked for.
  template <PointFriction law, bool judged>
  GEM_DEVICE GEM_INLINE static float visit_all(const DeviceScene& s, Crew& crew, const SolverDesk& desk,
                                               HeldPoint& first, HeldPoint& second, float ahead) {
    const std::int32_t size = crew.threads(), i0 = desk.points.begin + crew.thread(), end = desk.points.end;
    const HeldTable table(s);
    float most = 0.0F;
    if (i0 < end) most = larger(visit<law, judged>(desk.pace, first, ahead), most);
    if (i0 + size < end) most = larger(visit<law, judged>(desk.pace, second, ahead), most);
    for (std::int32_t i = i0 + 2 * size; i < end; i += size) {
      HeldPoint held = table.load(i);
      most = larger(visit<law, judged>(desk.pace, held, ahead), most);
      table.save_additions(i, held);
    }
    return most;
  }

  GEM_DEVICE static void note_asked(Crew& crew, std::uint32_t* asked, float most) {
    const auto warp = crew.warp();
    const std::uint32_t all = warp.highest(ordered_bits(most));
    if (warp.rank() == 0 && all != 0) crew.highest(asked, all);
  }

  /// One round; returns whether it was the last. A function of its own: the points that a thread holds take most of its
  /// registers.
  template <PointFriction law>
  GEM_DEVICE GEM_NOINLINE static bool run_round(const DeviceScene& s, Crew& crew, const SolverDesk desk,
                                                Progress& kept) {
    Progress progress = kept;
    std::uint32_t* const asked = s.counters->asked;
    const std::int32_t size = crew.threads(), i0 = desk.points.begin + crew.thread(), end = desk.points.end;
    HeldPoint first, second;
    bool fresh = progress.course.iteration() == 0;  // nothing is added yet
    if (i0 < end) hold(s, crew, i0, fresh, first);
    if (i0 + size < end) hold(s, crew, i0 + size, fresh, second);
    for (std::int32_t i = i0 + 2 * size; i < end; i += size) {
      HeldPoint held;
      hold(s, crew, i, fresh, held);
      HeldTable(s).save(i, held);
    }
    if (!fresh) crew.barrier();
    crew.lap(stage_frames);
    auto next = IterationCourse::Next::iteration;
    for (; next == IterationCourse::Next::iteration; fresh = false) {
      if (!fresh) {
        move(s, crew, desk);
        crew.barrier();
      }
      const float ahead = progress.course.ahead();
      if (progress.course.judged()) {
        note_asked(crew, asked + progress.turn, visit_all<law, true>(s, crew, desk, first, second, ahead));
      } else {
        visit_all<law, false>(s, crew, desk, first, second, ahead);
      }
      crew.barrier();
      if (progress.course.judged()) {
        progress.residual = static_cast<double>(from_ordered_bits(asked[progress.turn]));
        progress.turn = 1 - progress.turn;
        if (rank_of(crew) == 0) asked[progress.turn] = 0;
      }
      next = progress.course.after(progress.residual);
    }
    crew.lap(stage_iterations);
    if (i0 < end) let_go(s, i0, first);
    if (i0 + size < end) let_go(s, i0 + size, second);
    for (std::int32_t i = i0 + 2 * size; i < end; i += size) {
      HeldPoint held = HeldTable(s).load(i);
      let_go(s, i, held);
    }
    kept = progress;
    return next == IterationCourse::Next::end;
  }
};

}  // namespace gem
