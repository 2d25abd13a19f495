// The crews of CUDA kernels: what they have in common, and the blocks of a scene that meet at a gate.
#pragma once

#include <cuda_runtime.h>

#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/device/crew.h"
#include "gem/engine/device/scene.h"

namespace gem {

/// `lanes` neighbouring threads of a warp.
template <int lanes>
class LaneGroup {
 public:
  static constexpr int size = lanes;

  __device__ int rank() const { return static_cast<int>(threadIdx.x) % lanes; }
  /// Groups of a warp would vote one after the other: they exchange instead.
  __device__ unsigned ballot(bool mine) const {
    if constexpr (lanes == 32) return __ballot_sync(ones, mine);
    unsigned bits = mine ? 1U << rank() : 0U;
    for (int step = 1; step < lanes; step *= 2) bits |= __shfl_xor_sync(mask(), bits, step, lanes);
    return bits;
  }
  __device__ int from(int mine, int lane) const { return __shfl_sync(mask(), mine, lane, lanes); }
  __device__ double from(double mine, int lane) const { return __shfl_sync(mask(), mine, lane, lanes); }
  __device__ int partner(int mine, int step) const { return __shfl_xor_sync(mask(), mine, step, lanes); }
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

/// The scene's constants and addresses, close at hand for all threads of a block.
__device__ inline void take_scene(DeviceScene& scene, const DeviceScene* from) {
  auto* to = reinterpret_cast<std::uint64_t*>(&scene);
  for (unsigned w = threadIdx.x; w < sizeof(DeviceScene) / sizeof(std::uint64_t); w += blockDim.x)
    to[w] = reinterpret_cast<const std::uint64_t*>(from)[w];
  __syncthreads();
}

/// The fast memory of one block.
struct BlockRoom {
  BlockCell& shared;
  std::byte* room;
  std::size_t bytes;
};

/// What crews of one or of many blocks have in common.
class DeviceCrew {
 public:
  using Warp = LaneGroup<32>;
  using Wide = LaneGroup<8>;  // about the edges of an outline
  static constexpr int kept_points = 2;
  static constexpr bool has_halos = false;

  __device__ explicit DeviceCrew(const BlockRoom& room) : room_(room) {}

  __device__ int thread() const { return static_cast<int>(threadIdx.x); }
  __device__ int threads() const { return static_cast<int>(blockDim.x); }
  __device__ Warp warp() const { return {}; }
  __device__ Wide wide() const { return {}; }
  __device__ void block_barrier() { __syncthreads(); }
  __device__ BlockCell& shared() { return room_.shared; }
  __device__ std::byte* room() const { return room_.room; }
  __device__ std::size_t room_bytes() const { return room_.bytes; }
  __device__ std::uint32_t alarms() const { return *static_cast<const volatile std::uint32_t*>(&room_.shared.alarms); }

  __device__ static std::int32_t add(std::int32_t* sum, std::int32_t value) { return atomicAdd(sum, value); }
  __device__ static void highest(std::uint64_t* value, std::uint64_t other) {
    static_assert(sizeof(std::uint64_t) == sizeof(unsigned long long));
    atomicMax(reinterpret_cast<unsigned long long*>(value), static_cast<unsigned long long>(other));
  }
  __device__ static void highest(std::uint32_t* value, std::uint32_t other) { atomicMax(value, other); }
  __device__ static void set_bit(std::uint32_t* word, std::uint32_t bit) { atomicOr(word, bit); }

 protected:
  BlockRoom room_;
};

/// The blocks of a scene, all on the device at the same time; they meet at a gate in its memory. A block alone meets
/// nobody.
class GateCrew : public DeviceCrew {
 public:
  using Lanes = LaneGroup<8>;

  __device__ GateCrew(const BlockRoom& room, int block, int blocks, CrewGate* gate)
      : DeviceCrew(room), block_(block), blocks_(blocks), gate_(gate) {}

  __device__ Lanes lanes() const { return {}; }
  __device__ int block() const { return block_; }
  __device__ int blocks() const { return blocks_; }

  /// Other blocks do not reach a block's fast memory, and meeting them takes longer than moving some of their bodies.
  static constexpr bool shares_rooms = false;
  static constexpr bool has_halos = true;

  /// Sixteen bytes in one go, past the caches that blocks do not share: no reader sees a part of them.
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
  /// Between two looks at what another block has yet to write.
  __device__ static void pause() {}

  __device__ void barrier() {
    __syncthreads();
    count_arrival();
    wait_at_gate();
    __syncthreads();
  }
  /// A barrier in two halves, with work between them that waits for no other block's second half. What the block does
  /// there is known to all of it after the second, but to no other block. On the way what the points of all blocks ask
  /// for comes together: one thread of each hands it on.
  __device__ void arrive_asking(std::uint32_t* asked) {
    __syncthreads();
    if (threadIdx.x == 0) {
      highest(asked, room_.shared.asked);
      room_.shared.asked = 0;
    }
    count_arrival();
  }
  __device__ void wait_for_asked(const std::uint32_t* asked) {
    wait_at_gate();
    if (threadIdx.x == 0) room_.shared.asked_by_all = *static_cast<const volatile std::uint32_t*>(asked);
    __syncthreads();
  }

  /// Seen by a block when it passes the next barrier. Between two barriers with a decision on alarms there is a third,
  /// so that no block can see an alarm that another has yet to raise for a later decision.
  __device__ void raise(std::uint32_t alarms) { atomicOr(alone() ? &room_.shared.alarms : &gate_->alarms, alarms); }
  __device__ void lower_alarms() {
    if (threadIdx.x != 0) return;
    room_.shared.alarms = 0;
    if (block() == 0) atomicExch(&gate_->alarms, 0U);
  }

  /// Passed so far; asked by the first thread.
  __device__ int barriers() const { return static_cast<int>(room_.shared.arrivals) / blocks_; }

 private:
  struct Seen {
    unsigned arrived, alarms;
  };
  /// Both words at once: each look takes the way to the memory of all.
  __device__ static Seen look_at(const CrewGate* gate) {
    Seen seen;
    unsigned long long both;
    asm volatile("ld.acquire.gpu.global.u64 %0, [%1];" : "=l"(both) : "l"(&gate->arrived) : "memory");
    seen.arrived = static_cast<unsigned>(both);
    seen.alarms = static_cast<unsigned>(both >> 32);
    return seen;
  }

  __device__ bool alone() const { return blocks_ == 1; }

  /// After a barrier of the block, so what all of it wrote comes before.
  __device__ void count_arrival() {
    if (threadIdx.x != 0) return;
    room_.shared.arrivals += static_cast<unsigned>(blocks_);
    if (!alone()) asm volatile("red.release.gpu.global.add.u32 [%0], 1;" ::"l"(&gate_->arrived) : "memory");
  }
  __device__ void wait_at_gate() {
    if (threadIdx.x != 0 || alone()) return;
    const unsigned all = room_.shared.arrivals;
    Seen seen = look_at(gate_);
    while (seen.arrived < all) seen = look_at(gate_);
    room_.shared.alarms |= seen.alarms;
  }

  int block_, blocks_;
  CrewGate* gate_;
};

}  // namespace gem
