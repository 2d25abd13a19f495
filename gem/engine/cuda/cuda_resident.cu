// The kernel that moves scenes by blocks that stay with them.
#include "gem/engine/cuda/crews.cuh"
#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/device/moments.h"

namespace gem {
namespace {

__global__ void __launch_bounds__(most_threads, 1) advance_scenes(const Launch launch) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  extern __shared__ __align__(128) std::byte room[];
  const SceneBlock mine = launch.blocks[blockIdx.x];
  take_scene(scene, launch.scenes + mine.scene);
  GateCrew crew(BlockRoom{cell, room, launch.room_bytes}, mine.block, mine.blocks, launch.gates + mine.scene);
  advance_scene(scene, crew, launch.moments[mine.scene]);
}

}  // namespace

AdvanceKernel advance_kernel() { return advance_scenes; }

}  // namespace gem
