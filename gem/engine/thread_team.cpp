#include "gem/engine/thread_team.h"

namespace gem {
namespace {

/// About 20 microseconds of waiting before the processor is given away.
constexpr int spins = 2000;

/// Tells the processor that this is a waiting loop.
inline void relax() {
#ifdef __x86_64__
  __builtin_ia32_pause();
#endif
}

}  // namespace

ThreadTeam::ThreadTeam(int threads) : size_(threads) {
  for (int rank = 1; rank < size_; ++rank) threads_.emplace_back([this, rank] { serve(rank); });
}

ThreadTeam::~ThreadTeam() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::serve(int rank) {
  std::uint64_t served = 0;
  for (;;) {
    const std::function<void(int)>* task = nullptr;
    {
      std::unique_lock lock(mutex_);
      wake_.wait(lock, [&] { return closing_ || calls_ != served; });
      if (closing_) return;
      served = calls_;
      task = task_;
    }
    (*task)(rank);
    barrier();
  }
}

void ThreadTeam::run(const std::function<void(int)>& task) {
  fault_ = nullptr;
  if (size_ > 1) {
    {
      const std::lock_guard lock(mutex_);
      task_ = &task;
      ++calls_;
    }
    wake_.notify_all();
  }
  task(0);
  barrier();
  if (fault_) std::rethrow_exception(fault_);
}

void ThreadTeam::barrier() {
  const std::uint32_t phase = phase_.load(std::memory_order_acquire);
  if (size_ == 1 || arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
    arrived_.store(0, std::memory_order_relaxed);
    handed_out_.store(0, std::memory_order_relaxed);
    phase_.store(phase + 1, std::memory_order_release);
    return;
  }
  for (int spin = 0; phase_.load(std::memory_order_acquire) == phase; ++spin) {
    if (spin < spins) {
      relax();
    } else {
      std::this_thread::yield();
    }
  }
}

}  // namespace gem
