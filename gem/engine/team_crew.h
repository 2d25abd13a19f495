// For tests: a crew of host threads in several blocks, so that what blocks and threads share is tried without a GPU.
#pragma once

#include <atomic>
#include <barrier>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "gem/engine/crew.h"

namespace gem::test {

/// What the threads of a team meet at.
struct TeamHall {
  TeamHall(int block_count, int thread_count)
      : blocks(block_count), threads(thread_count), all(block_count * thread_count), cell(block_count) {
    for (int k = 0; k < block_count; ++k) block.push_back(std::make_unique<std::barrier<>>(thread_count));
  }

  int blocks, threads;
  std::barrier<> all;
  std::vector<std::unique_ptr<std::barrier<>>> block;
  std::vector<BlockCell> cell;
};

class TeamCrew {
 public:
  using Lanes = OneLane;
  using Warp = OneLane;

  TeamCrew(TeamHall& hall, int block, int thread) : hall_(hall), block_(block), thread_(thread) {}

  int block() const { return block_; }
  int blocks() const { return hall_.blocks; }
  int thread() const { return thread_; }
  int threads() const { return hall_.threads; }
  Lanes lanes() const { return {}; }
  Warp warp() const { return {}; }
  void barrier() { hall_.all.arrive_and_wait(); }
  void block_barrier() { hall_.block[std::size_t(block_)]->arrive_and_wait(); }
  BlockCell& shared() { return hall_.cell[std::size_t(block_)]; }
  void raise(std::uint32_t alarms) {
    for (BlockCell& cell : hall_.cell) std::atomic_ref(cell.alarms).fetch_or(alarms);
  }
  std::uint32_t alarms() const { return std::atomic_ref(hall_.cell[std::size_t(block_)].alarms).load(); }
  void lower_alarms() {
    if (thread_ == 0) std::atomic_ref(shared().alarms).store(0);
  }

  template <class T>
  static T add(T* sum, T value) {
    return std::atomic_ref(*sum).fetch_add(value);
  }
  template <class T>
  static void highest(T* value, T other) {
    std::atomic_ref<T> now(*value);
    for (T seen = now.load(); other > seen && !now.compare_exchange_weak(seen, other);) {
    }
  }
  static void set_bit(std::uint32_t* word, std::uint32_t bit) { std::atomic_ref(*word).fetch_or(bit); }

 private:
  TeamHall& hall_;
  int block_, thread_;
};

/// Runs work(crew) on every thread of a team.
inline void run_team(int blocks, int threads, const std::function<void(TeamCrew&)>& work) {
  TeamHall hall(blocks, threads);
  std::vector<std::thread> team;
  for (int b = 0; b < blocks; ++b)
    for (int t = 0; t < threads; ++t)
      team.emplace_back([&, b, t] {
        TeamCrew crew(hall, b, t);
        work(crew);
      });
  for (std::thread& thread : team) thread.join();
}

}  // namespace gem::test
