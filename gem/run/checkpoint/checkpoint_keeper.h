// When a run leaves its next checkpoint, and writing it on the thread of the run file while the run goes on.
#pragma once

#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <mutex>
#include <string>

#include "gem/run/checkpoint/checkpoint.h"

namespace gem {

/// Processor time of the calling thread [s].
double thread_seconds();

/// A checkpoint whose state was taken, on its way to the disk.
struct TakenCheckpoint {
  Checkpoint state;
  std::timespec time{};  // when it was taken; becomes the time of its file
  double cost = 0.0;     // processor time that taking it took [s]
};

class CheckpointKeeper {
 public:
  /// `interval_s`: wall time between two checkpoints; 0: none. The first one comes earlier.
  explicit CheckpointKeeper(double interval_s);

  bool on() const { return interval_ > 0.0; }
  /// Starts the wall clock; the first checkpoint has the number `serial`.
  void begin(std::uint64_t serial);
  /// Whether the next checkpoint should be taken: its time has come, the last one is on the disk, and checkpoints have
  /// not cost too much so far.
  bool is_due() const;
  /// Marks the moment at which a state is taken.
  void start(TakenCheckpoint& taken);
  /// Writes a state that was taken. For another thread than the other members, one call at a time. Does not throw.
  void write(const std::string& run_file, TakenCheckpoint& taken);
  /// Why the first checkpoint that failed could not be written; told once, then empty.
  std::string take_fault();

 private:
  using Clock = std::chrono::steady_clock;

  double interval_;
  double pause_;  // wall time from the last state, or from the start, to the next one [s]
  Clock::time_point begun_at_, taken_at_;
  std::uint64_t serial_ = 0;           // of the next one; used by write() only once the run has begun
  std::atomic<double> spent_ = 0.0;    // processor time of all checkpoints so far [s]
  std::atomic<int> on_their_way_ = 0;  // taken, not yet written
  std::mutex mutex_;                   // of the two members below
  std::string fault_;
  bool told_ = false;
};

}  // namespace gem
