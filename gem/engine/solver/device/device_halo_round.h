// One iteration of a block with a halo: waits for the records of other blocks and adds them up to motions. The work of
// a thread is the same in every iteration, so its addresses stay in registers.
#pragma once

#include "gem/engine/solver/device/device_moves.h"

namespace gem {

/// Copies the records of the halo bodies to shared memory. The unit of copying is half a record. A thread copies the
/// same halves in every iteration.
template <class Group>
class HaloRecords {
 public:
  GEM_DEVICE HaloRecords(const DeviceScene& s, Group& group, const SolverWorkspace& workspace)
      : all_(reinterpret_cast<const NumberedHalf*>(s.push_base)),
        shared_memory_(reinterpret_cast<float*>(group.shared_memory())),
        source_(workspace.halo.source),
        turn_(2 * s.push_capacity),
        halves_(2 * workspace.halo.records),
        thread_(group.thread()),
        threads_(group.threads()) {
    for (int k = 0; k < kept; ++k) from_[k] = thread_ < halves_ ? from(thread_ + k * threads_) : 0;
  }

  /// Copies the records of iteration `number` as soon as they have been written.
  GEM_DEVICE GEM_INLINE void fetch(std::uint32_t number) const {
    if (thread_ >= halves_) return;
    if (halves_ <= 2 * threads_)
      fetch_some<2>(number, from_, thread_);
    else
      fetch_some<kept>(number, from_, thread_);
    GEM_NO_UNROLL
    for (std::int32_t first = thread_ + kept * threads_; first < halves_; first += kept * threads_) {
      std::int32_t more[kept];
      for (int k = 0; k < kept; ++k) more[k] = from(first + k * threads_);
      fetch_some<kept>(number, more, first);
    }
  }

 private:
  /// Halves per thread whose addresses stay in registers.
  static constexpr int kept = 4;
  static constexpr int parts = 3;

  /// Index of a half in the scene's records. Beyond the last half it is the index of the thread's first, so that every
  /// load is valid.
  GEM_DEVICE GEM_INLINE std::int32_t from(std::int32_t half) const {
    const std::int32_t k = half < halves_ ? half : thread_;
    return 2 * source_[k / 2] + k % 2;
  }

  /// Loads all halves together, and again until all have the right number. Each record must have a point that writes it
  /// in this round: otherwise the wait does not end.
  template <int together>
  GEM_DEVICE GEM_INLINE void fetch_some(std::uint32_t number, const std::int32_t* from, std::int32_t first) const {
    const NumberedHalf* const all = all_ + turn_ * static_cast<std::int32_t>(number % 2);
    NumberedHalf some[together];
    for (;;) {
      for (int k = 0; k < together; ++k) some[k] = Group::read_whole(all + from[k]);
      bool there = true;
      for (int k = 0; k < together; ++k) there &= some[k].number == number;
      if (there) break;
      Group::pause();
    }
    for (int k = 0; k < together; ++k)
      if (const std::int32_t half = first + k * threads_; half < halves_)
        for (int c = 0; c < parts; ++c) shared_memory_[parts * half + c] = some[k].part[c];
  }

  const NumberedHalf* all_;
  float* shared_memory_;
  const std::int32_t* source_;
  std::int32_t turn_;  // halves between the records of two successive iterations
  std::int32_t halves_, thread_, threads_;
  std::int32_t from_[kept];
};

/// As SolverMoves, but from rows in shared memory. One thread adds up each pair of numbers of a body.
template <class Group>
class HaloMoves {
 public:
  GEM_DEVICE HaloMoves(const DeviceScene& s, Group& group, const SolverWorkspace& workspace)
      : s_(s), group_(group), workspace_(workspace), end_(motion_pairs * workspace.moved.end) {
    constexpr int warp = Group::Warp::size;
    const bool alone = group.threads() <= warp;
    threads_ = workspace.platform && !alone ? group.threads() - warp : group.threads();
    moves_platform_ = workspace.platform && (alone || group.thread() >= threads_);
    first_ = group.thread() < threads_ ? group.thread() + (workspace.platform ? motion_pairs : 0) : end_;
    if (first_ < end_) own_ = row_of(first_);
  }

  GEM_DEVICE GEM_INLINE void move() const {
    if (moves_platform_) SolverMoves<Group>::move_platform(s_, group_, workspace_);
    if (first_ < end_) sum(own_);
    GEM_NO_UNROLL
    for (std::int32_t k = first_ + threads_; k < end_; k += threads_) sum(row_of(k));
  }

 private:
  /// One pair of numbers in the records of a body, and where the result goes.
  struct Row {
    const PushRecord* record;
    FloatPair* motion;
    std::int32_t pair, as_b, count;
    float answer;
  };
  GEM_DEVICE GEM_INLINE Row row_of(std::int32_t k) const {
    const int pair = k % motion_pairs;
    const SolverEntry& entry = workspace_.moved_entry[k / motion_pairs];
    return {reinterpret_cast<const PushRecord*>(group_.shared_memory()) + entry.shared_record,
            &workspace_.motion[k / motion_pairs].pair[pair],
            pair,
            entry.as_b,
            entry.count,
            pair < motion_pairs - 1 ? entry.inverse_mass : entry.inverse_inertia};
  }

  GEM_DEVICE GEM_INLINE static void sum(const Row& row) {
    const auto moved = SolverMoves<Group>::template sum_at_once<1, 4>(row.record, row.as_b, row.count, row.pair);
    const FloatPair& by = moved.pair[0];
    *row.motion = {{row.answer * by.part[0], row.answer * by.part[1]}};
  }

  const DeviceScene& s_;
  Group& group_;
  const SolverWorkspace& workspace_;
  std::int32_t end_, first_ = 0;
  int threads_ = 0;
  bool moves_platform_ = false;
  Row own_{};
};

}  // namespace gem
