// The thread groups of CUDA kernels: their common part, and the blocks of a scene that meet at a grid barrier.
#pragma once

#include <cuda_runtime.h>

#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/device/scene.h"
#include "gem/engine/device/thread_group.h"

namespace gem {

/// `lanes` neighbouring threads of a warp.
template <int lanes>
class LaneGroup {
 public:
  static constexpr int size = lanes;

  __device__ int rank() const { return static_cast<int>(threadIdx.x) % lanes; }
  /// Groups smaller than a warp exchange their bits: votes of several groups of a warp would run one after another.
  __device__ unsigned ballot(bool mine) const {
    if constexpr (lanes == 32) return __ballot_sync(ones, mine);
    unsigned bits = mine ? 1U << rank() : 0U;
    for (int step = 1; step < lanes; step *= 2) bits |= __shfl_xor_sync(mask(), bits, step, lanes);
    return bits;
  }
  __device__ int from(int mine, int lane) const { return __shfl_sync(mask(), mine, lane, lanes); }
  __device__ float from(float mine, int lane) const { return __shfl_sync(mask(), mine, lane, lanes); }
  __device__ double from(double mine, int lane) const { return __shfl_sync(mask(), mine, lane, lanes); }
  __device__ int partner(int mine, int step) const { return __shfl_xor_sync(mask(), mine, step, lanes); }
  __device__ float partner(float mine, int step) const { return __shfl_xor_sync(mask(), mine, step, lanes); }
  __device__ double partner(double mine, int step) const { return __shfl_xor_sync(mask(), mine, step, lanes); }
  __device__ void sync() const { __syncwarp(mask()); }
  __device__ int count(unsigned bits) const { return __popc(bits); }
  __device__ int lowest(unsigned bits) const { return __ffs(static_cast<int>(bits)) - 1; }
  __device__ int sum_below(int mine) const {
    int sum = mine;
    for (int step = 1; step < lanes; step *= 2) {
      const int other = __shfl_up_sync(mask(), sum, step, lanes);
      if (rank() >= step) sum += other;
    }
    return sum - mine;
  }
  __device__ int sum(int mine) const {
    for (int step = 1; step < lanes; step *= 2) mine += partner(mine, step);
    return mine;
  }
  __device__ std::uint32_t highest(std::uint32_t mine) const { return __reduce_max_sync(mask(), mine); }
  __device__ int count_below(unsigned bits) const { return __popc(bits & ((1U << rank()) - 1U)); }

 private:
  static constexpr unsigned ones = lanes == 32 ? 0xffffffffU : (1U << (lanes % 32)) - 1U;

  __device__ int first() const { return static_cast<int>(threadIdx.x) % 32 / lanes * lanes; }
  __device__ unsigned mask() const { return ones << first(); }
};

/// Copies the scene's constants and addresses to shared memory, for all threads of a block.
__device__ inline void load_scene(DeviceScene& scene, const DeviceScene* from) {
  auto* to = reinterpret_cast<std::uint64_t*>(&scene);
  for (unsigned w = threadIdx.x; w < sizeof(DeviceScene) / sizeof(std::uint64_t); w += blockDim.x)
    to[w] = reinterpret_cast<const std::uint64_t*>(from)[w];
  __syncthreads();
}

/// The shared memory of one block.
struct BlockMemory {
  BlockCell& shared;
  std::byte* shared_memory;
  std::size_t bytes;
};

/// The common part of all thread groups.
class DeviceGroup {
 public:
  using Warp = LaneGroup<32>;
  using Wide = LaneGroup<8>;  // about as many lanes as an outline has edges
  static constexpr int kept_points = 2;
  static constexpr bool has_halos = false;

  __device__ explicit DeviceGroup(const BlockMemory& shared_memory) : shared_memory_(shared_memory) {}

  __device__ int thread() const { return static_cast<int>(threadIdx.x); }
  __device__ int threads() const { return static_cast<int>(blockDim.x); }
  __device__ Warp warp() const { return {}; }
  __device__ Wide wide() const { return {}; }
  __device__ void block_barrier() { __syncthreads(); }
  __device__ BlockCell& shared() { return shared_memory_.shared; }
  __device__ std::byte* shared_memory() const { return shared_memory_.shared_memory; }
  __device__ std::size_t shared_bytes() const { return shared_memory_.bytes; }
  __device__ std::uint32_t alarms() const {
    return *static_cast<const volatile std::uint32_t*>(&shared_memory_.shared.alarms);
  }

  __device__ static std::int32_t add(std::int32_t* sum, std::int32_t value) { return atomicAdd(sum, value); }
  __device__ static std::uint64_t add(std::uint64_t* sum, std::uint64_t value) {
    return atomicAdd(reinterpret_cast<unsigned long long*>(sum), static_cast<unsigned long long>(value));
  }
  __device__ static void highest(std::uint64_t* value, std::uint64_t other) {
    static_assert(sizeof(std::uint64_t) == sizeof(unsigned long long));
    atomicMax(reinterpret_cast<unsigned long long*>(value), static_cast<unsigned long long>(other));
  }
  __device__ static void highest(std::uint32_t* value, std::uint32_t other) { atomicMax(value, other); }
  __device__ static void set_bit(std::uint32_t* word, std::uint32_t bit) { atomicOr(word, bit); }
  __device__ static bool exchange_if(std::int32_t* value, std::int32_t expected, std::int32_t wanted) {
    return atomicCAS(value, expected, wanted) == expected;
  }

 protected:
  BlockMemory shared_memory_;
};

/// The blocks of a scene, all on the device at the same time. They meet at a grid barrier in the device's memory. A
/// single block waits for no other.
class GridGroup : public DeviceGroup {
 public:
  using Lanes = LaneGroup<8>;

  __device__ GridGroup(const BlockMemory& shared_memory, int block, int blocks, GridBarrier* grid_barrier)
      : DeviceGroup(shared_memory), block_(block), blocks_(blocks), grid_barrier_(grid_barrier) {}

  __device__ Lanes lanes() const { return {}; }
  __device__ int block() const { return block_; }
  __device__ int blocks() const { return blocks_; }

  /// A block does not reach the shared memory of others, and a grid barrier takes longer than moving some bodies of
  /// other blocks.
  static constexpr bool reads_other_blocks = false;
  static constexpr bool has_halos = true;

  /// Writes 16 bytes in one access, past the caches that blocks do not share. No reader sees a part of them.
  __device__ static void write_whole(NumberedHalf* to, const NumberedHalf& value) {
    std::uint64_t low, high;
    memcpy(&low, &value, sizeof low);
    memcpy(&high, value.part + 2, sizeof high);
    asm volatile(
        "{\n\t.reg .b128 whole;\n\tmov.b128 whole, {%1, %2};\n\tst.relaxed.gpu.global.b128 [%0], whole;\n\t}" ::"l"(to),
        "l"(low), "l"(high)
        : "memory");
  }
  __device__ static NumberedHalf read_whole(const NumberedHalf* from) {
    std::uint64_t low, high;
    asm volatile("{\n\t.reg .b128 whole;\n\tld.relaxed.gpu.global.b128 whole, [%2];\n\tmov.b128 {%0, %1}, whole;\n\t}"
                 : "=l"(low), "=l"(high)
                 : "l"(from)
                 : "memory");
    NumberedHalf value;
    memcpy(&value, &low, sizeof low);
    memcpy(value.part + 2, &high, sizeof high);
    return value;
  }
  /// Called between two polls of memory that another block has yet to write.
  __device__ static void pause() {}

  __device__ void barrier() {
    __syncthreads();
    count_arrival();
    wait_at_grid_barrier();
    __syncthreads();
  }
  /// A barrier in two halves. Between them a block works without waiting for others. What it does there is visible to
  /// itself after the second half, but to no other block. The barrier also finds the largest residual of all blocks;
  /// one thread of each block passes it on.
  __device__ void arrive_with_residual(std::uint32_t* residual_bits) {
    __syncthreads();
    if (threadIdx.x == 0) {
      highest(residual_bits, shared_memory_.shared.block_residual);
      shared_memory_.shared.block_residual = 0;
    }
    count_arrival();
  }
  __device__ void wait_for_residual(const std::uint32_t* residual_bits) {
    wait_at_grid_barrier();
    if (threadIdx.x == 0)
      shared_memory_.shared.grid_residual = *static_cast<const volatile std::uint32_t*>(residual_bits);
    __syncthreads();
  }

  /// Raises alarms. A block sees them when it passes the next barrier. At least one more barrier stands between two
  /// that decide on alarms, so that no block sees an alarm raised for a later decision.
  __device__ void raise(std::uint32_t alarms) {
    atomicOr(alone() ? &shared_memory_.shared.alarms : &grid_barrier_->alarms, alarms);
  }
  __device__ void lower_alarms() {
    if (threadIdx.x != 0) return;
    shared_memory_.shared.alarms = 0;
    if (block() == 0) atomicExch(&grid_barrier_->alarms, 0U);
  }

  /// Barriers passed so far; call it from the first thread.
  __device__ int barriers() const { return static_cast<int>(shared_memory_.shared.arrivals) / blocks_; }

 private:
  struct Seen {
    unsigned arrived, alarms;
  };
  /// Reads both words in one access, as each takes the way to global memory.
  __device__ static Seen look_at(const GridBarrier* grid_barrier) {
    Seen seen;
    unsigned long long both;
    asm volatile("ld.acquire.gpu.global.u64 %0, [%1];" : "=l"(both) : "l"(&grid_barrier->arrived) : "memory");
    seen.arrived = static_cast<unsigned>(both);
    seen.alarms = static_cast<unsigned>(both >> 32);
    return seen;
  }

  __device__ bool alone() const { return blocks_ == 1; }

  /// Call it after a block barrier: all writes of the block then come before the arrival.
  __device__ void count_arrival() {
    if (threadIdx.x != 0) return;
    shared_memory_.shared.arrivals += static_cast<unsigned>(blocks_);
    if (!alone()) asm volatile("red.release.gpu.global.add.u32 [%0], 1;" ::"l"(&grid_barrier_->arrived) : "memory");
  }
  __device__ void wait_at_grid_barrier() {
    if (threadIdx.x != 0 || alone()) return;
    const unsigned all = shared_memory_.shared.arrivals;
    Seen seen = look_at(grid_barrier_);
    while (seen.arrived < all) seen = look_at(grid_barrier_);
    shared_memory_.shared.alarms |= seen.alarms;
  }

  int block_, blocks_;
  GridBarrier* grid_barrier_;
};

}  // namespace gem
