// What one process of a sweep does, and the board on which it says how far it is.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <vector>

#include "gem/command/sweep_folder.h"
#include "gem/engine/engine.h"
#include "gem/scene/sweep.h"

namespace gem {

/// How a run of a sweep ended. `elsewhere`: another process is at it.
enum class Outcome : int { waiting, running, done, already_done, failed, stopped, elsewhere };

/// Memory that a process shares with those that it starts.
class SweepBoard {
 public:
  struct Entry {
    std::atomic<double> time;  // simulated by this sweep [s]
    std::atomic<Outcome> outcome;
    std::atomic<int> exit_code;  // of a failure
  };

  explicit SweepBoard(std::size_t runs);
  ~SweepBoard();
  SweepBoard(const SweepBoard&) = delete;
  SweepBoard& operator=(const SweepBoard&) = delete;
  /// Number of the signal to stop for; 0: go on.
  std::atomic<int>& stop() { return *stop_; }
  Entry& operator[](std::size_t run) { return entries_[run]; }

 private:
  std::size_t bytes_;
  std::atomic<int>* stop_;
  Entry* entries_;
};

/// How all runs of a sweep are made.
struct SweepSettings {
  std::string folder;
  EngineOptions engine;
  bool overwrite = false;
  std::string command_line;
};

/// The row of a run that nothing is known of yet.
SweepRow row_of(const SweepMember& member);

/// Runs one member into its file unless that is done or another process is at it; writes its row and its entry of the
/// board. Never throws: a fault is the run's own.
void run_sweep_member(const SweepMember& member, const SweepSettings& settings, SweepBoard::Entry& entry,
                      const std::atomic<int>& stop);

}  // namespace gem
