// The halo of a block: all bodies that its points meet, copied to its shared memory with the rows of their records. The
// block moves these bodies itself, even if other blocks move them too. This pays where blocks reach each other only
// through global memory. An iteration then waits only for the records that the block needs, not for two grid barriers.
#pragma once

#include "gem/engine/solver/device/device_solver_list.h"

namespace gem {

/// Allocates from the end of a block's shared memory. The rest stays free.
class TailAllocator {
 public:
  GEM_DEVICE TailAllocator(std::byte* shared_memory, std::size_t bytes) : shared_memory_(shared_memory), left_(bytes) {}

  /// Takes `count` elements. The caller has checked with holds() that they fit.
  template <class T>
  GEM_DEVICE T* take(std::int32_t count) {
    left_ = (left_ - count * sizeof(T)) / alignment * alignment;
    return reinterpret_cast<T*>(shared_memory_ + left_);
  }
  GEM_DEVICE bool holds(std::size_t bytes) const { return bytes <= left_; }
  /// Most bytes that `count` elements take.
  template <class T>
  GEM_DEVICE static std::size_t bytes_of(std::int32_t count) {
    return count * sizeof(T) + alignment;
  }

 private:
  static constexpr std::size_t alignment = 16;
  std::byte* shared_memory_;
  std::size_t left_;
};

template <class Group>
class SolverHalo {
 public:
  GEM_DEVICE SolverHalo(const DeviceScene& s, Group& group, std::size_t shared_bytes)
      : s_(s), group_(group), tail_(group.shared_memory(), shared_bytes) {}

  /// Finds the bodies of the halo and their records. Call it when all blocks have listed their bodies and this one its
  /// points. If shared memory is too small for one block, no block has a halo in this time step.
  GEM_DEVICE void make() {
    if (!find() && group_.thread() == 0) group_.set_bit(&s_.counters->halo_overflow, 1U);
  }

  /// Makes the halo the set of bodies that the block moves, if all blocks could make theirs. Call it after a grid
  /// barrier.
  GEM_DEVICE void activate() {
    if (s_.counters->halo_overflow != 0) return;
    if (group_.thread() == 0) {
      SolverWorkspace& workspace = group_.shared().workspace;
      workspace.has_halo = true;
      workspace.moved = {0, workspace.halo.bodies};
      workspace.moved_entry = workspace.halo.entry;
      workspace.motion = workspace.halo.motion;
      workspace.platform = workspace.halo.bodies > 0 && workspace.halo.entry[0].body == 0;
    }
    group_.block_barrier();
  }

 private:
  /// Calls work(side) for the moving bodies of the thread's points.
  template <class Work>
  GEM_DEVICE void each_side(Work&& work) {
    each_point(group_, [&](std::int32_t i) {
      if (s_.taken_point[i].a.place >= 0) work(s_.taken_point[i].a);
      if (s_.taken_point[i].b.place >= 0) work(s_.taken_point[i].b);
    });
  }

  /// Marks the entries that the points meet, to give each one index, in their order. The platform comes first. The
  /// marks use the memory of the later records.
  GEM_DEVICE bool find() {
    const std::int32_t words = (group_.shared().workspace.bodies + 31) / 32;
    const std::size_t marks = (2 * words + 1) * sizeof(std::uint32_t);
    if (!tail_.holds(marks)) return false;
    auto* const met = reinterpret_cast<std::uint32_t*>(group_.shared_memory());
    auto* const before = reinterpret_cast<std::int32_t*>(met + words);
    for (std::int32_t w = group_.thread(); w < words; w += group_.threads()) met[w] = 0;
    if (group_.thread() == 0) group_.shared().records = 0;
    group_.block_barrier();
    each_side([&](const PointSide& side) { group_.set_bit(&met[side.motion / 32], 1U << (side.motion % 32)); });
    group_.block_barrier();
    if (group_.thread() < Group::Warp::size) count_marks(group_.warp(), met, before, words);
    group_.block_barrier();
    HaloWorkspace halo{};
    halo.bodies = before[words];
    if (!tail_.holds(marks + tail_.bytes_of<SolverEntry>(halo.bodies) + tail_.bytes_of<AddedMotion>(halo.bodies)))
      return false;
    halo.entry = tail_.take<SolverEntry>(halo.bodies);
    halo.motion = tail_.take<AddedMotion>(halo.bodies);
    each_side([&](PointSide& side) {
      side.motion = before[side.motion / 32] + bits_in(met[side.motion / 32] & ((1U << (side.motion % 32)) - 1U));
    });
    for (std::int32_t w = group_.thread(); w < words; w += group_.threads()) {
      std::int32_t k = before[w];
      for (std::uint32_t bits = met[w]; bits != 0; bits &= bits - 1U)
        halo.entry[k++].rank = 32 * w + bits_in(~bits & (bits - 1U));
    }
    group_.block_barrier();
    return copy(halo);
  }

  /// Copies the entries of the halo; until then `rank` holds the index in the scene's list. Lists the source of each
  /// record. The rows follow each other from the start of shared memory.
  GEM_DEVICE bool copy(HaloWorkspace halo) {
    for (std::int32_t k = group_.thread(); k < halo.bodies; k += group_.threads()) {
      SolverEntry entry = s_.solver_entry[halo.entry[k].rank];
      entry.shared_record = group_.add(&group_.shared().records, entry.count);
      halo.entry[k] = entry;
      halo.motion[k] = {};  // no additions yet
    }
    group_.block_barrier();
    halo.records = group_.shared().records;
    if (!tail_.holds(tail_.bytes_of<std::int32_t>(halo.records) + halo.records * sizeof(PushRecord))) return false;
    halo.source = tail_.take<std::int32_t>(halo.records);
    const auto lanes = group_.lanes();
    constexpr int size = Group::Lanes::size;
    for (std::int32_t k = group_.thread() / size; k < halo.bodies; k += group_.threads() / size) {
      const SolverEntry& entry = halo.entry[k];
      for (std::int32_t j = lanes.rank(); j < entry.count; j += size)
        halo.source[entry.shared_record + j] = entry.place + j;
    }
    if (group_.thread() == 0) group_.shared().workspace.halo = halo;
    group_.block_barrier();
    return true;
  }

  const DeviceScene& s_;
  Group& group_;
  TailAllocator tail_;
};

}  // namespace gem
