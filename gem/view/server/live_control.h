// What the process of a run and the process of its page tell each other, in memory that both see.
#pragma once

#include <atomic>

namespace gem::view {

struct LiveControl {
  // from the run
  std::atomic<double> time_s = 0.0;
  std::atomic<double> duration_s = 0.0;
  std::atomic<bool> running = true;
  // from the page
  std::atomic<bool> paused = false;
  std::atomic<bool> stop = false;
  std::atomic<bool> has_all = false;  ///< a page has read the run to its end
  std::atomic<bool> gone = false;     ///< the page that asked last was closed
  std::atomic<int> port = 0;          ///< of the server; 0: not yet; -1: it could not begin
  std::atomic<long> requests = 0;
};

static_assert(std::atomic<double>::is_always_lock_free, "a lock would stand in the memory of one process");

}  // namespace gem::view
