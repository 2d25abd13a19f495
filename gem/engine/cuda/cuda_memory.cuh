// Memory of the device and of the host as the device sees it, and the check of every CUDA call.
#pragma once

#include <cuda_runtime.h>

#include <cstddef>
#include <string>
#include <utility>

#include "gem/base/error.h"
#include "gem/base/number_text.h"

namespace gem {

/// Throws Error(device) where a CUDA call failed; `what` says what it was for.
inline void check_cuda(cudaError_t result, const char* what) {
  if (result == cudaSuccess) return;
  cudaGetLastError();  // the next call starts afresh
  throw Error(ExitCode::device, std::string("the GPU failed to ") + what + " (" + cudaGetErrorString(result) +
                                    ") see gem devices, or use --engine cpu");
}

inline std::string megabytes(std::size_t bytes) { return fixed_text(static_cast<double>(bytes) / 1e6, 1) + " MB"; }

/// Memory of the device; freed with its owner.
class DeviceMemory {
 public:
  DeviceMemory() = default;
  explicit DeviceMemory(std::size_t bytes) : bytes_(bytes) {
    const cudaError_t result = cudaMalloc(&data_, bytes);
    if (result == cudaErrorMemoryAllocation) {
      cudaGetLastError();
      std::size_t free = 0, total = 0;
      cudaMemGetInfo(&free, &total);
      throw Error(ExitCode::resource_limit, "the GPU's memory is too small (" + megabytes(bytes) +
                                                " more are needed, " + megabytes(free) + " of " + megabytes(total) +
                                                " are free) use fewer scenes or floes, or --engine cpu");
    }
    check_cuda(result, "give memory");
  }
  ~DeviceMemory() { cudaFree(data_); }
  DeviceMemory(DeviceMemory&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  DeviceMemory& operator=(DeviceMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  std::byte* data() const { return static_cast<std::byte*>(data_); }
  std::size_t bytes() const { return bytes_; }
  /// Holds so many bytes or more from now on; what it held is lost where it has to grow.
  void load(std::size_t bytes) {
    if (bytes_ >= bytes) return;
    *this = DeviceMemory();  // the old one goes first
    *this = DeviceMemory(bytes);
  }

 private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

/// Memory of the host that the device copies to while other work goes on.
class PinnedMemory {
 public:
  PinnedMemory() = default;
  explicit PinnedMemory(std::size_t bytes) : bytes_(bytes) {
    check_cuda(cudaMallocHost(&data_, bytes), "give memory for transfers");
  }
  ~PinnedMemory() { cudaFreeHost(data_); }
  PinnedMemory(PinnedMemory&& other) noexcept
      : data_(std::exchange(other.data_, nullptr)), bytes_(std::exchange(other.bytes_, 0)) {}
  PinnedMemory& operator=(PinnedMemory&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(bytes_, other.bytes_);
    return *this;
  }
  std::byte* data() const { return static_cast<std::byte*>(data_); }
  std::size_t bytes() const { return bytes_; }

 private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

}  // namespace gem
