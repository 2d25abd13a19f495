// The bodies and points of a coupled moment, shared out among the blocks of a crew: who iterates what, and where its
// numbers stand.
//
// A point writes what it pushes into the rows of both bodies, in the order in which they add it up, so that no thread
// looks for anything while the iterations run. Where the blocks of a crew reach each other's fast memory, the rows
// stand there as far as it holds them.
#pragma once

#include "gem/engine/solver/device_points.h"

namespace gem {

/// Calls work(point) for the points of this thread.
template <class Crew, class Work>
GEM_DEVICE GEM_INLINE void each_point(Crew& crew, Work&& work) {
  const SolverDesk& desk = crew.shared().desk;
  for (std::int32_t i = desk.points.begin + crew.thread(); i < desk.points.end; i += crew.threads()) work(i);
}

/// Counts the bits before each of some words, and in all, by a warp.
template <class Warp>
GEM_DEVICE inline void count_marks(const Warp& warp, const std::uint32_t* marks, std::int32_t* before,
                                   std::int32_t words) {
  constexpr int size = Warp::size, together = 4;
  std::int32_t sum = 0;
  for (std::int32_t first = warp.rank(); first - warp.rank() < words; first += together * size) {
    int mine[together];  // asked for together: each waits for memory
    for (int k = 0; k < together; ++k) mine[k] = first + k * size < words ? bits_in(marks[first + k * size]) : 0;
    for (int k = 0; k < together; ++k) {
      const int below = warp.sum_below(mine[k]);
      if (first + k * size < words) before[first + k * size] = sum + below;
      sum += warp.sum(mine[k]);
    }
  }
  if (warp.rank() == 0) before[words] = sum;
}

template <class Crew>
class SolverList {
 public:
  /// `room`: bytes of fast memory of each block that the solver may use, from the start.
  GEM_DEVICE SolverList(const DeviceScene& s, Crew& crew, std::int32_t moment, std::size_t room)
      : s_(s), crew_(crew), moment_(moment), room_(room) {}

  /// A list for a launch that follows, of as many blocks with `room`: this one needs none.
  GEM_DEVICE void make_ahead() {
    make();
    if (crew_.thread() == 0) s_.solver_desk[crew_.block()] = crew_.shared().desk;
  }
  /// Takes up a list that was made ahead.
  GEM_DEVICE void take_up() {
    SolverDesk desk = s_.solver_desk[crew_.block()];
    place_entries(desk);
    place_points(desk);
    use_room(desk);
    if (crew_.thread() == 0) crew_.shared().desk = desk;
    if (!desk.motion) return crew_.block_barrier();
    for (std::int32_t e = desk.own.begin + crew_.thread(); e < desk.own.end; e += crew_.threads())
      desk.motion[e] = {};  // nothing has been added to any
    list_in_order(desk);
  }

  /// Finds the block's stretch of the bodies with points, gives their points places, and takes its share of the points.
  GEM_DEVICE void make() {
    SolverDesk desk{};
    desk.pace = {static_cast<float>(s_.constants.dt), static_cast<float>(1.0 / s_.constants.dt)};
    const std::int32_t words = bit_words(s_);
    const std::int64_t own_words = static_cast<std::int64_t>(crew_.block()) * (words + 1);
    std::int32_t *const bodies = s_.bodies_before + own_words, *const spots = s_.spots_before + own_words;
    BlockCell& shared = crew_.shared();
    if (crew_.thread() == 0) shared.records = shared.taken = 0;
    constexpr int warp = Crew::Warp::size;
    const int warps = crew_.threads() / warp;
    for (int k = crew_.thread() / warp; k < 2; k += warps)
      count_marks(crew_.warp(), k == 0 ? s_.touched_bodies : s_.touched_spots, k == 0 ? bodies : spots, words);
    crew_.block_barrier();
    desk.bodies = spots[words];
    desk.own = desk.moved = own_ = stretch_of(crew_, desk.bodies);
    for (std::int32_t spot = crew_.thread(); spot < s_.bodies; spot += crew_.threads()) {
      const std::uint32_t bits = s_.touched_spots[spot / 32], bit = 1U << (spot % 32);
      const std::int32_t at = spots[spot / 32] + bits_in(bits & (bit - 1U));
      if ((bits & bit) && at >= own_.begin && at < own_.end) s_.solver_entry[at].body = s_.body_at[spot];
    }
    crew_.block_barrier();
    place_entries(desk);
    // the platform, whose spot is the first, has a long row: the last warp is left to it
    const bool platform = desk.platform = own_.begin == 0 && own_.end > 0 && (s_.touched_spots[0] & 1U);
    const bool alone = crew_.threads() <= Crew::Warp::size;
    const int rest = platform && !alone ? crew_.threads() - Crew::Warp::size : crew_.threads();
    if (platform && (alone || crew_.thread() >= rest)) list_points(crew_.warp(), desk, own_.begin, bodies);
    if (crew_.thread() < rest) {
      const int group = crew_.thread() / Crew::Lanes::size, groups = rest / Crew::Lanes::size;
      for (std::int32_t e = own_.begin + (platform ? 1 : 0) + group; e < own_.end; e += groups)
        list_points(crew_.lanes(), desk, e, bodies);
    }
    crew_.block_barrier();
    if (crew_.thread() == 0) shared.first_taken = crew_.add(&s_.counters->taken_points, shared.taken);
    crew_.block_barrier();
    desk.points = {shared.first_taken, shared.first_taken + shared.taken};
    desk.records = records_begin_ + shared.records;
    place_points(desk);
    if (crew_.thread() == 0) shared.desk = desk;
    for (std::int32_t e = own_.begin + crew_.thread(); e < own_.end; e += crew_.threads()) {
      const TakenPoints taken = s_.taken_of[e];
      GEM_NO_UNROLL
      for (std::int32_t k = 0; k < taken.count; ++k)
        s_.taken[shared.first_taken + taken.first + k] = s_.taken_in_row[desk.entry[e].place + k];
    }
    crew_.block_barrier();
  }

 private:
  /// Fast memory that motions, records and points may take [bytes].
  GEM_DEVICE std::size_t room_before_entries(const SolverDesk& desk) const {
    return desk.fits ? (room_ - desk.own.count() * sizeof(SolverEntry)) / alignof(SolverEntry) * alignof(SolverEntry)
                     : room_;
  }

  /// Points that no thread keeps in registers stand in the scene's memory.
  GEM_DEVICE void place_points(SolverDesk& desk) const {
    const std::int32_t kept = Crew::kept_points * crew_.threads(),
                       first = desk.points.begin + (kept < desk.points.count() ? kept : desk.points.count());
    desk.fast = {first, first};
    desk.fast_from = 0;
  }

  /// Entries and motions stand in the scene's memory; `fits`: the fast memory of those that iterate holds the block's.
  GEM_DEVICE void place_entries(SolverDesk& desk) {
    static_assert(sizeof(AddedMotion) == sizeof(PushRecord));
    const std::int32_t count = desk.own.count();
    desk.entry = desk.moved_entry = s_.solver_entry;
    desk.motion = nullptr;
    desk.in_order = false;
    desk.stage_bytes = Crew::shares_rooms ? 0 : room_;
    desk.fits =
        Crew::shares_rooms && count * (sizeof(SolverEntry) + sizeof(AddedMotion)) + alignof(SolverEntry) <= room_;
    records_begin_ = desk.fits ? count : 0;
    records_end_ = static_cast<std::int32_t>(room_before_entries(desk) / sizeof(PushRecord));
  }

  /// What fits stands in the block's fast memory; what the records leave of it holds points.
  GEM_DEVICE void use_room(SolverDesk& desk) const {
    if (!Crew::shares_rooms) return;
    const std::size_t room = room_before_entries(desk),
                      taken = (desk.records * sizeof(PushRecord) + sizeof(FloatQuad) - 1) / sizeof(FloatQuad) *
                              sizeof(FloatQuad);
    if (desk.fits) {
      desk.entry = desk.moved_entry = reinterpret_cast<SolverEntry*>(crew_.room() + room) - desk.own.begin;
      desk.motion = reinterpret_cast<AddedMotion*>(crew_.room()) - desk.own.begin;
    }
    if (taken >= room) return;
    const std::int32_t left = desk.points.end - desk.fast.begin;
    const auto hold = static_cast<std::int32_t>((room - taken) / held_bytes);
    desk.fast.end += left < hold ? left : hold;
    desk.fast_from = taken;
  }

  /// Longest rows first.
  static std::int32_t GEM_DEVICE kind_of(const SolverEntry& entry) {
    const std::int32_t most = part_lengths - 1, as_a = entry.count - entry.as_b;
    return part_lengths * (most - (entry.as_b < most ? entry.as_b : most)) + most - (as_a < most ? as_a : most);
  }

  /// Lists the bodies in the order of their rows' lengths; the platform, which has threads of its own, stays the first.
  /// For iterations alone: where the rank of a body is asked for, the list of the scene counts.
  GEM_DEVICE void list_in_order(const SolverDesk& desk) {
    BlockCell& shared = crew_.shared();
    for (std::int32_t k = crew_.thread(); k < row_kinds; k += crew_.threads()) shared.of_kind[k] = 0;
    crew_.block_barrier();
    const std::int32_t first = desk.own.begin + (desk.platform ? 1 : 0);
    for (std::int32_t e = first + crew_.thread(); e < desk.own.end; e += crew_.threads())
      crew_.add(&shared.of_kind[kind_of(s_.solver_entry[e])], 1);
    crew_.block_barrier();
    if (crew_.thread() < Crew::Warp::size) {
      const auto warp = crew_.warp();
      std::int32_t sum = first;
      for (std::int32_t k = warp.rank(); k < row_kinds; k += Crew::Warp::size) {
        const std::int32_t mine = shared.of_kind[k];
        shared.of_kind[k] = sum + warp.sum_below(mine);
        sum += warp.sum(mine);
      }
    }
    crew_.block_barrier();
    for (std::int32_t e = desk.own.begin + crew_.thread(); e < desk.own.end; e += crew_.threads()) {
      SolverEntry entry = s_.solver_entry[e];
      entry.rank = e;
      desk.entry[e < first ? e : crew_.add(&shared.of_kind[kind_of(entry)], 1)] = entry;
    }
    if (crew_.thread() == 0) shared.desk.in_order = true;
    crew_.block_barrier();
  }

  /// Where the records of a body of `count` points stand in the block's fast memory; -1: they do not.
  GEM_DEVICE std::int32_t take_records(std::int32_t count) {
    if (!Crew::shares_rooms) return -1;
    const std::int32_t at = records_begin_ + crew_.add(&crew_.shared().records, count);
    return at + count <= records_end_ ? at : -1;
  }

  static_assert(solve_room / sizeof(PushRecord) <= 0xffff);
  GEM_DEVICE static std::int32_t room_place(int block, std::int32_t at) { return block << 16 | at; }

  /// Whether the block of a body takes the points that it has with `other`: those with a large body, and of two floes
  /// the one that is A. The platform's are shared out among its floes.
  GEM_DEVICE bool takes(std::int32_t body, std::int32_t other, bool as_b) const {
    return is_large(s_, other) || (!as_b && body != 0);
  }

  /// Some places of a row, one in each step of a group's lane: asked for together, as each waits for memory.
  struct PlacesOfLane {
    static constexpr int steps = 4;
    RowPoints points[steps];
    bool takes[steps];
  };

  template <class Group>
  GEM_DEVICE PlacesOfLane read_places(const Group& lanes, std::int32_t body, const BodyMotion& motion,
                                      std::int32_t first) const {
    const std::int32_t begin = motion.row_begin, lower = motion.lower_count, places = motion.row_count;
    PlacesOfLane read;
    std::int32_t stamp[PlacesOfLane::steps], other[PlacesOfLane::steps];
    for (int k = 0; k < PlacesOfLane::steps; ++k) {
      const std::int32_t at = first + k * Group::size + lanes.rank(), row = begin + at;
      const bool there = at < places;
      stamp[k] = there ? s_.stamp[row].entry : moment_ - 1;
      other[k] = there ? s_.row_other[row] : 0;
      read.points[k] = there ? s_.row_points[row] : RowPoints{};
    }
    for (int k = 0; k < PlacesOfLane::steps; ++k) {
      const std::int32_t at = first + k * Group::size + lanes.rank();
      if (stamp[k] != moment_) read.points[k] = {};
      read.takes[k] = read.points[k].count > 0 && takes(body, other[k], at < lower);
    }
    return read;
  }

  /// Reads the row of a body by a group of lanes and gives its points their places.
  template <class Group>
  GEM_DEVICE void list_points(const Group& lanes, const SolverDesk& desk, std::int32_t e,
                              const std::int32_t* bodies_before) {
    constexpr int stride = PlacesOfLane::steps * Group::size;
    const std::int32_t body = s_.solver_entry[e].body;
    const BodyMotion& motion = s_.motion[body];
    const std::int32_t begin = motion.row_begin, lower = motion.lower_count, places = motion.row_count;
    std::int32_t count = 0, as_b = 0, taken = 0;
    PlacesOfLane read{};
    for (std::int32_t first = 0; first < places; first += stride) {
      read = read_places(lanes, body, motion, first);
      for (int k = 0; k < PlacesOfLane::steps; ++k) {
        const std::int32_t points = read.points[k].count;
        count += points;
        as_b += first + k * Group::size + lanes.rank() < lower ? points : 0;
        taken += read.takes[k] ? points : 0;
      }
    }
    count = lanes.sum(count);
    as_b = lanes.sum(as_b);
    taken = lanes.sum(taken);
    std::int32_t room = lanes.rank() == 0 ? take_records(count) : 0;
    room = lanes.from(room, 0);
    const std::int32_t moved_at = Crew::has_halos ? e : desk.fits ? room_place(crew_.block(), e - own_.begin) : -1;
    std::int32_t before = 0, taken_before = 0;
    for (std::int32_t first = 0; first < places; first += stride) {
      if (places > stride) read = read_places(lanes, body, motion, first);
      for (int step = 0; step < PlacesOfLane::steps; ++step) {
        if (first + step * Group::size >= places) break;
        const bool is_b = first + step * Group::size + lanes.rank() < lower;
        const RowPoints points = read.points[step];
        const std::int32_t mine = before + lanes.sum_below(points.count);
        const std::int32_t to = taken_before + lanes.sum_below(read.takes[step] ? points.count : 0);
        GEM_NO_UNROLL
        for (std::int32_t k = 0; k < points.count; ++k) {
          PointCell& point = s_.point[points.first + k];
          const std::int32_t in_room = room < 0 ? -1 : room_place(crew_.block(), room + mine + k);
          (is_b ? point.b : point.a) = {body, 2 * begin + mine + k, in_room, moved_at};
          if (read.takes[step]) s_.taken_in_row[2 * begin + to + k] = points.first + k;
        }
        before += lanes.sum(points.count);
        taken_before += lanes.sum(read.takes[step] ? points.count : 0);
      }
    }
    if (lanes.rank() != 0) return;
    const BodyCell& cell = s_.body[body];
    const std::uint32_t below = s_.touched_bodies[body / 32] & ((1U << (body % 32)) - 1U);
    desk.entry[e] = {body,
                     2 * begin,
                     room,
                     as_b,
                     count,
                     static_cast<float>(cell.inverse_mass),
                     static_cast<float>(cell.inverse_inertia),
                     bodies_before[body / 32] + bits_in(below)};
    s_.body_points[body] = {moment_, count};
    s_.taken_of[e] = {taken > 0 ? crew_.add(&crew_.shared().taken, taken) : 0, taken};
    s_.added[body] = {};
  }

  const DeviceScene& s_;
  Crew& crew_;
  std::int32_t moment_;
  std::size_t room_;
  Stretch own_{};
  std::int32_t records_begin_ = 0, records_end_ = 0;  // in the block's fast memory
};

}  // namespace gem
