// Lists the GPUs of this machine, with the reason if one cannot be used.
#include <cuda_runtime.h>

#include "gem/base/error.h"
#include "gem/engine/cuda/cuda_engine.h"

namespace gem {
namespace {

constexpr int oldest_major = 9;  // the kernels use clusters of blocks

std::string version_text(int version) {
  return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

CudaDevice describe(int index) {
  CudaDevice device;
  device.index = index;
  cudaDeviceProp properties{};
  const cudaError_t known = cudaGetDeviceProperties(&properties, index);
  if (known != cudaSuccess) {
    device.fault = cudaGetErrorString(known);
    return device;
  }
  int driver = 0;
  cudaDriverGetVersion(&driver);
  device.name = properties.name;
  device.driver = "CUDA " + version_text(driver);
  device.memory = properties.totalGlobalMem;
  device.multiprocessors = properties.multiProcessorCount;
  if (properties.major < oldest_major) {
    device.fault = "compute capability " + std::to_string(properties.major) + "." + std::to_string(properties.minor) +
                   ", 9.0 is needed";
    return device;
  }
  std::size_t total = 0;
  const cudaError_t answers =
      cudaSetDevice(index) == cudaSuccess ? cudaMemGetInfo(&device.free_memory, &total) : cudaGetLastError();
  if (answers != cudaSuccess) device.fault = cudaGetErrorString(answers);
  return device;
}

}  // namespace

std::vector<CudaDevice> cuda_devices(std::string& reason) {
  int count = 0;
  const cudaError_t result = cudaGetDeviceCount(&count);
  std::vector<CudaDevice> devices;
  if (result != cudaSuccess) {
    cudaGetLastError();
    reason = cudaGetErrorString(result);
    return devices;
  }
  if (count == 0) reason = "the driver reports no GPU";
  for (int k = 0; k < count; ++k) devices.push_back(describe(k));
  return devices;
}

CudaDevice usable_cuda_device() {
  std::string reason;
  for (const CudaDevice& device : cuda_devices(reason)) {
    if (device.fault.empty()) return device;
    reason = device.name + ": " + device.fault;
  }
  throw Error(ExitCode::device, "no GPU can be used (" + reason + "); use --engine cpu");
}

}  // namespace gem
