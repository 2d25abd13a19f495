// The kernels that move scenes on, with the bits of the cpu engine, and the arguments of their launches.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gem/engine/cuda/cuda_engine.h"
#include "gem/engine/device/phases.h"

namespace gem {

/// The grid barrier of a scene; zero before a launch. Both words are read together.
struct alignas(128) GridBarrier {
  unsigned arrived, alarms;
};

/// Most threads of a resident block. 256 leaves each thread 255 registers for its data. 512 threads with half the
/// registers were slower.
constexpr int most_threads = 256;

/// A block of a grid that works on many scenes: its scene, its number among the blocks of the scene, and their count.
struct SceneBlock {
  std::int32_t scene, block, blocks;
  bool operator==(const SceneBlock&) const = default;
};

/// Arguments of a resident launch: scene k is moved on by steps[k] time steps.
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
  std::int32_t scene[1];  // as many elements as there are scenes
};

/// Arguments of the launch of a stage.
struct PhaseLaunch {
  const DeviceScene* scenes;
  const std::int32_t* steps;
  GridBarrier* grid_barriers;  // of each scene; only its alarms are used
  GridBarrier* list_barriers;  // as many, for the blocks that build a list together
  const SceneBlock* blocks;
  ListQueue* queue;
  int scene_count;
  int solve_blocks;   // blocks of a cluster that iterates a scene
  int island_groups;  // clusters that solve its islands, with operator splitting
  std::size_t shared_bytes;
  bool operator==(const PhaseLaunch&) const = default;
};

using AdvanceKernel = void (*)(const Launch);

/// The kernel of a resident launch.
AdvanceKernel advance_kernel();

using PhaseKernel = void (*)(const PhaseLaunch);

/// The kernel of a stage; null for stages that go with `move`.
PhaseKernel stage_kernel(Stage stage, ContactSolver solver);

/// The kernel of stage `iterate` with operator splitting, and the shared memory of its blocks of `solve_threads`
/// [bytes].
PhaseKernel islands_kernel();
constexpr std::size_t islands_kernel_bytes = islands_shared_bytes(solve_threads, 32);

}  // namespace gem
