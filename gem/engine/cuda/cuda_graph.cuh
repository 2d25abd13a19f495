// Launches that are recorded once and then started together, which costs the host a fraction of the time.
#pragma once

#include <cuda_runtime.h>

#include "gem/engine/cuda/cuda_memory.cuh"

namespace gem {
namespace {

/// A sequence of launches in one stream.
class RecordedLaunches {
 public:
  RecordedLaunches() = default;
  ~RecordedLaunches() { forget(); }
  RecordedLaunches(const RecordedLaunches&) = delete;
  RecordedLaunches& operator=(const RecordedLaunches&) = delete;

  /// Records what `launches` starts in `stream`, in place of any earlier record.
  template <class Launches>
  void record(cudaStream_t stream, Launches&& launches) {
    forget();
    cudaGraph_t graph = nullptr;
    check_cuda(cudaStreamBeginCapture(stream, cudaStreamCaptureModeThreadLocal), "record launches");
    try {
      launches();
    } catch (...) {
      cudaStreamEndCapture(stream, &graph);
      if (graph) cudaGraphDestroy(graph);
      throw;
    }
    check_cuda(cudaStreamEndCapture(stream, &graph), "record launches");
    const cudaError_t made = cudaGraphInstantiate(&recorded_, graph, 0);
    cudaGraphDestroy(graph);
    check_cuda(made, "record launches");
  }
  void start(cudaStream_t stream) const { check_cuda(cudaGraphLaunch(recorded_, stream), "start the work"); }

 private:
  void forget() {
    if (recorded_) cudaGraphExecDestroy(recorded_);
    recorded_ = nullptr;
  }

  cudaGraphExec_t recorded_ = nullptr;
};

}  // namespace
}  // namespace gem
