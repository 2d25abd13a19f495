// Threads that help another one with a large island, whenever they have nothing else to do.
//
// The leader divides a task into parts. A helper takes a part that nobody has taken; the leader takes part 0 and then
// all that are left. So no part waits for a thread that has not come, and a task with one part costs nothing.
#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

#include "gem/base/spin.h"

namespace gem {

class IslandCrew {
 public:
  /// Makes ready for a time step. `threads`: leader and helpers; parts of a task.
  void begin(int threads) {
    parts_ = static_cast<std::uint64_t>(threads);
    released_.store(false, std::memory_order_relaxed);
  }
  int parts() const { return static_cast<int>(parts_); }

  /// Leader: calls work(part) for each part, and returns when all are done. Rethrows what a part has thrown.
  template <class Work>
  void share(Work&& work) {
    if (parts_ == 1) return work(0);
    using Plain = std::remove_reference_t<Work>;
    call_ = [](void* of, int part) { (*static_cast<Plain*>(of))(part); };
    work_ = const_cast<void*>(static_cast<const void*>(&work));
    done_.store(0, std::memory_order_relaxed);
    const std::uint64_t call = (next_.load(std::memory_order_relaxed) >> part_bits) + 1;
    next_.store((call << part_bits) + 1, std::memory_order_release);
    run(0);
    while (take_part()) {
    }
    for (Spin spin; done_.load(std::memory_order_acquire) < parts_;) spin.wait();
    if (failed_.load(std::memory_order_relaxed)) rethrow();
  }
  /// Leader: sends the helpers away until the next begin().
  void release() { released_.store(true, std::memory_order_release); }

  /// Helper: takes parts until release().
  void serve() {
    for (Spin spin; !released_.load(std::memory_order_acquire);) {
      if (take_part())
        spin = {};
      else
        spin.wait();
    }
  }

 private:
  static constexpr int part_bits = 16;

  /// Does a part that nobody has taken. Returns whether there was one.
  bool take_part() {
    std::uint64_t next = next_.load(std::memory_order_acquire);
    const std::uint64_t part = next & ((1U << part_bits) - 1);
    // before the first call no part is left either
    if (next == 0 || part >= parts_) return false;
    if (!next_.compare_exchange_strong(next, next + 1, std::memory_order_acq_rel)) return true;
    run(static_cast<int>(part));
    return true;
  }

  void run(int part) {
    try {
      call_(work_, part);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!exception_) exception_ = std::current_exception();
      failed_.store(true, std::memory_order_relaxed);
    }
    done_.fetch_add(1, std::memory_order_acq_rel);
  }

  [[noreturn]] void rethrow() {
    failed_.store(false, std::memory_order_relaxed);
    const std::lock_guard lock(mutex_);
    std::rethrow_exception(std::exchange(exception_, nullptr));
  }

  std::uint64_t parts_ = 1;
  void (*call_)(void*, int) = nullptr;
  void* work_ = nullptr;
  alignas(64) std::atomic<std::uint64_t> next_{0};  // number of the call, and the first part that nobody has taken
  alignas(64) std::atomic<std::uint64_t> done_{0};  // parts of this call
  std::atomic<bool> released_{true}, failed_{false};
  std::mutex mutex_;
  std::exception_ptr exception_;
};

/// Sends the helpers away at its end, also where the leader throws.
class CrewService {
 public:
  explicit CrewService(IslandCrew& crew) : crew_(crew) {}
  ~CrewService() { crew_.release(); }
  CrewService(const CrewService&) = delete;
  CrewService& operator=(const CrewService&) = delete;

 private:
  IslandCrew& crew_;
};

}  // namespace gem
