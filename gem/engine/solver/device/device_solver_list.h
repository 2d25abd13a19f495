// Assigns the bodies and points of a coupled time step to the blocks of a thread group, and lays out their numbers.
//
// Each point writes a record for each of its two bodies: what it pushes the body by. The records of a body form a row,
// in the order in which they are added up. So no thread searches while the iterations run. Where blocks reach each
// other's shared memory, the rows stand there as far as they fit.
#pragma once

#include "gem/engine/solver/device/device_points.h"

namespace gem {

/// Calls work(i) for the points of this thread.
template <class Group, class Work>
GEM_DEVICE GEM_INLINE void each_point(Group& group, Work&& work) {
  const SolverWorkspace& workspace = group.shared().workspace;
  for (std::int32_t i = workspace.points.begin + group.thread(); i < workspace.points.end; i += group.threads())
    work(i);
}

/// Writes to before[w] the number of set bits in the words below w, and to before[words] that of all. Work of one warp.
template <class Warp>
GEM_DEVICE inline void count_marks(const Warp& warp, const std::uint32_t* marks, std::int32_t* before,
                                   std::int32_t words) {
  constexpr int size = Warp::size, together = 4;
  std::int32_t sum = 0;
  for (std::int32_t first = warp.rank(); first - warp.rank() < words; first += together * size) {
    int mine[together];  // loaded together to hide the latency of memory
    for (int k = 0; k < together; ++k) mine[k] = first + k * size < words ? bits_in(marks[first + k * size]) : 0;
    for (int k = 0; k < together; ++k) {
      const int below = warp.sum_below(mine[k]);
      if (first + k * size < words) before[first + k * size] = sum + below;
      sum += warp.sum(mine[k]);
    }
  }
  if (warp.rank() == 0) before[words] = sum;
}

template <class Group>
class SolverList {
 public:
  /// `shared_bytes`: size of the part of each block's shared memory that the solver may use; it begins at the start.
  GEM_DEVICE SolverList(const DeviceScene& s, Group& group, std::int32_t step, std::size_t shared_bytes)
      : s_(s), group_(group), step_(step), shared_bytes_(shared_bytes) {}

  /// Makes the list for a later launch with the same number of blocks, each with `shared_bytes` of shared memory. This
  /// launch needs none.
  GEM_DEVICE void make_ahead() {
    make();
    if (group_.thread() == 0) s_.solver_workspace[group_.block()] = group_.shared().workspace;
  }
  /// Loads the list that an earlier launch made.
  GEM_DEVICE void load() {
    SolverWorkspace workspace = s_.solver_workspace[group_.block()];
    place_entries(workspace);
    place_points(workspace);
    use_shared_memory(workspace);
    if (group_.thread() == 0) group_.shared().workspace = workspace;
    if (!workspace.motion) return group_.block_barrier();
    for (std::int32_t e = workspace.own.begin + group_.thread(); e < workspace.own.end; e += group_.threads())
      workspace.motion[e] = {};  // no additions yet
    list_in_order(workspace);
  }

  /// Makes the list: the block's range of the bodies with points, the records of their points, and the points that the
  /// block iterates.
  GEM_DEVICE void make() {
    SolverWorkspace workspace{};
    workspace.pace = {static_cast<float>(s_.constants.dt), static_cast<float>(1.0 / s_.constants.dt)};
    const std::int32_t words = bit_words(s_);
    const std::int64_t own_words = static_cast<std::int64_t>(group_.block()) * (words + 1);
    std::int32_t *const bodies = s_.bodies_before + own_words, *const sorted_places = s_.sorted_before + own_words;
    BlockCell& shared = group_.shared();
    if (group_.thread() == 0) shared.records = shared.taken = 0;
    constexpr int warp = Group::Warp::size;
    const int warps = group_.threads() / warp;
    for (int k = group_.thread() / warp; k < 2; k += warps)
      count_marks(group_.warp(), k == 0 ? s_.touched_bodies : s_.touched_sorted, k == 0 ? bodies : sorted_places,
                  words);
    group_.block_barrier();
    workspace.bodies = sorted_places[words];
    workspace.own = workspace.moved = own_ = stretch_of(group_, workspace.bodies);
    for (std::int32_t sorted_place = group_.thread(); sorted_place < s_.bodies; sorted_place += group_.threads()) {
      const std::uint32_t bits = s_.touched_sorted[sorted_place / 32], bit = 1U << (sorted_place % 32);
      const std::int32_t at = sorted_places[sorted_place / 32] + bits_in(bits & (bit - 1U));
      if ((bits & bit) && at >= own_.begin && at < own_.end) s_.solver_entry[at].body = s_.body_at[sorted_place];
    }
    group_.block_barrier();
    place_entries(workspace);
    // the platform comes first in sorted order and has a long row: the last warp does it alone
    const bool platform = workspace.platform = own_.begin == 0 && own_.end > 0 && (s_.touched_sorted[0] & 1U);
    const bool alone = group_.threads() <= Group::Warp::size;
    const int rest = platform && !alone ? group_.threads() - Group::Warp::size : group_.threads();
    if (platform && (alone || group_.thread() >= rest)) list_points(group_.warp(), workspace, own_.begin, bodies);
    if (group_.thread() < rest) {
      const int lane_group = group_.thread() / Group::Lanes::size, lane_groups = rest / Group::Lanes::size;
      for (std::int32_t e = own_.begin + (platform ? 1 : 0) + lane_group; e < own_.end; e += lane_groups)
        list_points(group_.lanes(), workspace, e, bodies);
    }
    group_.block_barrier();
    if (group_.thread() == 0) shared.first_taken = group_.add(&s_.counters->taken_points, shared.taken);
    group_.block_barrier();
    workspace.points = {shared.first_taken, shared.first_taken + shared.taken};
    workspace.records = records_begin_ + shared.records;
    place_points(workspace);
    if (group_.thread() == 0) shared.workspace = workspace;
    for (std::int32_t e = own_.begin + group_.thread(); e < own_.end; e += group_.threads()) {
      const TakenPoints taken = s_.taken_of[e];
      GEM_NO_UNROLL
      for (std::int32_t k = 0; k < taken.count; ++k)
        s_.taken[shared.first_taken + taken.first + k] = s_.taken_in_row[workspace.entry[e].place + k];
    }
    group_.block_barrier();
  }

 private:
  /// Shared memory for motions, records and points [bytes].
  GEM_DEVICE std::size_t bytes_before_entries(const SolverWorkspace& workspace) const {
    return workspace.fits ? (shared_bytes_ - workspace.own.count() * sizeof(SolverEntry)) / alignof(SolverEntry) *
                                alignof(SolverEntry)
                          : shared_bytes_;
  }

  /// Leaves the points that do not fit in registers in the scene's memory.
  GEM_DEVICE void place_points(SolverWorkspace& workspace) const {
    const std::int32_t kept = Group::kept_points * group_.threads(),
                       first =
                           workspace.points.begin + (kept < workspace.points.count() ? kept : workspace.points.count());
    workspace.shared_points = {first, first};
    workspace.shared_points_offset = 0;
  }

  /// Leaves entries and motions in the scene's memory. Sets `fits` if shared memory can hold those of the block while
  /// it iterates.
  GEM_DEVICE void place_entries(SolverWorkspace& workspace) {
    static_assert(sizeof(AddedMotion) == sizeof(PushRecord));
    const std::int32_t count = workspace.own.count();
    workspace.entry = workspace.moved_entry = s_.solver_entry;
    workspace.motion = nullptr;
    workspace.in_order = false;
    workspace.stage_bytes = Group::reads_other_blocks ? 0 : shared_bytes_;
    workspace.fits = Group::reads_other_blocks &&
                     count * (sizeof(SolverEntry) + sizeof(AddedMotion)) + alignof(SolverEntry) <= shared_bytes_;
    records_begin_ = workspace.fits ? count : 0;
    records_end_ = static_cast<std::int32_t>(bytes_before_entries(workspace) / sizeof(PushRecord));
  }

  /// Moves entries and motions to shared memory if they fit. Points take what the records leave.
  GEM_DEVICE void use_shared_memory(SolverWorkspace& workspace) const {
    if (!Group::reads_other_blocks) return;
    const std::size_t bytes = bytes_before_entries(workspace),
                      taken = (workspace.records * sizeof(PushRecord) + sizeof(FloatQuad) - 1) / sizeof(FloatQuad) *
                              sizeof(FloatQuad);
    if (workspace.fits) {
      workspace.entry = workspace.moved_entry =
          reinterpret_cast<SolverEntry*>(group_.shared_memory() + bytes) - workspace.own.begin;
      workspace.motion = reinterpret_cast<AddedMotion*>(group_.shared_memory()) - workspace.own.begin;
    }
    if (taken >= bytes) return;
    const std::int32_t left = workspace.points.end - workspace.shared_points.begin;
    const auto fit = static_cast<std::int32_t>((bytes - taken) / loaded_bytes);
    workspace.shared_points.end += left < fit ? left : fit;
    workspace.shared_points_offset = taken;
  }

  /// Sort key of a body: longest rows first.
  static std::int32_t GEM_DEVICE kind_of(const SolverEntry& entry) {
    const std::int32_t most = part_lengths - 1, as_a = entry.count - entry.as_b;
    return part_lengths * (most - (entry.as_b < most ? entry.as_b : most)) + most - (as_a < most ? as_a : most);
  }

  /// Sorts the entries by row length, so that neighbouring threads have equal work. The platform stays first: it has
  /// threads of its own. Only the iterations use this order; ranks come from the scene's list.
  GEM_DEVICE void list_in_order(const SolverWorkspace& workspace) {
    BlockCell& shared = group_.shared();
    for (std::int32_t k = group_.thread(); k < row_kinds; k += group_.threads()) shared.of_kind[k] = 0;
    group_.block_barrier();
    const std::int32_t first = workspace.own.begin + (workspace.platform ? 1 : 0);
    for (std::int32_t e = first + group_.thread(); e < workspace.own.end; e += group_.threads())
      group_.add(&shared.of_kind[kind_of(s_.solver_entry[e])], 1);
    group_.block_barrier();
    if (group_.thread() < Group::Warp::size) {
      const auto warp = group_.warp();
      std::int32_t sum = first;
      for (std::int32_t k = warp.rank(); k < row_kinds; k += Group::Warp::size) {
        const std::int32_t mine = shared.of_kind[k];
        shared.of_kind[k] = sum + warp.sum_below(mine);
        sum += warp.sum(mine);
      }
    }
    group_.block_barrier();
    for (std::int32_t e = workspace.own.begin + group_.thread(); e < workspace.own.end; e += group_.threads()) {
      SolverEntry entry = s_.solver_entry[e];
      entry.rank = e;
      workspace.entry[e < first ? e : group_.add(&shared.of_kind[kind_of(entry)], 1)] = entry;
    }
    if (group_.thread() == 0) shared.workspace.in_order = true;
    group_.block_barrier();
  }

  /// Takes shared memory for `count` records of a body. Returns the index of the first, -1 if they do not fit.
  GEM_DEVICE std::int32_t take_records(std::int32_t count) {
    if (!Group::reads_other_blocks) return -1;
    const std::int32_t at = records_begin_ + group_.add(&group_.shared().records, count);
    return at + count <= records_end_ ? at : -1;
  }

  static_assert(solve_shared_bytes / sizeof(PushRecord) <= 0xffff);
  GEM_DEVICE static std::int32_t memory_place(int block, std::int32_t at) { return block << 16 | at; }

  /// Whether the block of `body` iterates its points with `other`. Body A takes the points of two floes. The other body
  /// takes those of a large body, so the platform's points are spread over its floes.
  GEM_DEVICE bool takes(std::int32_t body, std::int32_t other, bool as_b) const {
    return is_non_floe(s_, other) || (!as_b && body != 0);
  }

  /// Some entries of a row, one for each step of a lane. They are loaded together to hide the latency of memory.
  struct PlacesOfLane {
    static constexpr int steps = 4;
    RowPoints points[steps];
    bool takes[steps];
  };

  template <class LaneGroupType>
  GEM_DEVICE PlacesOfLane read_places(const LaneGroupType& lanes, std::int32_t body, const BodyMotion& motion,
                                      std::int32_t first) const {
    const std::int32_t begin = motion.row_begin, lower = motion.lower_count, places = s_.row_length(body, motion);
    PlacesOfLane read;
    std::int32_t stamp[PlacesOfLane::steps], other[PlacesOfLane::steps];
    for (int k = 0; k < PlacesOfLane::steps; ++k) {
      const std::int32_t at = first + k * LaneGroupType::size + lanes.rank(), row = begin + at;
      const bool there = at < places;
      stamp[k] = there ? s_.stamp[row].entry : step_ - 1;
      other[k] = there ? s_.row_other[row] : 0;
      read.points[k] = there ? s_.row_points[row] : RowPoints{};
    }
    for (int k = 0; k < PlacesOfLane::steps; ++k) {
      const std::int32_t at = first + k * LaneGroupType::size + lanes.rank();
      if (stamp[k] != step_) read.points[k] = {};
      read.takes[k] = read.points[k].count > 0 && takes(body, other[k], at < lower);
    }
    return read;
  }

  /// Reads the row of a body by a group of lanes and assigns a record to each point.
  template <class LaneGroupType>
  GEM_DEVICE void list_points(const LaneGroupType& lanes, const SolverWorkspace& workspace, std::int32_t e,
                              const std::int32_t* bodies_before) {
    constexpr int stride = PlacesOfLane::steps * LaneGroupType::size;
    const std::int32_t body = s_.solver_entry[e].body;
    const BodyMotion& motion = s_.motion[body];
    const std::int32_t begin = motion.row_begin, lower = motion.lower_count, places = s_.row_length(body, motion);
    std::int32_t count = 0, as_b = 0, taken = 0;
    PlacesOfLane read{};
    for (std::int32_t first = 0; first < places; first += stride) {
      read = read_places(lanes, body, motion, first);
      for (int k = 0; k < PlacesOfLane::steps; ++k) {
        const std::int32_t points = read.points[k].count;
        count += points;
        as_b += first + k * LaneGroupType::size + lanes.rank() < lower ? points : 0;
        taken += read.takes[k] ? points : 0;
      }
    }
    count = lanes.sum(count);
    as_b = lanes.sum(as_b);
    taken = lanes.sum(taken);
    std::int32_t first_record = lanes.rank() == 0 ? take_records(count) : 0;
    first_record = lanes.from(first_record, 0);
    const std::int32_t moved_at = Group::has_halos ? e
                                  : workspace.fits ? memory_place(group_.block(), e - own_.begin)
                                                   : -1;
    std::int32_t before = 0, taken_before = 0;
    for (std::int32_t first = 0; first < places; first += stride) {
      if (places > stride) read = read_places(lanes, body, motion, first);
      for (int step = 0; step < PlacesOfLane::steps; ++step) {
        if (first + step * LaneGroupType::size >= places) break;
        const bool is_b = first + step * LaneGroupType::size + lanes.rank() < lower;
        const RowPoints points = read.points[step];
        const std::int32_t mine = before + lanes.sum_below(points.count);
        const std::int32_t to = taken_before + lanes.sum_below(read.takes[step] ? points.count : 0);
        GEM_NO_UNROLL
        for (std::int32_t k = 0; k < points.count; ++k) {
          PointCell& point = s_.point[points.first + k];
          const std::int32_t shared_record =
              first_record < 0 ? -1 : memory_place(group_.block(), first_record + mine + k);
          (is_b ? point.b : point.a) = {body, 2 * begin + mine + k, shared_record, moved_at};
          if (read.takes[step]) s_.taken_in_row[2 * begin + to + k] = points.first + k;
        }
        before += lanes.sum(points.count);
        taken_before += lanes.sum(read.takes[step] ? points.count : 0);
      }
    }
    if (lanes.rank() != 0) return;
    const BodyCell& cell = s_.body[body];
    const std::uint32_t below = s_.touched_bodies[body / 32] & ((1U << (body % 32)) - 1U);
    workspace.entry[e] = {body,
                          2 * begin,
                          first_record,
                          as_b,
                          count,
                          static_cast<float>(cell.inverse_mass),
                          static_cast<float>(cell.inverse_inertia),
                          bodies_before[body / 32] + bits_in(below)};
    s_.body_points[body] = {step_, count};
    s_.taken_of[e] = {taken > 0 ? group_.add(&group_.shared().taken, taken) : 0, taken};
    s_.added[body] = {};
  }

  const DeviceScene& s_;
  Group& group_;
  std::int32_t step_;
  std::size_t shared_bytes_;
  Stretch own_{};
  std::int32_t records_begin_ = 0, records_end_ = 0;  // in the block's shared memory
};

}  // namespace gem
