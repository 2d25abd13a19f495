// Chooses between all threads and one thread during a run: more threads only help if processors are free.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace gem {

/// Measures stretches of time steps with all threads and with one thread, and keeps the faster choice. The other choice
/// is tried again now and then, less often each time it loses. The choice cannot change a result, since every number of
/// threads gives the same bits. All numbers here were chosen by hand and affect only speed.
class TeamChoice {
 public:
  /// Time steps to run before the next call of note(). A trial of one thread, which is usually slower, is short. A
  /// trial of all threads is longer, since some of them must wake up first.
  std::int64_t stretch(std::int64_t steps) const {
    return std::min<std::int64_t>(steps, on_trial_ && !all_threads_ ? 4 : 16);
  }
  bool all_threads() const { return all_threads_; }
  /// How often the choice has changed.
  std::int64_t changes() const { return changes_; }

  void start() { start_ = std::chrono::steady_clock::now(); }

  /// Reports that `steps` time steps have run since start().
  void note(std::int64_t steps) {
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    double& cost = cost_[all_threads_ ? 1 : 0];
    const double now = seconds / static_cast<double>(steps);
    cost = cost > 0.0 ? 0.5 * (cost + now) : now;
    if (on_trial_) {
      const bool was = all_threads_;
      const bool won = cost_[all_threads_ ? 1 : 0] < cost_[all_threads_ ? 0 : 1];
      wait_ = won ? shortest_wait : std::min(2 * wait_, longest_wait);
      all_threads_ = all_threads_ == won;
      changes_ += all_threads_ != was;
      on_trial_ = false;
      waited_ = 0;
    } else if (++waited_ >= wait_) {
      cost_[all_threads_ ? 0 : 1] = 0.0;  // an old measurement says little
      all_threads_ = !all_threads_;
      ++changes_;
      on_trial_ = true;
    }
  }

 private:
  static constexpr std::int64_t shortest_wait = 16, longest_wait = 512;  // stretches between trials

  bool all_threads_ = true;
  bool on_trial_ = false;
  std::int64_t wait_ = 4, waited_ = 0, changes_ = 0;
  double cost_[2] = {0.0, 0.0};  // seconds per time step with one thread and with all
  std::chrono::steady_clock::time_point start_;
};

}  // namespace gem
