// The launches of a call that moves independent scenes phase by phase.
#pragma once

#include <algorithm>
#include <memory>
#include <numeric>
#include <vector>

#include "gem/engine/cuda_kernel.h"
#include "gem/engine/cuda_launch.cuh"
#include "gem/engine/cuda_memory.cuh"

namespace gem {
namespace {

/// Some scenes that go through the phases together, in a stream of their own beside those of others: what one waits
/// for, another fills.
class PhaseStream {
 public:
  PhaseStream(Arithmetic arithmetic, int multiprocessors)
      : arithmetic_(arithmetic), multiprocessors_(multiprocessors) {}

  /// The next call works on these scenes; `work` says where they lie, `bodies_blocks` how many blocks move the bodies
  /// of each, `streams` how many such streams share the device.
  void begin(const PhaseLaunch& work, const std::vector<int>& bodies_blocks, int streams, const Timeline& call) {
    time_.begin_after(call);
    work_ = work;
    work_.scene_count = static_cast<int>(bodies_blocks.size());
    list_grid_ = std::max(1, list_room() / streams);
    std::vector<PhaseBlock> block;
    add_blocks(block, bodies_blocks, 1);
    all_ = static_cast<int>(block.size());
    add_blocks(block, bodies_blocks, std::max(1, all_ * streams / (pairs_blocks * multiprocessors_)));
    some_ = static_cast<int>(block.size()) - all_;
    work_.blocks = reinterpret_cast<const PhaseBlock*>(send(block_memory_, block));
    work_.queue = reinterpret_cast<ListQueue*>(
        room(queue_memory_, sizeof(ListQueue) + sizeof(std::int32_t) * bodies_blocks.size()));
  }

  void launch(DevicePhase phase) {
    PhaseLaunch work = work_;
    int grid = all_, block = phase_threads;
    if (phase == DevicePhase::open || phase == DevicePhase::plan) grid = 1, block = plan_threads;
    if (phase == DevicePhase::list) grid = list_grid_;
    if (phase == DevicePhase::choose || phase == DevicePhase::look || phase == DevicePhase::resolve) {
      grid = some_;
      work.blocks += all_;
    }
    if (phase == DevicePhase::choose) work.room_bytes = choose_room;
    if (phase == DevicePhase::look) work.room_bytes = phase_threads / phase_lanes * sizeof(DeskOutlines);
    if (phase == DevicePhase::bodies) work.room_bytes = bodies_room;
    cudaLaunchConfig_t config{};
    config.gridDim = dim3(static_cast<unsigned>(grid));
    config.blockDim = dim3(static_cast<unsigned>(block));
    config.dynamicSmemBytes = work.room_bytes;
    config.stream = time_.stream();
    check_cuda(cudaLaunchKernelEx(&config, kernel_of_phase(phase), work), "start");
  }

  void end(const Timeline& call) {
    time_.end();
    call.wait_for(time_);
  }

 private:
  /// On one multiprocessor: more would only start and end.
  static constexpr int pairs_blocks = 16;

  /// Blocks that build lists and meet, of all streams: they have to be on the device at a time.
  int list_room() const {
    int together = 0;
    check_cuda(
        cudaOccupancyMaxActiveBlocksPerMultiprocessor(&together, kernel_of_phase(DevicePhase::list), phase_threads, 0),
        "be set up");
    return std::min(list_blocks, together) * multiprocessors_;
  }

  PhaseKernel kernel_of_phase(DevicePhase phase) const {
    return arithmetic_ == Arithmetic::fast ? fast_phase(phase) : strict_phase(phase);
  }

  /// The blocks of all scenes, for each as many as for its bodies over `share`.
  static void add_blocks(std::vector<PhaseBlock>& all, const std::vector<int>& bodies_blocks, int share) {
    for (std::size_t k = 0; k < bodies_blocks.size(); ++k) {
      const int blocks = (bodies_blocks[k] + share - 1) / share;
      for (int b = 0; b < blocks; ++b) all.push_back({static_cast<std::int32_t>(k), b, blocks});
    }
  }

  static std::byte* room(DeviceMemory& memory, std::size_t bytes) {
    if (memory.bytes() < bytes) memory = {}, memory = DeviceMemory(bytes);
    return memory.data();
  }
  std::byte* send(DeviceMemory& memory, const std::vector<PhaseBlock>& block) {
    const std::size_t bytes = sizeof(PhaseBlock) * block.size();
    std::byte* const to = room(memory, bytes);
    check_cuda(cudaMemcpyAsync(to, block.data(), bytes, cudaMemcpyHostToDevice, time_.stream()), "start");
    check_cuda(cudaStreamSynchronize(time_.stream()), "start");
    return to;
  }

  Arithmetic arithmetic_;
  int multiprocessors_;
  int all_ = 0, some_ = 0, list_grid_ = 1;  // blocks that move bodies, that work on pairs, that build lists
  PhaseLaunch work_{};
  Timeline time_;
  DeviceMemory block_memory_, queue_memory_;
};

/// All scenes of a call, shared out among some streams.
class PhaseStreams {
 public:
  PhaseStreams(Arithmetic arithmetic, int multiprocessors)
      : arithmetic_(arithmetic), multiprocessors_(multiprocessors) {}

  /// Starts a call between `call`'s beginning and its end: all phases of as many moments as the scene has that has
  /// most. `work` says where the scenes lie, `bodies_blocks` how many blocks move the bodies of each.
  void run(const PhaseLaunch& work, const std::vector<int>& bodies_blocks, std::int64_t moments, const Timeline& call) {
    const std::size_t scenes = bodies_blocks.size(), count = streams_for(bodies_blocks);
    while (stream_.size() < count) stream_.push_back(std::make_unique<PhaseStream>(arithmetic_, multiprocessors_));
    for (std::size_t k = 0; k < count; ++k) {
      const auto first = static_cast<std::ptrdiff_t>(scenes * k / count),
                 last = static_cast<std::ptrdiff_t>(scenes * (k + 1) / count);
      PhaseLaunch part = work;
      part.scenes += first;
      part.moments += first;
      part.gates += first;
      part.team_gates += first;
      stream_[k]->begin(part, {bodies_blocks.begin() + first, bodies_blocks.begin() + last}, static_cast<int>(count),
                        call);
    }
    each_phase(moments, [&](DevicePhase phase) {
      for (std::size_t k = 0; k < count; ++k) stream_[k]->launch(phase);
    });
    for (std::size_t k = 0; k < count; ++k) stream_[k]->end(call);
  }

 private:
  static constexpr std::size_t most_streams = 8;

  /// More streams than the blocks fill the device would each have too little to do.
  std::size_t streams_for(const std::vector<int>& bodies_blocks) const {
    const int blocks = std::accumulate(bodies_blocks.begin(), bodies_blocks.end(), 0);
    const auto useful = static_cast<std::size_t>(std::max(1, blocks / multiprocessors_));
    return std::min({bodies_blocks.size(), most_streams, useful});
  }

  Arithmetic arithmetic_;
  int multiprocessors_;
  std::vector<std::unique_ptr<PhaseStream>> stream_;
};

}  // namespace
}  // namespace gem
