// One launch of the kernel that moves scenes: how they are spread over the device, and how long it took.
#pragma once

#include <algorithm>

#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/cuda/cuda_memory.cuh"
#include "gem/engine/device/block_share.h"

namespace gem {
namespace {

/// The fast memory that a kernel takes is taken from the cache; more than this loses more there than it gains [bytes].
constexpr std::size_t most_room = 160 * 1024;

/// Blocks of a scene that meet at a gate, at least: up to three scenes on 132 multiprocessors. Between these and the
/// largest cluster, whose blocks meet faster, nothing was timed.
constexpr int fewest_gated = 40;
static_assert(fewest_gated > largest_cluster);

/// How a batch is spread over the device.
struct Spread {
  int scenes = 1, blocks = 1, threads = most_threads;
  bool gated() const { return blocks > largest_cluster; }
  int cluster() const { return gated() ? 1 : blocks; }
  AdvanceKernel kernel() const { return advance_kernel(gated()); }
};

/// The fast memory that a block may have besides what the kernel takes itself; the kernel is allowed to take it
/// [bytes].
std::size_t room_of_block(const Spread& spread) {
  int device = 0, most = 0;
  cudaFuncAttributes attributes{};
  check_cuda(cudaGetDevice(&device), "be set up");
  check_cuda(cudaDeviceGetAttribute(&most, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), "be set up");
  check_cuda(cudaFuncGetAttributes(&attributes, spread.kernel()), "be set up");
  const std::size_t left =
      std::min(most_room, (static_cast<std::size_t>(most) - attributes.sharedSizeBytes) / 128 * 128);
  check_cuda(cudaFuncSetAttribute(spread.kernel(), cudaFuncAttributeMaxDynamicSharedMemorySize, static_cast<int>(left)),
             "be set up");
  check_cuda(cudaFuncSetAttribute(spread.kernel(), cudaFuncAttributeNonPortableClusterSizeAllowed, 1), "be set up");
  return left;
}

/// A launch and the attributes that it points to.
struct LaunchConfig {
  cudaLaunchConfig_t config{};
  cudaLaunchAttribute attribute[2];

  LaunchConfig(const Spread& spread, std::size_t room, cudaStream_t stream) {
    attribute[0].id = cudaLaunchAttributeClusterDimension;
    attribute[0].val.clusterDim = {static_cast<unsigned>(spread.cluster()), 1, 1};
    attribute[1].id = cudaLaunchAttributeCooperative;
    attribute[1].val.cooperative = 1;
    config.gridDim = dim3(static_cast<unsigned>(spread.scenes * spread.blocks));
    config.blockDim = dim3(static_cast<unsigned>(spread.threads));
    config.dynamicSmemBytes = room;
    config.stream = stream;
    config.attrs = attribute;
    config.numAttrs = spread.gated() ? 2 : 1;
  }
  LaunchConfig(const LaunchConfig&) = delete;
  LaunchConfig& operator=(const LaunchConfig&) = delete;

  /// Clusters that run at the same time.
  int clusters(const Spread& spread) {
    int most = 0;
    config.numAttrs = 1;
    if (cudaOccupancyMaxActiveClusters(&most, spread.kernel(), &config) != cudaSuccess) most = 0;
    cudaGetLastError();
    config.numAttrs = spread.gated() ? 2 : 1;
    return most;
  }
};

/// Blocks for each scene with which all scenes run at the same time: as many as there are for few scenes, a cluster for
/// each of more; no more than `useful`.
int most_blocks(int scenes, int threads, int multiprocessors, int useful) {
  for (int blocks = std::min(multiprocessors / scenes, useful); blocks >= fewest_gated; --blocks) {
    const Spread spread{scenes, blocks, threads};
    if (LaunchConfig(spread, room_of_block(spread), nullptr).clusters(spread) >= scenes * blocks) return blocks;
  }
  for (int blocks = largest_cluster; blocks > 1; --blocks) {
    const Spread spread{scenes, blocks, threads};
    if (blocks <= useful && LaunchConfig(spread, room_of_block(spread), nullptr).clusters(spread) >= scenes)
      return blocks;
  }
  return 1;
}

/// How many clusters of each size that scenes may have run at the same time.
ClusterRoom room_for_clusters(int threads) {
  ClusterRoom room;
  for (std::size_t size = 0; size < room.size(); ++size) {
    const Spread spread{1, share_sizes[size], threads};
    room[size] = LaunchConfig(spread, room_of_block(spread), nullptr).clusters(spread);
  }
  return room;
}

/// A stream and two marks in its time. Others may begin with it and end before it.
class Timeline {
 public:
  /// Of what waits for a place on the device, streams of higher priority start first, as far as it tells priorities
  /// apart.
  explicit Timeline(int priority = 0) {
    int lowest = 0, highest = 0;
    check_cuda(cudaDeviceGetStreamPriorityRange(&lowest, &highest), "make a stream");
    const int level = std::max(lowest - priority, highest);
    check_cuda(cudaStreamCreateWithPriority(&stream_, cudaStreamNonBlocking, level), "make a stream");
    check_cuda(cudaEventCreate(&begin_), "make a stream");
    check_cuda(cudaEventCreate(&end_), "make a stream");
  }
  ~Timeline() {
    cudaEventDestroy(begin_);
    cudaEventDestroy(end_);
    cudaStreamDestroy(stream_);
  }
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;

  cudaStream_t stream() const { return stream_; }
  void begin() { check_cuda(cudaEventRecord(begin_, stream_), "be timed"); }
  void end() { check_cuda(cudaEventRecord(end_, stream_), "be timed"); }
  /// After the beginning of `other`.
  void begin_after(const Timeline& other) {
    check_cuda(cudaStreamWaitEvent(stream_, other.begin_, 0), "start");
    begin();
  }
  /// Goes on when `other` has ended.
  void wait_for(const Timeline& other) const { check_cuda(cudaStreamWaitEvent(stream_, other.end_, 0), "start"); }
  double seconds() const {
    float milliseconds = 0.0F;
    check_cuda(cudaEventElapsedTime(&milliseconds, begin_, end_), "be timed");
    return 1e-3 * static_cast<double>(milliseconds);
  }

 private:
  cudaStream_t stream_ = nullptr;
  cudaEvent_t begin_ = nullptr, end_ = nullptr;
};

}  // namespace
}  // namespace gem
