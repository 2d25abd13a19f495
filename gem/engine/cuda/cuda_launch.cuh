// What all launches need: a stream with its times and the table of their blocks. And the resident launch, whose blocks
// stay with their scenes.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "gem/engine/cuda/cuda_kernel.h"
#include "gem/engine/cuda/cuda_memory.cuh"

namespace gem {
namespace {

/// A stream with two timed marks. Another timeline may begin after its begin and end before its end.
class Timeline {
 public:
  Timeline() {
    check_cuda(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "make a stream");
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
  void begin() { check_cuda(cudaEventRecord(begin_, stream_), "record the time"); }
  void end() { check_cuda(cudaEventRecord(end_, stream_), "record the time"); }
  /// Begins once `other` has begun.
  void begin_after(const Timeline& other) {
    check_cuda(cudaStreamWaitEvent(stream_, other.begin_, 0), "start the work");
    begin();
  }
  /// Work that follows in this stream waits for the end of `other`.
  void wait_for(const Timeline& other) const {
    check_cuda(cudaStreamWaitEvent(stream_, other.end_, 0), "start the work");
  }
  double seconds() const {
    float milliseconds = 0.0F;
    check_cuda(cudaEventElapsedTime(&milliseconds, begin_, end_), "record the time");
    return 1e-3 * static_cast<double>(milliseconds);
  }

 private:
  cudaStream_t stream_ = nullptr;
  cudaEvent_t begin_ = nullptr, end_ = nullptr;
};

/// The table of the blocks of a launch, in device memory.
class BlockTable {
 public:
  /// Returns the table of these blocks on the device. Sends it only if it differs from the last one.
  const SceneBlock* send(std::vector<SceneBlock> blocks, cudaStream_t stream) {
    if (blocks != sent_) {
      sent_.clear();
      const std::size_t bytes = sizeof(SceneBlock) * blocks.size();
      memory_.reserve(bytes);
      check_cuda(cudaMemcpyAsync(memory_.data(), blocks.data(), bytes, cudaMemcpyHostToDevice, stream),
                 "start the work");
      check_cuda(cudaStreamSynchronize(stream), "start the work");
      sent_ = std::move(blocks);
    }
    return reinterpret_cast<const SceneBlock*>(memory_.data());
  }
  /// Adds the blocks of scene k.
  static void add(std::vector<SceneBlock>& all, std::size_t k, int blocks) {
    for (int b = 0; b < blocks; ++b) all.push_back({static_cast<std::int32_t>(k), b, blocks});
  }

 private:
  std::vector<SceneBlock> sent_;
  DeviceMemory memory_;
};

/// The launch of resident blocks. The blocks of a scene meet at a grid barrier, so all have to be on the device at a
/// time: the launch is cooperative.
class ResidentLaunch {
 public:
  ResidentLaunch(int threads, int multiprocessors) : threads_(threads) {
    int device = 0, most = 0, together = 0;
    cudaFuncAttributes attributes{};
    check_cuda(cudaGetDevice(&device), "set up a kernel");
    check_cuda(cudaDeviceGetAttribute(&most, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), "set up a kernel");
    check_cuda(cudaFuncGetAttributes(&attributes, advance_kernel()), "set up a kernel");
    shared_memory_ =
        std::min(most_shared_bytes, (static_cast<std::size_t>(most) - attributes.sharedSizeBytes) / 128 * 128);
    check_cuda(cudaFuncSetAttribute(advance_kernel(), cudaFuncAttributeMaxDynamicSharedMemorySize,
                                    static_cast<int>(shared_memory_)),
               "set up a kernel");
    check_cuda(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&together, advance_kernel(), threads_, shared_memory_),
               "set up a kernel");
    blocks_ = together * multiprocessors;
  }

  int threads() const { return threads_; }
  /// Blocks that the device runs at a time.
  int blocks() const { return blocks_; }

  /// Starts blocks[k] blocks for scene k: in all at most blocks(), or one for each scene.
  void start(Launch work, const std::vector<int>& blocks, cudaStream_t stream) {
    std::vector<SceneBlock> all;
    for (std::size_t k = 0; k < blocks.size(); ++k) BlockTable::add(all, k, blocks[k]);
    cudaLaunchAttribute cooperative{};
    cooperative.id = cudaLaunchAttributeCooperative;
    cooperative.val.cooperative = 1;
    cudaLaunchConfig_t config{};
    config.gridDim = dim3(static_cast<unsigned>(all.size()));
    config.blockDim = dim3(static_cast<unsigned>(threads_));
    config.dynamicSmemBytes = shared_memory_;
    config.stream = stream;
    config.attrs = &cooperative;
    // not cooperative where each scene has one block: such blocks do not meet and may take turns
    config.numAttrs = all.size() > blocks.size() ? 1 : 0;
    work.shared_bytes = shared_memory_;
    work.blocks = table_.send(std::move(all), stream);
    check_cuda(cudaLaunchKernelEx(&config, advance_kernel(), work), "start the work");
  }

 private:
  /// Most shared memory of a kernel [bytes]. It is taken from the L1 cache; more than this loses more there than it
  /// gains.
  static constexpr std::size_t most_shared_bytes = 160 * 1024;

  int threads_, blocks_ = 0;
  std::size_t shared_memory_ = 0;
  BlockTable table_;
};

}  // namespace
}  // namespace gem
