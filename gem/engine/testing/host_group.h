// For tests: thread groups made of host threads in several blocks. They test without a GPU what blocks and threads
// share.
#pragma once

#include <algorithm>
#include <atomic>
#include <barrier>
#include <bit>
#include <cstddef>
#include <cstring>
#include <functional>
#include <memory>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "gem/engine/device/thread_group.h"
#include "gem/engine/solver/device/device_points_cells.h"

namespace gem::test {

/// Threads of a lane group and of a warp. All of them must take part in every exchange.
constexpr int team_lanes = 2, team_warp = 4;

template <int lanes>
struct GroupExchange {
  std::barrier<> meet{lanes};
  alignas(16) std::byte value[lanes][64];
};

template <int lanes>
class TeamLanes {
 public:
  static constexpr int size = lanes;

  TeamLanes(GroupExchange<lanes>& exchange, int rank) : exchange_(&exchange), rank_(rank) {}

  int rank() const { return rank_; }
  template <class T>
  T from(const T& mine, int lane) const {
    static_assert(sizeof(T) <= sizeof exchange_->value[0]);
    std::memcpy(exchange_->value[rank_], &mine, sizeof(T));
    exchange_->meet.arrive_and_wait();
    T theirs;
    std::memcpy(&theirs, exchange_->value[lane], sizeof(T));
    exchange_->meet.arrive_and_wait();
    return theirs;
  }
  template <class T>
  T partner(const T& mine, int step) const {
    return from(mine, rank_ ^ step);
  }
  unsigned ballot(bool mine) const {
    unsigned bits = 0;
    for (int k = 0; k < size; ++k) bits |= from(mine, k) ? 1U << k : 0U;
    return bits;
  }
  void sync() const { exchange_->meet.arrive_and_wait(); }
  int count(unsigned bits) const { return std::popcount(bits); }
  int count_below(unsigned bits) const { return std::popcount(bits & ((1U << rank_) - 1U)); }
  int lowest(unsigned bits) const { return std::countr_zero(bits); }
  int sum_below(int mine) const {
    int sum = 0;
    for (int k = 0; k < size; ++k) {
      const int other = from(mine, k);
      if (k < rank_) sum += other;
    }
    return sum;
  }
  std::uint32_t highest(std::uint32_t mine) const {
    std::uint32_t most = mine;
    for (int k = 0; k < size; ++k) most = std::max(most, from(mine, k));
    return most;
  }
  int sum(int mine) const {
    int sum = 0;
    for (int k = 0; k < size; ++k) sum += from(mine, k);
    return sum;
  }

 private:
  GroupExchange<lanes>* exchange_;
  int rank_;
};

/// Barriers and shared data of a team.
struct TeamState {
  TeamState(int block_count, int thread_count, std::size_t shared_bytes)
      : blocks(block_count),
        threads(thread_count),
        all(block_count * thread_count),
        cell(block_count),
        shared_memory(block_count, std::vector<std::byte>(shared_bytes)) {
    for (int k = 0; k < block_count; ++k) block.push_back(std::make_unique<std::barrier<>>(thread_count));
    const int all_threads = block_count * thread_count;
    part.resize(std::size_t(all_threads));
    for (int k = 0; k < all_threads / team_lanes; ++k)
      lane_group.push_back(std::make_unique<GroupExchange<team_lanes>>());
    for (int k = 0; k < all_threads / team_warp; ++k) warp.push_back(std::make_unique<GroupExchange<team_warp>>());
  }

  int blocks, threads;
  std::barrier<> all;
  std::vector<std::unique_ptr<std::barrier<>>> block;
  std::vector<std::unique_ptr<GroupExchange<team_lanes>>> lane_group;
  std::vector<std::unique_ptr<GroupExchange<team_warp>>> warp;
  std::vector<BlockCell> cell;
  std::vector<std::vector<std::byte>> shared_memory;
  /// The state of one thread at the barrier of all threads.
  struct Part {
    int barriers = 0;
    std::optional<std::barrier<>::arrival_token> arrived;
  };
  std::vector<Part> part;
};

/// A thread group for a resident scene: the same blocks run all of its stages.
class HostGroup {
 public:
  using Lanes = TeamLanes<team_lanes>;
  using Wide = Lanes;  // lane groups may be smaller than a warp
  using Warp = TeamLanes<team_warp>;
  static constexpr int kept_points = 2;
  static constexpr bool reads_other_blocks = false;
  static constexpr bool has_halos = true;

  HostGroup(TeamState& state, int block, int thread) : state_(state), block_(block), thread_(thread) {}

  int block() const { return block_; }
  int blocks() const { return state_.blocks; }
  int thread() const { return thread_; }
  int threads() const { return state_.threads; }
  Lanes lanes() const {
    return {*state_.lane_group[std::size_t(block_ * threads() + thread_) / team_lanes], thread_ % team_lanes};
  }
  Wide wide() const { return lanes(); }
  Warp warp() const {
    return {*state_.warp[std::size_t(block_ * threads() + thread_) / team_warp], thread_ % team_warp};
  }
  void barrier() {
    ++part().barriers;
    state_.all.arrive_and_wait();
  }
  void arrive_with_residual(std::uint32_t* residual_bits) {
    block_barrier();
    if (thread() == 0) {
      highest(residual_bits, shared().block_residual);
      shared().block_residual = 0;
    }
    ++part().barriers;
    part().arrived.emplace(state_.all.arrive());
  }
  void wait_for_residual(const std::uint32_t* residual_bits) {
    state_.all.wait(std::move(*part().arrived));
    part().arrived.reset();
    if (thread() == 0) shared().grid_residual = *residual_bits;
    block_barrier();  // also orders what the threads did between arrival and wait
  }
  int barriers() const { return part().barriers; }
  void block_barrier() { state_.block[std::size_t(block_)]->arrive_and_wait(); }
  BlockCell& shared() { return state_.cell[std::size_t(block_)]; }
  std::byte* shared_memory() { return state_.shared_memory[std::size_t(block_)].data(); }
  std::size_t shared_bytes() const { return state_.shared_memory[std::size_t(block_)].size(); }
  void raise(std::uint32_t alarms) {
    for (BlockCell& cell : state_.cell) std::atomic_ref(cell.alarms).fetch_or(alarms);
  }
  std::uint32_t alarms() const { return std::atomic_ref(state_.cell[std::size_t(block_)].alarms).load(); }
  void lower_alarms() {
    if (thread_ == 0) std::atomic_ref(shared().alarms).store(0);
  }

  /// Writes the number last and reads it first, so that a reader who sees the number also sees the parts.
  static void write_whole(NumberedHalf* to, const NumberedHalf& value) {
    thread_local unsigned written = 0;
    if (++written % 13 == 0) std::this_thread::yield();  // makes some threads fall behind
    for (int c = 0; c < 3; ++c) std::atomic_ref(to->part[c]).store(value.part[c], std::memory_order_relaxed);
    std::atomic_ref(to->number).store(value.number, std::memory_order_release);
  }
  static NumberedHalf read_whole(const NumberedHalf* from) {
    auto* const half = const_cast<NumberedHalf*>(from);
    NumberedHalf value;
    value.number = std::atomic_ref(half->number).load(std::memory_order_acquire);
    for (int c = 0; c < 3; ++c) value.part[c] = std::atomic_ref(half->part[c]).load(std::memory_order_relaxed);
    return value;
  }
  static void pause() { std::this_thread::yield(); }

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
  /// Sets a number that is `expected`; returns whether it was.
  static bool exchange_if(std::int32_t* value, std::int32_t expected, std::int32_t wanted) {
    return std::atomic_ref(*value).compare_exchange_strong(expected, wanted);
  }

 protected:
  TeamState& state() const { return state_; }

 private:
  TeamState::Part& part() const { return state_.part[std::size_t(block_ * threads() + thread_)]; }

  TeamState& state_;
  int block_, thread_;
};

/// A team that runs one phase. Its alarms outlive it. Its blocks can read each other's shared memory.
class PhaseTeam : public HostGroup {
 public:
  using HostGroup::HostGroup;
  static constexpr int kept_points = 1;
  static constexpr bool reads_other_blocks = true, has_halos = false;
  std::byte* shared_memory_of(int block) const { return state().shared_memory[std::size_t(block)].data(); }
  void raise_in(std::uint32_t& alarms) { alarms_ = &alarms; }
  void raise(std::uint32_t alarms) { std::atomic_ref(*alarms_).fetch_or(alarms); }

 private:
  std::uint32_t* alarms_ = nullptr;
};

/// A PhaseTeam without shared memory.
class SettleTeam : public PhaseTeam {
 public:
  using PhaseTeam::PhaseTeam;
  static constexpr int kept_points = 0;
  static constexpr bool reads_other_blocks = false;
  std::size_t shared_bytes() const { return 0; }
};

/// Runs work(group) on every thread of a team; `threads` is a multiple of team_warp.
template <class Group>
void run_team(int blocks, int threads, std::size_t shared_bytes, const std::function<void(Group&)>& work) {
  TeamState state(blocks, threads, shared_bytes);
  std::vector<std::thread> team;
  for (int b = 0; b < blocks; ++b)
    for (int t = 0; t < threads; ++t)
      team.emplace_back([&, b, t] {
        Group group(state, b, t);
        work(group);
      });
  for (std::thread& thread : team) thread.join();
}

}  // namespace gem::test
