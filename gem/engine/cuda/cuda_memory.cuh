// Memory of the device, pinned memory of the host, and the check of every CUDA call.
#pragma once

#include <cuda_runtime.h>

#include <cstddef>
#include <string>
#include <utility>

#include "gem/base/error.h"
#include "gem/base/number_text.h"

namespace gem {

/// Throws Error(device) if a CUDA call failed. `what` completes "the GPU call failed: cannot".
inline void check_cuda(cudaError_t result, const char* what) {
  if (result == cudaSuccess) return;
  cudaGetLastError();  // clears the error for the next call
  throw Error(ExitCode::device, std::string("the GPU call failed: cannot ") + what + " (" + cudaGetErrorString(result) +
                                    "); see gem devices, or use --engine cpu");
}

inline std::string megabytes(std::size_t bytes) { return fixed_text(static_cast<double>(bytes) / 1e6, 1) + " MB"; }

/// Memory of the device, freed with its owner.
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
                                                " are free); use fewer scenes or floes, or --engine cpu");
    }
    check_cuda(result, "allocate memory");
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
  /// Grows the memory to at least `bytes`. Growing discards the contents.
  void reserve(std::size_t bytes) {
    if (bytes_ >= bytes) return;
    *this = DeviceMemory();  // free the old memory first
    *this = DeviceMemory(bytes);
  }

 private:
  void* data_ = nullptr;
  std::size_t bytes_ = 0;
};

/// Page-locked host memory, for copies that run beside other work.
class PinnedMemory {
 public:
  PinnedMemory() = default;
  explicit PinnedMemory(std::size_t bytes) : bytes_(bytes) {
    check_cuda(cudaMallocHost(&data_, bytes), "allocate pinned memory");
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
