// The kernel of resident launches: blocks stay with their scenes through many time steps.
#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/cuda/thread_groups.cuh"
#include "gem/engine/device/resident_steps.h"

namespace gem {
namespace {

__global__ void __launch_bounds__(most_threads, 1) advance_scenes(const Launch launch) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  extern __shared__ __align__(128) std::byte shared_memory[];
  const SceneBlock mine = launch.blocks[blockIdx.x];
  load_scene(scene, launch.scenes + mine.scene);
  GridGroup group(BlockMemory{cell, shared_memory, launch.shared_bytes}, mine.block, mine.blocks,
                  launch.grid_barriers + mine.scene);
  advance_scene(scene, group, launch.steps[mine.scene]);
}

}  // namespace

AdvanceKernel advance_kernel() { return advance_scenes; }

}  // namespace gem
