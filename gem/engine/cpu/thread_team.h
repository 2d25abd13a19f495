// Threads that go through a step together: they share out index ranges and wait for each other between stages.
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

/// A fixed number of threads, the caller among them. Waiting spins for a time step, then gives the processor away, so
/// that a machine busy with other work is not held up.
class ThreadTeam {
 public:
  /// Throws Error(resource_limit) if the system does not give so many threads.
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return size_; }

  /// Runs task(rank) on every thread, rank 0 on the caller; returns when all are done. An exception thrown in single()
  /// is thrown again here. So is one that leaves a task, the first of several: the other threads are called off at
  /// their next barrier, and the team is as good as new.
  void run(const std::function<void(int)>& task);

  /// Inside run: waits for all threads. Throws what run() catches if one of them will not come.
  void barrier();

  /// Inside run: calls visit(i) for i in [0, count), an equal stretch on each thread, then waits for all.
  template <class Visit>
  void for_each(int rank, std::int64_t count, Visit&& visit) {
    for (std::int64_t i = begin_of(rank, count); i < begin_of(rank + 1, count); ++i) visit(i);
    barrier();
  }

  /// Inside run: calls visit(begin, end) with short stretches of [0, count), on whichever thread is free; at most once
  /// between two barriers. Does not wait for the others.
  template <class Visit>
  void hand_out(std::int64_t count, Visit&& visit) {
    constexpr std::int64_t stretch = 256;
    for (;;) {
      const std::int64_t begin = handed_out_.fetch_add(stretch, std::memory_order_relaxed);
      if (begin >= count) return;
      visit(begin, std::min(begin + stretch, count));
    }
  }

  /// Inside run: calls work() on rank 0 while the others go on. After an exception in it and a barrier, failed() is
  /// true.
  template <class Work>
  void first_alone(int rank, Work&& work) {
    if (rank != 0) return;
    try {
      work();
    } catch (...) {
      fault_ = std::current_exception();
    }
  }

  /// The same while the others wait.
  template <class Work>
  void single(int rank, Work&& work) {
    first_alone(rank, work);
    barrier();
  }

  bool failed() const { return fault_ != nullptr; }

  /// First index of `rank`'s stretch of [0, count).
  std::int64_t begin_of(int rank, std::int64_t count) const { return count * rank / size_; }

 private:
  struct CalledOff {};

  void serve(int rank);
  /// Sends the threads home and waits for them.
  void close();
  /// The task and the barrier behind it; notes what the task throws.
  void carry_out(const std::function<void(int)>& task, int rank);
  void note_left(std::exception_ptr why);
  [[noreturn]] void gather_again();

  const int size_;
  std::atomic<int> arrived_{0};
  std::atomic<std::uint32_t> phase_{0};
  std::atomic<std::int64_t> handed_out_{0};  // since the last barrier
  std::atomic<bool> called_off_{false};      // a thread has left its task by an exception
  std::atomic<int> gone_{0};                 // threads that are out of a task that was called off
  std::exception_ptr fault_;

  std::mutex mutex_;
  std::condition_variable wake_;
  std::exception_ptr left_by_;  // why the first thread left
  const std::function<void(int)>* task_ = nullptr;
  std::uint64_t calls_ = 0;
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace gem
