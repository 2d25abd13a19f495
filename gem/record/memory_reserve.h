// Address space that is held back, so that a run that finds memory too small can end in order.
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <new>

namespace gem {

/// The HDF5 library may crash when it gets no memory. So ask for more than it needs before it is called, and give it
/// the reserve when the answer was no.
class MemoryReserve {
 public:
  /// Throws std::bad_alloc if there is no room for it.
  MemoryReserve() : block_(take(held_bytes)) {
    if (block_ == MAP_FAILED) throw std::bad_alloc();
  }
  ~MemoryReserve() { release(); }
  MemoryReserve(const MemoryReserve&) = delete;
  MemoryReserve& operator=(const MemoryReserve&) = delete;

  /// Throws std::bad_alloc if fewer than `bytes`, and what the library needs besides, are left.
  static void ask(std::size_t bytes) {
    const std::size_t all = bytes + library_bytes;
    void* block = take(all);
    if (block == MAP_FAILED) throw std::bad_alloc();
    munmap(block, all);
  }
  void release() {
    if (block_ != MAP_FAILED) munmap(block_, held_bytes);
    block_ = MAP_FAILED;
  }

 private:
  // Chosen by hand.
  static constexpr std::size_t library_bytes = std::size_t{24} << 20;
  static constexpr std::size_t held_bytes = std::size_t{8} << 20;

  static void* take(std::size_t bytes) {
    return mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  }

  void* block_;
};

}  // namespace gem
