// Threads that go through a step together: they share out index ranges and wait for each other between stages.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace gem {

/// A fixed number of threads, the caller among them. Waiting spins for a moment, then gives the processor away, so that
/// a machine busy with other work is not held up.
class ThreadTeam {
 public:
  explicit ThreadTeam(int threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  int size() const { return size_; }

  /// Runs task(rank) on every thread, rank 0 on the caller; returns when all are done. An exception thrown in single()
  /// is thrown again here.
  void run(const std::function<void(int)>& task);

  /// Inside run: waits for all threads.
  void barrier();

  /// Inside run: calls visit(i) for i in [0, count), an equal stretch on each thread, then waits for all.
  template <class Visit>
  void for_each(int rank, std::int64_t count, Visit&& visit) {
    for (std::int64_t i = begin_of(rank, count); i < begin_of(rank + 1, count); ++i) visit(i);
    barrier();
  }

  /// Inside run: calls work() on rank 0 while the others wait. After an exception in it, failed() is true.
  template <class Work>
  void single(int rank, Work&& work) {
    if (rank == 0) {
      try {
        work();
      } catch (...) {
        fault_ = std::current_exception();
      }
    }
    barrier();
  }

  bool failed() const { return fault_ != nullptr; }

  /// First index of `rank`'s stretch of [0, count).
  std::int64_t begin_of(int rank, std::int64_t count) const { return count * rank / size_; }

 private:
  void serve(int rank);

  const int size_;
  std::atomic<int> arrived_{0};
  std::atomic<std::uint32_t> phase_{0};
  std::exception_ptr fault_;

  std::mutex mutex_;
  std::condition_variable wake_;
  const std::function<void(int)>* task_ = nullptr;
  std::uint64_t calls_ = 0;
  bool closing_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace gem
