// What a barrier of the CUDA engine costs by itself, for the layouts that gem_cuda_speed times: a row of CSV each.
// usage: gem_cuda_barriers
#include <cstdio>

#include "gem/engine/cuda/cuda_launch.cuh"
#include "gem/engine/cuda/thread_groups.cuh"
#include "gem_version.h"

namespace gem {
namespace {

constexpr int barriers = 20000;

template <class Crew>
__global__ void __launch_bounds__(most_threads, 1) meet(int blocks, CrewGate* gate) {
  __shared__ BlockCell cell;
  __shared__ StageClock clock;
  Crew crew(BlockRoom{cell, clock, nullptr, 0, false}, blocks, gate);
  for (int k = 0; k < barriers; ++k) crew.barrier();
}

/// Time of one barrier [s], the fastest of some launches.
double time_of(const Spread& spread) {
  const auto kernel = spread.gated() ? meet<GateCrew> : meet<ClusterCrew>;
  check_cuda(cudaFuncSetAttribute(kernel, cudaFuncAttributeNonPortableClusterSizeAllowed, 1), "be set up");
  const DeviceMemory gate(sizeof(CrewGate));
  Timeline time;
  const LaunchConfig config(spread, 0, time.stream());
  double least = 1e9;
  for (int launch = 0; launch < 4; ++launch) {
    check_cuda(cudaMemset(gate.data(), 0, sizeof(CrewGate)), "clear a gate");
    check_cuda(cudaDeviceSynchronize(), "clear a gate");
    time.begin();
    check_cuda(cudaLaunchKernelEx(&config.config, kernel, spread.blocks, reinterpret_cast<CrewGate*>(gate.data())),
               "start");
    time.end();
    check_cuda(cudaStreamSynchronize(time.stream()), "be timed");
    least = std::min(least, time.seconds() / barriers);
  }
  return least;
}

void rows() {
  const CudaDevice device = usable_cuda_device();
  std::printf("commit,device,blocks,threads,microseconds\n");
  for (const int blocks : {1, 2, 4, 8, 16, 32, 64, 112, 132})
    for (const int threads : {128, 256}) {
      if (blocks > device.multiprocessors) continue;
      std::printf("%s,%s,%d,%d,%.4f\n", GEM_COMMIT, device.name.c_str(), blocks, threads,
                  1e6 * time_of({Arithmetic::strict, 1, blocks, threads}));
    }
}

}  // namespace
}  // namespace gem

int main() {
  try {
    gem::rows();
    return 0;
  } catch (const gem::Error& error) {
    std::fprintf(stderr, "gem_cuda_barriers: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
