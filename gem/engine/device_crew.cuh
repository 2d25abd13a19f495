// The crew of a CUDA kernel: the threads of one cluster of blocks.
#pragma once

#include <cooperative_groups.h>

#include "gem/engine/crew.h"

namespace gem {

/// `lanes` neighbouring threads of a warp.
template <int lanes>
class LaneGroup {
 public:
  static constexpr int size = lanes;

  __device__ int rank() const { return static_cast<int>(threadIdx.x) % lanes; }
  __device__ unsigned ballot(bool mine) const { return __ballot_sync(mask(), mine) >> first() & ones; }
  template <class T>
  __device__ T from(const T& mine, int lane) const {
    return exchange(mine, [&](unsigned word) { return __shfl_sync(mask(), word, lane, lanes); });
  }
  template <class T>
  __device__ T partner(const T& mine, int step) const {
    return exchange(mine, [&](unsigned word) { return __shfl_xor_sync(mask(), word, step, lanes); });
  }
  __device__ void sync() const { __syncwarp(mask()); }
  __device__ int count(unsigned bits) const { return __popc(bits); }
  __device__ int count_below(unsigned bits) const { return __popc(bits & ((1U << rank()) - 1U)); }

 private:
  static constexpr unsigned ones = lanes == 32 ? 0xffffffffU : (1U << (lanes % 32)) - 1U;

  __device__ int first() const { return static_cast<int>(threadIdx.x) % 32 / lanes * lanes; }
  __device__ unsigned mask() const { return ones << first(); }

  /// Word by word; T is a plain value.
  template <class T, class Shuffle>
  __device__ T exchange(const T& mine, Shuffle&& shuffle) const {
    static_assert(sizeof(T) % sizeof(unsigned) == 0);
    constexpr int words = sizeof(T) / sizeof(unsigned);
    unsigned out[words], in[words];
    memcpy(out, &mine, sizeof(T));
#pragma unroll
    for (int w = 0; w < words; ++w) in[w] = shuffle(out[w]);
    T result;
    memcpy(&result, in, sizeof(T));
    return result;
  }
};

/// All threads of a cluster; a launch without clusters has clusters of one block.
class ClusterCrew {
 public:
  using Lanes = LaneGroup<8>;
  using Warp = LaneGroup<32>;

  __device__ explicit ClusterCrew(BlockCell& shared) : shared_(shared) {}

  __device__ int block() const { return static_cast<int>(cluster().block_rank()); }
  __device__ int blocks() const { return static_cast<int>(cluster().num_blocks()); }
  __device__ int thread() const { return static_cast<int>(threadIdx.x); }
  __device__ int threads() const { return static_cast<int>(blockDim.x); }
  __device__ Lanes lanes() const { return {}; }
  __device__ Warp warp() const { return {}; }
  /// A warp that had parted comes together first: the barrier counts warps.
  __device__ void barrier() {
    if (blocks() == 1) {
      __syncthreads();
      return;
    }
    __syncwarp();
    asm volatile("barrier.cluster.arrive.release.aligned;\n\tbarrier.cluster.wait.acquire.aligned;" ::: "memory");
  }
  __device__ void block_barrier() { __syncthreads(); }
  __device__ BlockCell& shared() { return shared_; }

  /// Every block has its own copy of the alarms, so that a look at them costs next to nothing.
  __device__ void raise(std::uint32_t alarms) {
    for (int k = 0; k < blocks(); ++k) atomicOr(cluster().map_shared_rank(&shared_.alarms, k), alarms);
  }
  __device__ std::uint32_t alarms() const { return *static_cast<const volatile std::uint32_t*>(&shared_.alarms); }
  __device__ void lower_alarms() {
    if (threadIdx.x == 0) shared_.alarms = 0;
  }

  __device__ static std::int32_t add(std::int32_t* sum, std::int32_t value) { return atomicAdd(sum, value); }
  __device__ static void highest(std::uint64_t* value, std::uint64_t other) {
    static_assert(sizeof(std::uint64_t) == sizeof(unsigned long long));
    atomicMax(reinterpret_cast<unsigned long long*>(value), static_cast<unsigned long long>(other));
  }
  __device__ static void set_bit(std::uint32_t* word, std::uint32_t bit) { atomicOr(word, bit); }

 private:
  __device__ static cooperative_groups::cluster_group cluster() { return cooperative_groups::this_cluster(); }

  BlockCell& shared_;
};

}  // namespace gem
