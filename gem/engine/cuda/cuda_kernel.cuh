// The kernel that moves scenes by blocks that stay with them.
#pragma once

#include "gem/engine/cuda/crews.cuh"
#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/device/moments.h"

namespace gem {
namespace {

template <class Crew>
__global__ void __launch_bounds__(most_threads, 1) advance_scenes(const Launch launch) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  __shared__ StageClock clock;
  extern __shared__ __align__(128) std::byte room[];
  const int k = static_cast<int>(blockIdx.x) / launch.blocks;
  if (threadIdx.x == 0) {
    clock = {};
    clock.last = clock64();
  }
  take_scene(scene, launch.scenes + k);
  const bool first = static_cast<int>(blockIdx.x) % launch.blocks == 0;
  Crew crew(BlockRoom{cell, clock, room, launch.room_bytes, first}, launch.blocks, launch.gates + k);
  advance_scene(scene, crew, launch.moments[k]);
  crew.barrier();  // no block leaves while another may still raise an alarm in it
}

AdvanceKernel kernel_of(bool gated) { return gated ? advance_scenes<GateCrew> : advance_scenes<ClusterCrew>; }

}  // namespace
}  // namespace gem
