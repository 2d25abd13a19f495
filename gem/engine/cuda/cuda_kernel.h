// The kernels that move scenes on, with the bits of the cpu engine, and what their launches work on.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gem/engine/cuda/cuda_engine.h"
#include "gem/engine/device/phases.h"

namespace gem {

/// Where the blocks of a scene meet; zero before a launch. Both words are read as one.
struct alignas(128) GridBarrier {
  unsigned arrived, alarms;
};

constexpr int most_threads = 256;  // leaves 255 registers for each, which keep what they work on; with half of them
                                   // twice the threads took longer

/// A block of a grid that works on many scenes: its scene, and which it is of the scene's blocks.
struct SceneBlock {
  std::int32_t scene, block, blocks;
  bool operator==(const SceneBlock&) const = default;
};

/// What the launch of blocks that stay works on: scene k is moved on by time steps[k] time steps.
struct Launch {
  const DeviceScene* scenes;
  const std::int32_t* steps;
  GridBarrier* grid_barriers;
  const SceneBlock* blocks;
  std::size_t shared_bytes;
};

/// The scenes that need a new list in this time step, in no order.
struct ListQueue {
  std::int32_t count;
  std::int32_t scene[1];  // as many as there are scenes
};

/// What the launch of a phase works on.
struct PhaseLaunch {
  const DeviceScene* scenes;
  const std::int32_t* steps;
  GridBarrier* grid_barriers;  // of each scene: its alarms
  GridBarrier* list_barriers;  // as many, for the blocks that build a list together
  const SceneBlock* blocks;
  ListQueue* queue;
  int scene_count;
  int solve_blocks;  // of a cluster that iterates a scene
  std::size_t shared_bytes;
  bool operator==(const PhaseLaunch&) const = default;
};

using AdvanceKernel = void (*)(const Launch);

AdvanceKernel advance_kernel();

using PhaseKernel = void (*)(const PhaseLaunch);

PhaseKernel stage_kernel(Stage stage, ContactSolver solver);

}  // namespace gem
