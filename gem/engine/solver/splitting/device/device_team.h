// The threads that work on one island: those of a block, or those of a warp. Also what they share, and sums over them.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gem/engine/device/thread_group.h"
#include "gem/engine/solver/splitting/factor/dissection_rules.h"
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

// A team has rank(), size() and sync(), and parts: its blocks, which meet sooner than all of it. A part has warps.

/// Threads of a block.
template <class Group>
class BlockTeam {
 public:
  using Atomics = Group;
  using Warp = typename Group::Warp;
  using Part = BlockTeam;
  GEM_DEVICE explicit BlockTeam(Group& group) : group_(group) {}
  GEM_DEVICE int rank() const { return group_.thread(); }
  GEM_DEVICE int size() const { return group_.threads(); }
  GEM_DEVICE void sync() const { group_.block_barrier(); }
  GEM_DEVICE Part part() const { return *this; }
  GEM_DEVICE int part_index() const { return 0; }
  GEM_DEVICE int parts() const { return 1; }
  GEM_DEVICE Warp warp() const { return group_.warp(); }
  GEM_DEVICE int warp_index() const { return group_.thread() / Warp::size; }
  GEM_DEVICE int warps() const { return group_.threads() / Warp::size; }

 private:
  Group& group_;
};

/// Threads of all blocks of a group.
template <class Group>
class GroupTeam {
 public:
  using Atomics = Group;
  using Warp = typename Group::Warp;
  using Part = BlockTeam<Group>;
  GEM_DEVICE explicit GroupTeam(Group& group) : group_(group) {}
  GEM_DEVICE int rank() const { return group_.block() * group_.threads() + group_.thread(); }
  GEM_DEVICE int size() const { return group_.blocks() * group_.threads(); }
  GEM_DEVICE void sync() const { group_.barrier(); }
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
  using Warp = typename Group::Warp;
  using Part = WarpTeam;
  GEM_DEVICE explicit WarpTeam(Group& group) : group_(group), warp_(group.warp()) {}
  GEM_DEVICE int rank() const { return warp_.rank(); }
  GEM_DEVICE int size() const { return Warp::size; }
  GEM_DEVICE void sync() const { warp_.sync(); }
  GEM_DEVICE Part part() const { return *this; }
  GEM_DEVICE int part_index() const { return 0; }
  GEM_DEVICE int parts() const { return 1; }
  GEM_DEVICE Warp warp() const { return warp_; }
  GEM_DEVICE int warp_index() const { return 0; }
  GEM_DEVICE int warps() const { return 1; }

 private:
  Group& group_;
  Warp warp_;
};

/// What the threads of a block or of a warp work with, in shared memory. Only a large island has its cell in the
/// scene's memory, since all blocks of a group read it.
struct TeamMemory {
  IslandCell* cell;
  PartCell* part;
  CutCell* cut;         // of each warp
  std::int32_t* count;  // TeamMemory::counts for each thread
  float* scratch;
  std::int32_t scratch_size;  // numbers

  static constexpr int counts = 5;
  /// Numbers to invert blocks of fronts in, of a block.
  static constexpr std::size_t scratch_numbers = 24 * 1024;
  template <class T>
  GEM_HD static constexpr std::size_t whole(std::size_t count) {
    return (count * sizeof(T) + 15) / 16 * 16;
  }
  /// Bytes of shared memory for a block of `warps` warps of `size` threads.
  GEM_HD static constexpr std::size_t bytes(int warps, int size) {
    const auto n = static_cast<std::size_t>(warps);
    return n * (whole<IslandCell>(1) + whole<PartCell>(1) + whole<CutCell>(1) +
                whole<std::int32_t>(counts * static_cast<std::size_t>(size))) +
           whole<float>(scratch_numbers);
  }
  /// The memory from warp `warp` on of a block of `warps` warps of `size` threads. `all`: of the whole block.
  GEM_DEVICE static TeamMemory of(std::byte* from, int warp, int warps, int size, bool all) {
    const std::size_t n = warps, k = warp;
    TeamMemory memory;
    memory.cell = reinterpret_cast<IslandCell*>(from + k * whole<IslandCell>(1));
    from += n * whole<IslandCell>(1);
    memory.part = reinterpret_cast<PartCell*>(from + k * whole<PartCell>(1));
    from += n * whole<PartCell>(1);
    memory.cut = reinterpret_cast<CutCell*>(from + k * whole<CutCell>(1));
    from += n * whole<CutCell>(1);
    const std::size_t count_bytes = whole<std::int32_t>(counts * static_cast<std::size_t>(size));
    memory.count = reinterpret_cast<std::int32_t*>(from + k * count_bytes);
    from += n * count_bytes;
    const std::size_t each = all ? scratch_numbers : scratch_numbers / n;
    memory.scratch = reinterpret_cast<float*>(from) + k * each;
    memory.scratch_size = static_cast<std::int32_t>(each);
    return memory;
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

/// Some numbers of each thread, added.
struct TeamCount {
  std::int32_t part[TeamMemory::counts] = {};
};
struct TeamSums {
  TeamCount below, all;  // over lower threads, over all
};
/// Sums of the first `used` numbers over the threads of a team. All threads have to call it.
template <int used, class Team>
GEM_DEVICE inline TeamSums sum_over(const Team& team, std::int32_t* count, const TeamCount& mine) {
  for (int c = 0; c < used; ++c) count[used * team.rank() + c] = mine.part[c];
  team.sync();
  TeamSums sums;
  for (int k = 0; k < team.size(); ++k)
    for (int c = 0; c < used; ++c) {
      const std::int32_t some = count[used * k + c];
      if (k < team.rank()) sums.below.part[c] += some;
      sums.all.part[c] += some;
    }
  team.sync();
  return sums;
}

}  // namespace gem
