// The moments of scenes phase by phase: a launch makes one phase of all scenes, and takes no more registers than that
// needs, so that many threads hide what each waits for. Pays where there is more to do than threads at work.
//
// | phase            | who                  | what                                                                  |
// | open             | a thread for a scene | the call begins                                                       |
// | begin            | all                  | solo events up to the first pair events                               |
// | plan             | a thread for a scene | says what the first moment does; ends a call that found no list       |
// | list             | all, on a worn list  | books are brought up to date, a new list                              |
// | choose           | a thread for a pair  | the work of the last moment's contacts; pairs that have to be seen    |
// | look             | lanes for a look     | where these touch                                                     |
// | resolve          | a thread for a touch | its event; coupled: its points                                        |
// | gather           | a cluster of blocks, | coupled: who iterates which points, and where they begin              |
// |                  | one for few points   |                                                                       |
// | iterate          | the same             | coupled: the first round of iterations, mostly the only one           |
// | settle           | the same             | coupled: what they come to, after further rounds if there are any     |
// | bodies           | a thread for a body  | the bodies phase of device_bodies.h; the last to come plans           |
// | last_work, close | all                  | the books of the last moment, and the state for the host              |
//
// Between two phases nothing is kept but the scene's memory and its alarms. Blocks meet within none, but where they
// build a list or iterate.
#pragma once

#include <cstddef>

#include "gem/engine/device/plan.h"

namespace gem {

/// Solo events up to the first pair events of the call.
template <class Crew>
GEM_DEVICE inline void begin_call(const DeviceScene& s, Crew& crew) {
  if (!s.status->half_way) first_solo_events(s, crew, share_bodies(s, crew));
  for (std::int32_t k = rank_of(crew); k < 2 * OverlapCount::classes; k += size_of(crew)) s.overlap_count[k] = 0;
}

/// The work of the contacts of the last moment; `carries`: what they carried is taken out of the list.
template <class Crew>
GEM_DEVICE inline void close_contacts(const DeviceScene& s, Crew& crew, std::int32_t stamp, bool carries) {
  for (std::int32_t k = rank_of(crew); k < s.status->touched; k += size_of(crew)) {
    const std::int32_t p = s.touched[k];
    work_of_contact(s, s.pair[p], s.contact[p], stamp);
    if (carries) carry_pair(s, crew, s.pair[p], s.memory[p]);
  }
}

GEM_DEVICE inline bool is_coupled(const DeviceScene& s) { return s.constants.resolution == Resolution::coupled; }

/// Stamp of books that are closed between two moments; unlike that of any moment.
GEM_DEVICE inline std::int32_t closing_stamp(const DeviceScene& s) {
  return -2 - static_cast<std::int32_t>(s.status->moment);
}

/// The same into the books of the bodies, once it is all there.
template <class Crew>
GEM_DEVICE inline void close_bodies(const DeviceScene& s, Crew& crew) {
  const std::int32_t stamp = closing_stamp(s);
  for (std::int32_t i = rank_of(crew); i < s.bodies; i += size_of(crew)) gather_work(s, i, s.motion[i], stamp);
}

/// A new list, by blocks that meet.
template <class Crew>
GEM_DEVICE inline void renew_list(const DeviceScene& s, Crew& crew) {
  close_contacts(s, crew, closing_stamp(s), is_coupled(s));
  crew.barrier();
  close_bodies(s, crew);
  build_list(s, crew, s.status->moment, s.status->horizon);
  if (is_coupled(s) && s.status->list_valid) hand_out_memory(s, crew, static_cast<std::int32_t>(s.status->moment));
  if (rank_of(crew) != 0) return;
  s.status->touched = 0;
  s.status->drift = list_drift(s);
}

/// Pairs that a thread asks for together.
constexpr int asked_pairs = 8;
/// Fast memory of a block that chooses: those of its pairs that are awake [bytes].
constexpr std::size_t choose_room = asked_pairs * phase_threads * sizeof(std::int32_t);

/// Lists those of a stretch of pairs that are awake. Most sleep: as long as the clock, which goes on by twice the way
/// of the body that went farthest, has not gone on by the gap that they had left.
template <class Crew>
GEM_DEVICE inline void list_awake(const DeviceScene& s, Crew& crew, Stretch pairs, float clock, std::int32_t* awake) {
  float wake[asked_pairs];
  const std::int32_t first = pairs.begin + crew.thread(), step = crew.threads();
  for (int k = 0; k < asked_pairs; ++k) wake[k] = first + k * step < pairs.end ? s.wake[first + k * step] : 0.0F;
  for (int k = 0; k < asked_pairs; ++k)
    if (first + k * step < pairs.end && !(wake[k] > clock)) awake[crew.add(&crew.shared().looks, 1)] = first + k * step;
}

/// Pairs that may touch now, a stretch at a time.
template <class Crew>
GEM_DEVICE inline void choose_pairs(const DeviceScene& s, Crew& crew) {
  close_contacts(s, crew, static_cast<std::int32_t>(s.status->moment), false);
  const auto next_look = [&]() -> LookItem& { return s.look[crew.add(&s.counters->looks, 1)]; };
  constexpr double surely = 1.0 - 1e-6;  // the clock is compared in single precision
  const double clock = s.status->clock;
  auto* const awake = reinterpret_cast<std::int32_t*>(crew.room());
  const std::int32_t pairs = s.counters->pairs, stretch = asked_pairs * crew.threads();
  for (std::int32_t first = crew.block() * stretch; first < pairs; first += crew.blocks() * stretch) {
    if (crew.thread() == 0) crew.shared().looks = 0;
    crew.block_barrier();
    list_awake(s, crew, {first, first + stretch < pairs ? first + stretch : pairs}, static_cast<float>(clock), awake);
    crew.block_barrier();
    for (std::int32_t k = crew.thread(); k < crew.shared().looks; k += crew.threads()) {
      const std::int32_t p = awake[k];
      const double spare = choose_look(s, s.pair[p], p, next_look);
      if (spare > 0.0) s.wake[p] = static_cast<float>(surely * (clock + spare) - look_rounding);
    }
    crew.block_barrier();
  }
}

template <class Crew>
GEM_DEVICE inline void look_at_pairs(const DeviceScene& s, Crew& crew) {
  const std::int32_t groups = crew.threads() / Crew::Lanes::size,
                     first = crew.block() * groups + crew.thread() / Crew::Lanes::size;
  const auto next_touch = [&](int points) {
    return TouchPlace{crew.add(&s.counters->touches, 1), is_coupled(s) ? crew.add(&s.counters->points, points) : 0};
  };
  look_at_items(s, crew, s.pair, reinterpret_cast<DeskOutlines*>(crew.room()), s.look, first, s.counters->looks,
                crew.blocks() * groups, next_touch);
}

/// What a block found of the moment's quality goes to that of all.
template <class Crew>
GEM_DEVICE inline void add_quality(const DeviceScene& s, Crew& crew) {
  crew.block_barrier();
  if (crew.thread() != 0 || !s.wants_samples) return;
  const BlockCell& shared = crew.shared();
  BlockQuality& quality = s.quality[s.status->samples];
  if (shared.overlap > 0) crew.highest(&quality.overlap, shared.overlap);
  if (shared.share > 0) crew.highest(&quality.share, shared.share);
  if (shared.contacts > 0) crew.add(&quality.contacts, shared.contacts);
  if (shared.complementarity > 0) crew.highest(&quality.complementarity, shared.complementarity);
  if (shared.cone_excess > 0) crew.highest(&quality.cone_excess, shared.cone_excess);
}

/// The events of all touches, or their points.
template <Resolution resolution, class Crew>
GEM_DEVICE inline void resolve_touches(const DeviceScene& s, Crew& crew) {
  BlockCell& shared = crew.shared();
  if (crew.thread() == 0) shared = {};
  crew.block_barrier();
  const std::int32_t moment = static_cast<std::int32_t>(s.status->moment), touches = s.counters->touches;
  for (std::int32_t k = rank_of(crew); k < touches; k += size_of(crew)) {
    const Touch& touch = s.touch[k];
    s.touched[k] = touch.pair;
    if constexpr (resolution == Resolution::coupled)
      open_touch(s, crew, s.pair[touch.pair], touch, moment);
    else
      resolve(s, crew, s.pair[touch.pair], touch, moment);
  }
  add_quality(s, crew);
}

/// The points of a coupled moment are shared out, and placed in the fast memory of the blocks that will iterate them:
/// as many as these, each with as much in its crew.room_bytes().
template <class Crew>
GEM_DEVICE inline void gather_points(const DeviceScene& s, Crew& crew) {
  MomentSolver<Crew>(s, crew, static_cast<std::int32_t>(s.status->moment), crew.room_bytes()).begin_ahead();
  SolverRounds<Crew>::prepare(s, crew);
}

/// What the iterations of a coupled moment come to, by as many blocks, which do not reach each other's fast memory.
template <class Crew>
GEM_DEVICE inline void settle_points(const DeviceScene& s, Crew& crew) {
  BlockCell& shared = crew.shared();
  if (crew.thread() == 0) shared = {};
  crew.block_barrier();
  SolverRounds<Crew>::run_rest(s, crew);
  MomentSolver<Crew>(s, crew, static_cast<std::int32_t>(s.status->moment), crew.room_bytes()).end();
  add_quality(s, crew);
  if (rank_of(crew) != 0) return;
  s.status->visits += static_cast<std::int64_t>(s.counters->points) * shared.iterations;
  if (!s.wants_samples) return;
  BlockQuality& quality = s.quality[s.status->samples];
  quality.iterations = shared.iterations;
  quality.residual = shared.residual;
  quality.energy_created = shared.energy_created;
}

/// Where a block works on copies of its bodies, with what is left for the platform's terms.
template <class Crew>
GEM_DEVICE inline Desk bodies_desk(const DeviceScene& s, Crew& crew) {
  Desk desk = share_bodies(s, crew);
  const std::size_t cells = desk.bodies.count() * sizeof(BodyCell), motions = desk.bodies.count() * sizeof(BodyMotion);
  std::byte* const room = crew.room();
  desk.body = reinterpret_cast<BodyCell*>(room) - desk.bodies.begin;
  desk.motion = reinterpret_cast<BodyMotion*>(room + cells) - desk.bodies.begin;
  desk.look = reinterpret_cast<LookItem*>(room + cells + motions);
  desk.minimum_bytes = crew.room_bytes() - cells - motions;
  desk.shows = false;
  return desk;
}

/// The way of a body in this moment, and how far its rim turned [m].
GEM_DEVICE inline double way_of(const BodyCell& now, const BodyCell& before, Vec2 drift) {
  return length(now.position - before.position - drift) + now.radius * (now.turn_travel - before.turn_travel);
}

/// How far the block's bodies went; the scene's cells still show where they were.
template <class Crew>
GEM_DEVICE inline void note_farthest(const DeviceScene& s, Crew& crew, const Desk& desk) {
  const auto warp = crew.warp();
  const Vec2 drift = s.constants.dt * s.status->drift;
  double most = 0.0;
  for (std::int32_t i = desk.bodies.begin + crew.thread(); i < desk.bodies.end; i += crew.threads())
    most = larger(most, way_of(desk.body[i], s.body[i], drift));
  for (int step = 1; step < Crew::Warp::size; step *= 2) most = larger(most, warp.partner(most, step));
  if (warp.rank() == 0) crew.highest(&s.status->farthest, strict::bits_of(most));
  crew.block_barrier();
}

/// Puts back the words of the block's bodies that change while they move, but that of their kind: others read it.
template <class Crew>
GEM_DEVICE inline void put_moved_back(const DeviceScene& s, Crew& crew, const Desk& desk) {
  constexpr int words = 8, kind = 3, cell_end = 6, motion_begin = 2, motion_end = 4;
  static_assert(sizeof(BodyCell) == words * sizeof(CopyWord) && sizeof(BodyMotion) == sizeof(BodyCell));
  static_assert(offsetof(BodyCell, kind) / sizeof(CopyWord) == kind &&
                offsetof(BodyCell, active) / sizeof(CopyWord) == kind &&
                offsetof(BodyCell, velocity) >= (kind + 1) * sizeof(CopyWord) &&
                offsetof(BodyCell, spin) + sizeof(double) <= cell_end * sizeof(CopyWord));
  static_assert(offsetof(BodyMotion, path_correction) >= motion_begin * sizeof(CopyWord) &&
                offsetof(BodyMotion, angle_correction) + sizeof(double) <= motion_end * sizeof(CopyWord));
  const std::int32_t first = desk.bodies.begin, count = desk.bodies.count();
  copy_parts<words, 0, kind>(crew, s.body + first, desk.body + first, count);
  copy_parts<words, kind + 1, cell_end>(crew, s.body + first, desk.body + first, count);
  copy_parts<words, motion_begin, motion_end>(crew, s.motion + first, desk.motion + first, count);
}

/// The bodies move.
template <Resolution resolution, class Crew>
GEM_DEVICE inline void move_by_blocks(const DeviceScene& s, Crew& crew) {
  const DeviceStatus& status = *s.status;
  const Desk desk = bodies_desk(s, crew);
  take_bodies(s, crew, desk);
  crew.block_barrier();
  const std::int64_t done = status.moment + 1 - status.list_moment;
  const MomentStep step{static_cast<std::int32_t>(status.moment), status.samples,
                        static_cast<double>(done) * s.constants.dt, status.samples + 1 < status.wanted};
  move_bodies<resolution>(s, crew, desk, step);
  crew.block_barrier();
  note_farthest(s, crew, desk);
  put_moved_back(s, crew, desk);
}

/// Fast memory of a block that moves bodies: their copies, and room for the terms of a usual platform [bytes].
constexpr std::size_t bodies_room = phase_threads * (sizeof(BodyCell) + sizeof(BodyMotion)) + 8 * 1024;

GEM_HD constexpr bool is_of_solver(DevicePhase phase) {
  return phase == DevicePhase::gather || phase == DevicePhase::iterate || phase == DevicePhase::settle;
}

/// Whether the scene has no part in a phase.
template <DevicePhase phase>
GEM_DEVICE inline bool is_idle(const DeviceScene& s) {
  if (is_of_solver(phase)) return s.counters->points == 0;
  if (phase == DevicePhase::begin) return s.status->step == PhaseStep::ended;
  if (phase == DevicePhase::last_work || phase == DevicePhase::close) return s.status->wanted == 0;
  return !moves(s);
}

/// What a block does for a scene in one phase; the resolution counts where touches are resolved and bodies move.
template <DevicePhase phase, Resolution resolution, class Crew>
GEM_DEVICE inline void run_phase(const DeviceScene& s, Crew& crew) {
  if (is_idle<phase>(s)) return;
  if constexpr (phase == DevicePhase::begin) begin_call(s, crew);
  if constexpr (phase == DevicePhase::choose) choose_pairs(s, crew);
  if constexpr (phase == DevicePhase::look) look_at_pairs(s, crew);
  if constexpr (phase == DevicePhase::resolve) resolve_touches<resolution>(s, crew);
  if constexpr (phase == DevicePhase::gather) gather_points(s, crew);
  if constexpr (phase == DevicePhase::iterate) SolverRounds<Crew>::run_first(s, crew);
  if constexpr (phase == DevicePhase::settle) settle_points(s, crew);
  if constexpr (phase == DevicePhase::bodies) move_by_blocks<resolution>(s, crew);
  if constexpr (phase == DevicePhase::last_work) close_contacts(s, crew, closing_stamp(s), is_coupled(s));
  if constexpr (phase == DevicePhase::close) {
    close_bodies(s, crew);
    write_state(s, crew);
  }
}

}  // namespace gem
