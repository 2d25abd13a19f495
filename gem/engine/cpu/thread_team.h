// Threads that go through a time step together: they divide index ranges and wait for each other between stages.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gem {

/// A fixed number of threads, including the caller. A wait spins for a short time and then yields the processor, so
/// that other programs on the machine are not slowed down.
class ThreadTeam {
 public:
  /// Throws Error(resource_limit) if the system cannot start so many threads.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return size_; }

  /// Runs task(rank) on every thread, rank 0 on the caller. Returns when all are done. If tasks throw, rethrows the
  /// first exception: the other threads abort at their next barrier, and the team can be used again.
  void run(const std::function<void(int)>& task);

  /// Inside run: waits for all threads. Throws an internal exception, which run() handles, if a thread has left.
  void barrier();

  /// Inside run: calls visit(i) for i in [0, count), an equal range on each thread, then waits for all threads.
  template <class Visit>
  void for_each(int rank, std::int64_t count, Visit&& visit) {
    for (std::int64_t i = begin_of(rank, count); i < begin_of(rank + 1, count); ++i) visit(i);
    barrier();
  }

  /// Inside run: calls visit(begin, end) for short ranges of [0, count), each on a free thread, without waiting at the
  /// end. At most once between two barriers. The length of a range was chosen by hand; it affects only speed.
  template <class Visit>
  void for_each_range(std::int64_t count, Visit&& visit) {
    constexpr std::int64_t stretch = 256;
    for (;;) {
      const std::int64_t begin = next_index_.fetch_add(stretch, std::memory_order_relaxed);
      if (begin >= count) return;
      visit(begin, std::min(begin + stretch, count));
    }
  }

  /// Inside run: calls work() on rank 0; the other threads go on.
  template <class Work>
  void on_rank_zero(int rank, Work&& work) {
    if (rank == 0) work();
  }

  /// Inside run: on_rank_zero(), then waits for all threads.
  template <class Work>
  void single(int rank, Work&& work) {
    on_rank_zero(rank, work);
    barrier();
  }

  /// First index of the range of `rank` in [0, count).
  std::int64_t begin_of(int rank, std::int64_t count) const { return count * rank / size_; }

 private:
  struct Aborted {};

  void worker_loop(int rank);
  /// Stops and joins the threads.
  void close();
  /// Runs the task and the final barrier; keeps an exception of the task.
  void run_task(const std::function<void(int)>& task, int rank);
  void abort_with(std::exception_ptr why);
  [[noreturn]] void rejoin_and_rethrow();

  const int size_;
  std::atomic<int> arrived_{0};
  std::atomic<std::uint32_t> phase_{0};
  std::atomic<std::int64_t> next_index_{0};  // since the last barrier
  std::atomic<bool> aborted_{false};         // a task has thrown
  std::atomic<int> exited_{0};               // threads that have left an aborted task

  std::mutex mutex_;
  std::condition_variable wake_;
  std::exception_ptr first_exception_;  // exception of the first task that threw
  const std::function<void(int)>* task_ = nullptr;
  std::uint64_t calls_ = 0;
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace gem
