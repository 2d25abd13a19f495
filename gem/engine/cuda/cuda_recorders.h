// Host threads that append what the scenes of a batch have recorded to their logs.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

#include "gem/base/error.h"
#include "gem/engine/cpu/thread_team.h"

namespace gem {

class Recorders {
 public:
  /// For a batch of `scenes` scenes.
  explicit Recorders(std::size_t scenes)
      : threads_(std::min<std::size_t>({scenes / scenes_worth_a_thread, most, std::thread::hardware_concurrency()})) {}

  /// Calls append(scene) for each of some scenes, by several threads if there are many.
  template <class Append>
  void record(const std::vector<std::size_t>& scenes, Append&& append) {
    if (scenes.size() < 2 * scenes_worth_a_thread || !start_threads()) {
      for (const std::size_t k : scenes) append(k);
      return;
    }
    const auto count = static_cast<std::int64_t>(scenes.size());
    team_->run([&](int rank) {
      for (std::int64_t at = team_->begin_of(rank, count); at < team_->begin_of(rank + 1, count); ++at)
        append(scenes[static_cast<std::size_t>(at)]);
    });
  }

 private:
  static constexpr std::size_t most = 8, scenes_worth_a_thread = 8;

  /// Starts the threads if there are none. Returns whether there are some: if the system gives none, the caller does
  /// the work.
  bool start_threads() {
    if (team_ || threads_ < 2) return team_ != nullptr;
    try {
      team_ = std::make_unique<ThreadTeam>(static_cast<int>(threads_));
    } catch (const Error&) {
      return false;
    }
    return true;
  }

  std::size_t threads_;
  std::unique_ptr<ThreadTeam> team_;
};

}  // namespace gem
