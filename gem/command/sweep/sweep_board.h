// Memory in which the processes of a sweep report their progress.
#pragma once

#include <atomic>
#include <cstddef>

namespace gem {

/// How a run of a sweep ended. `elsewhere`: another process is running it.
enum class Outcome : int { waiting, running, done, already_done, failed, stopped, elsewhere };

/// Memory that a process shares with its child processes.
class SweepBoard {
 public:
  struct Entry {
    std::atomic<double> time;  // simulated by this sweep [s]
    std::atomic<Outcome> outcome;
    std::atomic<int> exit_code;  // of a failed run
  };

  explicit SweepBoard(std::size_t runs);
  ~SweepBoard();
  SweepBoard(const SweepBoard&) = delete;
  SweepBoard& operator=(const SweepBoard&) = delete;
  /// The signal that asks all processes to stop; 0: continue.
  std::atomic<int>& stop() { return *stop_; }
  Entry& operator[](std::size_t run) { return entries_[run]; }

 private:
  std::size_t bytes_;
  std::atomic<int>* stop_;
  Entry* entries_;
};

}  // namespace gem
