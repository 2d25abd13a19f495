// The kernels that make one stage of many scenes.
#include <cooperative_groups.h>

#include <type_traits>

#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/cuda/thread_groups.cuh"
#include "gem/engine/device/phases.h"

namespace gem {
namespace {

/// The blocks of a scene in one stage. They have no barriers.
class PhaseGroup : public DeviceGroup {
 public:
  using Lanes = LaneGroup<phase_lanes>;

  __device__ PhaseGroup(const BlockMemory& shared_memory, int block, int blocks, GridBarrier* grid_barrier)
      : DeviceGroup(shared_memory), block_(block), blocks_(blocks), grid_barrier_(grid_barrier) {}

  __device__ Lanes lanes() const { return {}; }
  __device__ int block() const { return block_; }
  __device__ int blocks() const { return blocks_; }
  __device__ void raise(std::uint32_t alarms) { atomicOr(&grid_barrier_->alarms, alarms); }

 private:
  int block_, blocks_;
  GridBarrier* grid_barrier_;
};

/// Barrier of all threads of a cluster. The barrier counts warps, so a warp that has diverged must reconverge first.
__device__ inline void cluster_barrier() {
  __syncwarp();
  asm volatile("barrier.cluster.arrive.release.aligned;\n\tbarrier.cluster.wait.acquire.aligned;" ::: "memory");
}

/// The blocks that iterate a scene: a cluster, or the first block of the cluster alone. They have barriers and reach
/// each other's shared memory.
class SolveGroup : public DeviceGroup {
 public:
  using Lanes = LaneGroup<4>;
  static constexpr int kept_points = 1;
  static constexpr bool reads_other_blocks = true;

  __device__ SolveGroup(const BlockMemory& shared_memory, bool alone)
      : DeviceGroup(shared_memory), alone_(alone), block_(alone ? 0 : static_cast<int>(cluster().block_rank())) {}

  __device__ Lanes lanes() const { return {}; }
  __device__ int block() const { return block_; }
  __device__ int blocks() const { return alone_ ? 1 : static_cast<int>(cluster().num_blocks()); }
  /// Shared memory of a block of the cluster. The own one is addressed directly: most bodies and points of a block are
  /// its own.
  __device__ std::byte* shared_memory_of(int block) const {
    return block == block_ ? shared_memory_.shared_memory
                           : cluster().map_shared_rank(shared_memory_.shared_memory, block);
  }

  __device__ void barrier() const {
    if (alone_)
      __syncthreads();
    else
      cluster_barrier();
  }

 private:
  __device__ static cooperative_groups::cluster_group cluster() { return cooperative_groups::this_cluster(); }

  bool alone_;
  int block_;
};

/// The same blocks after the iterations, without shared memory.
class SettleGroup : public SolveGroup {
 public:
  using SolveGroup::SolveGroup;
  static constexpr int kept_points = 0;
  static constexpr bool reads_other_blocks = false;
};

/// Whether a block has anything to do for a scene.
template <Stage stage>
__device__ bool has_work(const DeviceScene& s, int block) {
  const int first = block * phase_threads;
  if (stage == Stage::narrow_phase) return first < s.counters->candidates * phase_lanes;
  if (stage == Stage::contact_events) return first < s.counters->touching_count;
  return true;
}

/// Empties the queue of lists and resets their grid barriers; work of one block.
__device__ inline void clear_lists(const PhaseLaunch& launch) {
  if (threadIdx.x == 0) launch.queue->count = 0;
  for (int k = static_cast<int>(threadIdx.x); k < launch.scene_count; k += static_cast<int>(blockDim.x))
    launch.list_barriers[k] = {};
}

/// Plans the next time step of a scene. Adds it to the queue if it needs a list.
__device__ inline void plan(const PhaseLaunch& launch, const DeviceScene& scene, int k) {
  if (plan_step(scene, launch.grid_barriers[k].alarms))
    launch.queue->scene[DeviceGroup::add(&launch.queue->count, 1)] = k;
}

/// The last block of a scene that arrives plans its next time step. The fences make the writes of the others visible to
/// it.
__device__ inline void plan_by_last(const PhaseLaunch& launch, const DeviceScene& scene, const SceneBlock& mine) {
  __syncthreads();
  if (threadIdx.x != 0 || !moves(scene)) return;
  __threadfence();
  if (DeviceGroup::add(&scene.counters->arrived, 1) + 1 < mine.blocks) return;
  __threadfence();
  scene.counters->arrived = 0;
  plan(launch, scene, mine.scene);
}

/// A stage of all scenes, each by its own blocks. Few stages have a kernel for each solver.
template <Stage stage, int blocks, ContactSolver solver = ContactSolver::independent>
__global__ void __launch_bounds__(phase_threads, blocks) phase_of_all(const PhaseLaunch launch) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  extern __shared__ __align__(128) std::byte shared_memory[];
  // the lists of this time step are built, and none is planned before the bodies move
  if (stage == Stage::candidates && blockIdx.x == 0) clear_lists(launch);
  const SceneBlock mine = launch.blocks[blockIdx.x];
  if (!has_work<stage>(launch.scenes[mine.scene], mine.block)) return;
  load_scene(scene, launch.scenes + mine.scene);
  PhaseGroup group(BlockMemory{cell, shared_memory, launch.shared_bytes}, mine.block, mine.blocks,
                   launch.grid_barriers + mine.scene);
  run_stage<stage, solver>(scene, group);
  if (stage == Stage::move) plan_by_last(launch, scene, mine);
}

/// A stage of the solver for all scenes, each by a cluster of blocks. Only stage `iterate` has shared memory.
template <Stage stage, int blocks>
__global__ void __launch_bounds__(solve_threads, blocks) phase_of_solvers(const PhaseLaunch launch) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  extern __shared__ __align__(128) std::byte shared_memory[];
  const DeviceScene* const from = launch.scenes + blockIdx.x / launch.solve_blocks;
  const int points = from->counters->points;
  const bool first = blockIdx.x % launch.solve_blocks == 0, alone = points <= solve_threads;
  if (points == 0 || (alone && !first)) return;
  if (threadIdx.x == 0) cell = {};
  load_scene(scene, from);
  using Group = std::conditional_t<stage == Stage::settle, SettleGroup, SolveGroup>;
  std::byte* const own = stage == Stage::iterate ? shared_memory : nullptr;
  const std::size_t bytes = stage == Stage::settle ? 0 : launch.shared_bytes;
  Group group(BlockMemory{cell, own, bytes}, alone || launch.solve_blocks == 1);
  run_stage<stage, ContactSolver::coupled>(scene, group);
}

/// A cluster of blocks that solves islands.
class IslandGroup : public SolveGroup {
 public:
  __device__ IslandGroup(const BlockMemory& shared_memory, bool alone, GridBarrier* grid_barrier)
      : SolveGroup(shared_memory, alone), grid_barrier_(grid_barrier) {}
  __device__ void raise(std::uint32_t alarms) { atomicOr(&grid_barrier_->alarms, alarms); }

 private:
  GridBarrier* grid_barrier_;
};

/// Stage `iterate` with operator splitting: the islands of all scenes, by clusters that do not meet.
__global__ void __launch_bounds__(solve_threads, 1) phase_of_islands(const PhaseLaunch launch) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  extern __shared__ __align__(128) std::byte shared_memory[];
  const int cluster = static_cast<int>(blockIdx.x) / launch.solve_blocks, k = cluster / launch.island_groups;
  if (launch.scenes[k].counters->points == 0) return;
  load_scene(scene, launch.scenes + k);
  IslandGroup group(BlockMemory{cell, shared_memory, launch.shared_bytes}, launch.solve_blocks == 1,
                    launch.grid_barriers + k);
  solve_islands(scene, group, cluster % launch.island_groups);
}

/// Builds new lists for the scenes in the queue; the blocks are divided evenly among them. The blocks of a list meet at
/// barriers, so all have to be on the device at a time. The device can hold those of all streams. Whatever else runs
/// there ends by itself, as long as no other batch makes time steps on the device.
__global__ void __launch_bounds__(phase_threads, list_blocks) phase_of_lists(const PhaseLaunch launch) {
  __shared__ DeviceScene scene;
  __shared__ BlockCell cell;
  const int count = launch.queue->count, blocks = static_cast<int>(gridDim.x);
  if (count == 0) return;
  const int share = blocks / min(count, blocks), teams = blocks / share;
  const int team = static_cast<int>(blockIdx.x) / share;
  if (team >= teams) return;
  if (threadIdx.x == 0) cell = {};
  GridGroup group(BlockMemory{cell, nullptr, 0}, static_cast<int>(blockIdx.x) % share, share,
                  launch.list_barriers + team);
  for (int at = team; at < count; at += teams) {
    __syncthreads();  // all threads are done with the last scene
    load_scene(scene, launch.scenes + launch.queue->scene[at]);
    renew_list(scene, group);
  }
}

/// A stage with a thread for each scene, by one block.
template <Stage stage>
__global__ void __launch_bounds__(plan_threads) phase_of_scenes(const PhaseLaunch launch) {
  clear_lists(launch);
  __syncthreads();
  for (int k = static_cast<int>(threadIdx.x); k < launch.scene_count; k += static_cast<int>(blockDim.x)) {
    const DeviceScene& scene = launch.scenes[k];
    if constexpr (stage == Stage::open_call)
      open_call(scene, launch.steps[k]);
    else
      plan(launch, scene, k);
  }
}

template <Stage stage, int blocks>
PhaseKernel by_solver(ContactSolver solver) {
  switch (solver) {  // others are refused by check_solver()
    case ContactSolver::coupled:
      return phase_of_all<stage, blocks, ContactSolver::coupled>;
    case ContactSolver::independent:
      return phase_of_all<stage, blocks, ContactSolver::independent>;
    case ContactSolver::compliant:
      break;
  }
  return nullptr;
}

}  // namespace

PhaseKernel islands_kernel() { return phase_of_islands; }

PhaseKernel stage_kernel(Stage stage, ContactSolver solver) {
  switch (stage) {
    case Stage::open_call:
      return phase_of_scenes<Stage::open_call>;
    case Stage::first_solo_events:
      return phase_of_all<Stage::first_solo_events, 4>;
    case Stage::plan:
      return phase_of_scenes<Stage::plan>;
    case Stage::list:
      return phase_of_lists;
    case Stage::candidates:
      return phase_of_all<Stage::candidates, 8>;
    case Stage::narrow_phase:
      return phase_of_all<Stage::narrow_phase, 5>;
    case Stage::contact_events:
      return by_solver<Stage::contact_events, 5>(solver);
    case Stage::gather:
      return phase_of_solvers<Stage::gather, 2>;
    case Stage::iterate:
      return phase_of_solvers<Stage::iterate, 1>;
    case Stage::settle:
      return phase_of_solvers<Stage::settle, 2>;
    case Stage::move:
      return by_solver<Stage::move, 4>(solver);
    case Stage::last_books:
      return phase_of_all<Stage::last_books, 4>;
    case Stage::close_call:
      return phase_of_all<Stage::close_call, 4>;
    case Stage::solo_events:
    case Stage::books:
      break;  // goes_with_move()
  }
  return nullptr;
}

}  // namespace gem
