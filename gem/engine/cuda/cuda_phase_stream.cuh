// The launches of a group of scenes on the phases route, in a stream of their own.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <utility>
#include <vector>

#include "gem/engine/cuda/cuda_graph.cuh"
#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/cuda/cuda_launch.cuh"
#include "gem/engine/cuda/cuda_memory.cuh"

namespace gem {
namespace {

/// The configuration of a launch by clusters, with the attribute that it points to.
struct SolverConfig {
  cudaLaunchConfig_t config{};
  cudaLaunchAttribute cluster{};

  SolverConfig(int scenes, int blocks, std::size_t shared_memory, cudaStream_t stream) {
    cluster.id = cudaLaunchAttributeClusterDimension;
    cluster.val.clusterDim = {static_cast<unsigned>(blocks), 1, 1};
    config.gridDim = dim3(static_cast<unsigned>(scenes * blocks));
    config.blockDim = dim3(solve_threads);
    config.dynamicSmemBytes = shared_memory;
    config.stream = stream;
    config.attrs = &cluster;
    config.numAttrs = 1;
  }
  SolverConfig(const SolverConfig&) = delete;
  SolverConfig& operator=(const SolverConfig&) = delete;
};

/// A scene of a call, as its launches see it.
struct PhaseScene {
  ContactSolver solver = ContactSolver::independent;
  bool splitting = false;  // coupled, by operator splitting
  int blocks = 1;          // blocks that move its bodies
  std::int32_t steps = 0;  // time steps wanted
  double visits = 0.0;     // coupled: visits of its points in a time step; 0: not known yet
};

/// Shared memory of a block in a stage of the solver [bytes].
constexpr std::size_t shared_bytes_of_solver(Stage stage) { return stage == Stage::iterate ? solve_shared_bytes : 0; }

/// The largest cluster by which the device can iterate, a power of two; 0: none. Also sets the attributes of the
/// kernels that clusters need.
int largest_solver() {
  int device = 0, most = 0, blocks = largest_cluster;
  check_cuda(cudaGetDevice(&device), "set up a kernel");
  check_cuda(cudaDeviceGetAttribute(&most, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), "set up a kernel");
  check_cuda(cudaFuncSetAttribute(islands_kernel(), cudaFuncAttributeMaxDynamicSharedMemorySize,
                                  static_cast<int>(islands_kernel_bytes)),
             "set up a kernel");
  check_cuda(cudaFuncSetAttribute(islands_kernel(), cudaFuncAttributeNonPortableClusterSizeAllowed, 1),
             "set up a kernel");
  for (const Stage stage : {Stage::gather, Stage::iterate, Stage::settle}) {
    const PhaseKernel kernel = stage_kernel(stage, ContactSolver::coupled);
    const std::size_t shared_memory = shared_bytes_of_solver(stage);
    cudaFuncAttributes attributes{};
    check_cuda(cudaFuncGetAttributes(&attributes, kernel), "set up a kernel");
    if (shared_memory + attributes.sharedSizeBytes > static_cast<std::size_t>(most)) return 0;
    check_cuda(
        cudaFuncSetAttribute(kernel, cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(shared_memory)),
        "set up a kernel");
    check_cuda(cudaFuncSetAttribute(kernel, cudaFuncAttributeNonPortableClusterSizeAllowed, 1), "set up a kernel");
    for (int clusters = 0; blocks > 0; blocks /= 2) {
      const SolverConfig config(1, blocks, shared_memory, nullptr);
      if (cudaOccupancyMaxActiveClusters(&clusters, kernel, &config.config) == cudaSuccess && clusters > 0) break;
      cudaGetLastError();
    }
  }
  return blocks;
}

/// A group of scenes that share one stream. While one stream waits, another one works. All streams have the same
/// priority: blocks that build a list spin at a grid barrier, and higher-priority blocks could keep the missing blocks
/// of that barrier off the device.
class PhaseStream {
 public:
  explicit PhaseStream(int multiprocessors) : multiprocessors_(multiprocessors) {}

  /// Blocks that iterate each scene. Those of the last call if `wanted` is about as many: the recorded launches can
  /// then be used again.
  int steady_blocks(int wanted) const {
    const int last = work_.solve_blocks;
    return 5 * std::abs(wanted - last) <= std::max(wanted, last) ? last : wanted;
  }

  /// Begins a call with these scenes, all of one solver. `work` says where they are and how many blocks iterate each.
  /// `streams` is the number of streams that share the device. Returns how often start_steps() has to be called.
  std::int64_t begin(const PhaseLaunch& work, const std::vector<PhaseScene>& scenes, int streams,
                     const Timeline& call) {
    time_.begin_after(call);
    work_ = work;
    work_.scene_count = static_cast<int>(scenes.size());
    solver_ = scenes.front().solver;
    splitting_ = scenes.front().splitting;
    const int each = multiprocessors_ / (streams * work_.scene_count * work_.solve_blocks);
    work_.island_groups = splitting_ ? std::clamp(each, 1, most_island_groups) : 1;
    list_blocks_ = std::max(1, list_blocks_together() / streams);
    std::vector<SceneBlock> block;
    add_blocks(block, scenes, 1);
    body_blocks_ = static_cast<int>(block.size());
    add_blocks(block, scenes, std::max(1, body_blocks_ * streams / (pairs_blocks * multiprocessors_)));
    pair_blocks_ = static_cast<int>(block.size()) - body_blocks_;
    work_.blocks = table_.send(std::move(block), time_.stream());
    queue_memory_.reserve(sizeof(ListQueue) + sizeof(std::int32_t) * scenes.size());
    work_.queue = reinterpret_cast<ListQueue*>(queue_memory_.data());
    std::int32_t steps = 0;
    for (const PhaseScene& scene : scenes) steps = std::max(steps, scene.steps);
    record(std::min(steps, most_together));
    return (steps + recorded_.steps - 1) / recorded_.steps;
  }

  /// Starts some time steps. A scene that has made its time steps does nothing in further ones.
  void start_steps() { steps_.start(time_.stream()); }

  template <class Phases>
  void launch(const Phases& phases) {
    for (const Stage stage : phases) launch(stage);
  }

  void end(const Timeline& call) {
    time_.end();
    call.wait_for(time_);
  }

 private:
  /// Most blocks per multiprocessor that work on pairs: more would only start and end.
  static constexpr int pairs_blocks = 16;

  /// Most time steps that are started together.
  static constexpr std::int32_t most_together = 4;

  /// What the recorded launches depend on.
  struct Recorded {
    PhaseLaunch work{};
    ContactSolver solver = ContactSolver::independent;
    bool splitting = false;
    int body_blocks = 0, pair_blocks = 0, list_blocks = 0;
    std::int32_t steps = 0;
    bool operator==(const Recorded&) const = default;
  };

  void record(std::int32_t steps) {
    const Recorded wanted{work_, solver_, splitting_, body_blocks_, pair_blocks_, list_blocks_, steps};
    if (wanted == recorded_) return;
    recorded_ = {};
    steps_.record(time_.stream(), [&] {
      for (std::int32_t k = 0; k < steps; ++k) launch(time_step_stages);
    });
    recorded_ = wanted;
  }

  void launch(Stage stage) {
    if (goes_with_move(stage)) return;
    if (is_of_solver(stage)) {
      if (splitting_ && stage == Stage::iterate)
        launch_islands();
      else if (solver_ == ContactSolver::coupled)
        launch_solver(stage);
      return;
    }
    PhaseLaunch work = work_;
    int grid = body_blocks_, block = phase_threads;
    if (stage == Stage::open_call || stage == Stage::plan) grid = 1, block = plan_threads;
    if (stage == Stage::list) grid = list_blocks_;
    if (stage == Stage::candidates || stage == Stage::narrow_phase || stage == Stage::contact_events) {
      grid = pair_blocks_;
      work.blocks += body_blocks_;
    }
    if (stage == Stage::candidates) work.shared_bytes = candidate_shared_bytes;
    if (stage == Stage::narrow_phase) work.shared_bytes = phase_threads / phase_lanes * sizeof(WorkspaceOutlines);
    if (stage == Stage::move) work.shared_bytes = bodies_shared_bytes;
    cudaLaunchConfig_t config{};
    config.gridDim = dim3(static_cast<unsigned>(grid));
    config.blockDim = dim3(static_cast<unsigned>(block));
    config.dynamicSmemBytes = work.shared_bytes;
    config.stream = time_.stream();
    check_cuda(cudaLaunchKernelEx(&config, kernel_of_stage(stage), work), "start the work");
  }

  void launch_islands() {
    PhaseLaunch work = work_;
    work.shared_bytes = islands_kernel_bytes;
    const SolverConfig islands(work.scene_count * work.island_groups, work.solve_blocks, work.shared_bytes,
                               time_.stream());
    check_cuda(cudaLaunchKernelEx(&islands.config, islands_kernel(), work), "start the work");
  }

  void launch_solver(Stage stage) {
    PhaseLaunch work = work_;
    work.shared_bytes = solve_shared_bytes;
    const SolverConfig solver(work.scene_count, work.solve_blocks, shared_bytes_of_solver(stage), time_.stream());
    check_cuda(cudaLaunchKernelEx(&solver.config, kernel_of_stage(stage), work), "start the work");
  }

  /// Blocks that build lists, of all streams. They meet at barriers, so all have to be on the device at a time.
  int list_blocks_together() const {
    int together = 0;
    check_cuda(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&together, kernel_of_stage(Stage::list), phase_threads, 0),
               "set up a kernel");
    return std::min(list_blocks, together) * multiprocessors_;
  }

  PhaseKernel kernel_of_stage(Stage stage) const { return stage_kernel(stage, solver_); }

  /// Adds the blocks of all scenes: for each scene those that move its bodies, divided by `share`.
  static void add_blocks(std::vector<SceneBlock>& all, const std::vector<PhaseScene>& scenes, int share) {
    for (std::size_t k = 0; k < scenes.size(); ++k) BlockTable::add(all, k, (scenes[k].blocks + share - 1) / share);
  }

  ContactSolver solver_ = ContactSolver::independent;
  bool splitting_ = false;
  int multiprocessors_;
  int body_blocks_ = 0, pair_blocks_ = 0, list_blocks_ = 1;
  PhaseLaunch work_{};
  Timeline time_;
  RecordedLaunches steps_;
  Recorded recorded_;
  BlockTable table_;
  DeviceMemory queue_memory_;
};

}  // namespace
}  // namespace gem
