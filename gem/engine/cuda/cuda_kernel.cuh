// The kernel itself; included by the two files that compile it.
#pragma once

#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/cuda/thread_groups.cuh"
#include "gem/engine/device/resident_steps.h"

namespace gem {
namespace {

template <class Group>
__global__ void __launch_bounds__(most_threads, 1) advance_scenes(const Launch launch) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  __shared__ StageClock clock;
  extern __shared__ __align__(128) std::byte shared_memory[];
  const int k = static_cast<int>(blockIdx.x) / launch.blocks;
  if (threadIdx.x == 0) {
    clock = {};
    clock.last = clock64();
  }
  load_scene(scene, launch.scenes + k);
  const bool first = static_cast<int>(blockIdx.x) % launch.blocks == 0;
  Group group(BlockMemory{cell, clock, shared_memory, launch.shared_bytes, first}, launch.blocks,
              launch.grid_barriers + k);
  advance_scene(scene, group, launch.steps[k]);
  group.barrier();  // no block leaves while another may still raise an alarm in it
}

AdvanceKernel kernel_of(bool uses_grid_barrier) {
  return uses_grid_barrier ? advance_scenes<GridGroup> : advance_scenes<ClusterGroup>;
}

}  // namespace
}  // namespace gem
