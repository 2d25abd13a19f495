// Start, barriers and exceptions of a team of threads.
#include "gem/engine/cpu/thread_team.h"

#include <string>
#include <system_error>
#include <utility>

#include "gem/base/error.h"
#include "gem/base/fault_stack.h"
#include "gem/base/spin.h"

namespace gem {

ThreadTeam::ThreadTeam(int threads) : size_(threads) {
  threads_.reserve(static_cast<std::size_t>(size_ - 1));
  try {
    for (int rank = 1; rank < size_; ++rank) threads_.emplace_back([this, rank] { worker_loop(rank); });
  } catch (const std::system_error& error) {
    close();
    throw Error(ExitCode::resource_limit, "cannot start " + std::to_string(size_) + " threads (" + error.what() +
                                              "); ask for fewer with --threads, or run fewer programs at once");
  } catch (...) {
    close();
    throw;
  }
}

ThreadTeam::~ThreadTeam() { close(); }

void ThreadTeam::close() {
  {
    const std::lock_guard lock(mutex_);
    closing_ = true;
  }
  wake_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::worker_loop(int rank) {
  const FaultStack stack;
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
    run_task(*task, rank);
  }
}

void ThreadTeam::run_task(const std::function<void(int)>& task, int rank) {
  try {
    task(rank);
    barrier();
  } catch (const Aborted&) {
    exited_.fetch_add(1, std::memory_order_release);
  } catch (...) {
    abort_with(std::current_exception());
    exited_.fetch_add(1, std::memory_order_release);
  }
}

/// The thread that left does not reach the barrier. The others wait there and see that the run is aborted.
void ThreadTeam::abort_with(std::exception_ptr why) {
  const std::lock_guard lock(mutex_);
  if (!first_exception_) first_exception_ = std::move(why);
  aborted_.store(true, std::memory_order_release);
}

void ThreadTeam::rejoin_and_rethrow() {
  while (exited_.load(std::memory_order_acquire) < size_) std::this_thread::yield();
  exited_.store(0, std::memory_order_relaxed);
  arrived_.store(0, std::memory_order_relaxed);
  next_index_.store(0, std::memory_order_relaxed);
  aborted_.store(false, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  std::rethrow_exception(std::exchange(first_exception_, nullptr));
}

void ThreadTeam::run(const std::function<void(int)>& task) {
  if (size_ > 1) {
    {
      const std::lock_guard lock(mutex_);
      task_ = &task;
      ++calls_;
    }
    wake_.notify_all();
  }
  run_task(task, 0);
  if (aborted_.load(std::memory_order_acquire)) rejoin_and_rethrow();
}

void ThreadTeam::barrier() {
  const std::uint32_t phase = phase_.load(std::memory_order_acquire);
  if (size_ == 1 || arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == size_) {
    arrived_.store(0, std::memory_order_relaxed);
    next_index_.store(0, std::memory_order_relaxed);
    phase_.store(phase + 1, std::memory_order_release);
    return;
  }
  for (Spin spin; phase_.load(std::memory_order_acquire) == phase; spin.wait()) {
    // A fast thread may already be in the next run and abort it while this thread is still here. So the phase is
    // read again.
    if (aborted_.load(std::memory_order_acquire) && phase_.load(std::memory_order_acquire) == phase) throw Aborted{};
  }
}

}  // namespace gem
