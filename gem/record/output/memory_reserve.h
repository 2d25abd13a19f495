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

  /// What the library needs besides the rows: to lay out a file, where the allocator also takes 64 MB of addresses for
  /// a thread, for writing, and for the end of a run. Chosen by hand.
  static constexpr std::size_t to_begin = std::size_t{112} << 20;
  static constexpr std::size_t to_write = std::size_t{24} << 20;
  static constexpr std::size_t to_end = std::size_t{6} << 20;

  /// Whether so many bytes can be had.
  static bool has(std::size_t bytes) {
    void* block = take(bytes);
    if (block == MAP_FAILED) return false;
    munmap(block, bytes);
    return true;
  }
  void release() {
    if (block_ != MAP_FAILED) munmap(block_, held_bytes);
    block_ = MAP_FAILED;
  }

 private:
  static constexpr std::size_t held_bytes = std::size_t{8} << 20;

  static void* take(std::size_t bytes) {
    return mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  }

  void* block_;
};

}  // namespace gem
