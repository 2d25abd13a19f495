// The threads that work on one island: those of a block, or those of a warp. Also what they share, and sums over them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gem/engine/device/thread_group.h"
#include "gem/engine/solver/splitting/dissection_rules.h"
#include "gem/engine/solver/splitting/island_view.h"

namespace gem {

constexpr std::int32_t cut_bins = CutStrips::bins;

/// A cut across one axis; as Dissection::Cut.
struct IslandCut {
  std::int32_t axis = -1, bin = 0, separator_below = 0;
  double cost = 0.0;
};

/// What the threads share that cut a part.
struct CutCell {
  std::uint64_t extreme[4];  // ordered bits of the largest -x, -y, x, y
  std::int32_t count[2][cut_bins + 2], change_below[2][cut_bins + 2], change_above[2][cut_bins + 2];  // by axis
  IslandCut best[2][2];  // by axis; balanced, then any
  std::int32_t child;
};

// A team has rank(), size() and sync(), groups of lanes, and parts: its blocks, which meet sooner than all of it.

/// Threads of a block.
template <class Group>
class BlockTeam {
 public:
  using Atomics = Group;
  using Lanes = typename Group::Lanes;
  using Part = BlockTeam;
  GEM_DEVICE explicit BlockTeam(Group& group) : group_(group) {}
  GEM_DEVICE int rank() const { return group_.thread(); }
  GEM_DEVICE int size() const { return group_.threads(); }
  GEM_DEVICE void sync() const { group_.block_barrier(); }
  GEM_DEVICE Lanes lanes() const { return group_.lanes(); }
  GEM_DEVICE Part part() const { return *this; }
  GEM_DEVICE int part_index() const { return 0; }
  GEM_DEVICE int parts() const { return 1; }

 private:
  Group& group_;
};

/// Threads of all blocks of a group.
template <class Group>
class GroupTeam {
 public:
  using Atomics = Group;
  using Lanes = typename Group::Lanes;
  using Part = BlockTeam<Group>;
  GEM_DEVICE explicit GroupTeam(Group& group) : group_(group) {}
  GEM_DEVICE int rank() const { return group_.block() * group_.threads() + group_.thread(); }
  GEM_DEVICE int size() const { return group_.blocks() * group_.threads(); }
  GEM_DEVICE void sync() const { group_.barrier(); }
  GEM_DEVICE Lanes lanes() const { return group_.lanes(); }
  GEM_DEVICE Part part() const { return Part(group_); }
  GEM_DEVICE int part_index() const { return group_.block(); }
  GEM_DEVICE int parts() const { return group_.blocks(); }

 private:
  Group& group_;
};

/// Threads of a warp.
template <class Group>
class WarpTeam {
 public:
  using Atomics = Group;
  using Lanes = typename Group::Lanes;
  using Part = WarpTeam;
  GEM_DEVICE explicit WarpTeam(Group& group) : group_(group), warp_(group.warp()) {}
  GEM_DEVICE int rank() const { return warp_.rank(); }
  GEM_DEVICE int size() const { return Group::Warp::size; }
  GEM_DEVICE void sync() const { warp_.sync(); }
  GEM_DEVICE Lanes lanes() const { return group_.lanes(); }
  GEM_DEVICE Part part() const { return *this; }
  GEM_DEVICE int part_index() const { return 0; }
  GEM_DEVICE int parts() const { return 1; }

 private:
  Group& group_;
  typename Group::Warp warp_;
};

/// What the threads of a block or of a warp work with. A large island has its cell in the scene's memory, since all
/// blocks of a group read it; everything else is in shared memory.
struct TeamMemory {
  IslandCell* cell;
  CutCell* cut;         // of each warp
  std::int32_t* count;  // three for each thread

  /// Bytes of shared memory for a block of `warps` warps of `size` threads.
  GEM_HD static constexpr std::size_t cell_bytes() { return (sizeof(IslandCell) + 15) / 16 * 16; }
  GEM_HD static constexpr std::size_t cut_bytes() { return (sizeof(CutCell) + 15) / 16 * 16; }
  GEM_HD static constexpr std::size_t bytes(int warps, int size) {
    return static_cast<std::size_t>(warps) * cell_bytes() + static_cast<std::size_t>(warps) * cut_bytes() +
           static_cast<std::size_t>(3 * warps * size) * sizeof(std::int32_t) + 16;
  }
};

/// A share of [begin, end) without gaps, in the order of the threads.
struct TeamShare {
  std::int32_t begin, end;
};
template <class Team>
GEM_DEVICE GEM_INLINE TeamShare share_of(const Team& team, std::int32_t begin, std::int32_t end) {
  const std::int32_t each = (end - begin + team.size() - 1) / team.size();
  const std::int32_t first = begin + team.rank() * each;
  return {first < end ? first : end, first + each < end ? first + each : end};
}

/// Calls work(k) for the elements of a range that belong to the thread.
template <class Team, class Work>
GEM_DEVICE GEM_INLINE void each_of(const Team& team, std::int32_t begin, std::int32_t end, Work&& work) {
  for (std::int32_t k = begin + team.rank(); k < end; k += team.size()) work(k);
}

/// Three numbers of each thread, added.
struct TeamCount {
  std::int32_t part[3] = {};
};
struct TeamSums {
  TeamCount below, all;  // over lower threads, over all
};
/// Sums over the threads of a team. All threads have to call it.
template <class Team>
GEM_DEVICE inline TeamSums sum_over(const Team& team, std::int32_t* count, const TeamCount& mine) {
  for (int c = 0; c < 3; ++c) count[3 * team.rank() + c] = mine.part[c];
  team.sync();
  TeamSums sums;
  for (int k = 0; k < team.size(); ++k)
    for (int c = 0; c < 3; ++c) {
      const std::int32_t some = count[3 * k + c];
      if (k < team.rank()) sums.below.part[c] += some;
      sums.all.part[c] += some;
    }
  team.sync();
  return sums;
}

}  // namespace gem
