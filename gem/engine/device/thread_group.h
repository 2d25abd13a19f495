// Who works on a device scene: the interface of a thread group of threads, and the thread group of one that runs the
// same code on the host.
//
// A thread group is made of blocks; a block of threads that share a BlockCell; a block's threads stand in groups of
// `lanes` that look at one pair together. Between two barriers every array element has one writer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "gem/base/macros.h"
#include "gem/engine/solver/solver_workspace.h"

namespace gem {

/// Raised by any thread, seen by all after the next barrier.
enum Alarm : std::uint32_t { alarm_strayed = 1, alarm_not_finite = 2, alarm_list_full = 4, alarm_ring_full = 8 };

/// What the threads of one block share.
struct BlockCell {
  std::int32_t candidates, touching_count, touched;
  std::int32_t contacts;
  std::uint64_t overlap;
  std::uint32_t alarms;
  // coupled
  std::int32_t points, first_point;  // found by the block, and its first among all
  std::int32_t records;              // places taken in the block's shared memory
  std::int32_t taken, first_taken;   // points that the block iterates, and the first of them
  std::uint32_t asked;               // with halos: bits of the largest speed that the block's points ask for
  std::uint32_t asked_by_all;        // the same of all blocks
  std::int32_t iterations;
  double residual, energy_created;
  std::uint64_t share, complementarity, cone_excess;  // bits of the largest, numbers >= 0
  SolverWorkspace workspace;
  std::int32_t of_kind[row_kinds];  // bodies of the block by the lengths of their rows
};

/// Bits that are set.
GEM_HD GEM_INLINE int bits_in(std::uint32_t bits) {
  bits -= bits >> 1 & 0x55555555U;
  bits = (bits & 0x33333333U) + (bits >> 2 & 0x33333333U);
  return static_cast<int>(((bits + (bits >> 4)) & 0x0f0f0f0fU) * 0x01010101U >> 24);
}

/// Lanes of a group that has one.
struct OneLane {
  static constexpr int size = 1;
  GEM_HD int rank() const { return 0; }
  GEM_HD unsigned ballot(bool mine) const { return mine ? 1U : 0U; }
  template <class T>
  GEM_HD T from(const T& mine, int) const {
    return mine;
  }
  template <class T>
  GEM_HD T partner(const T& mine, int) const {
    return mine;
  }
  GEM_HD void sync() const {}
  /// Of a set of bits: how many there are, how many below the own place, and the lowest.
  GEM_HD int count(unsigned bits) const { return bits_in(bits); }
  GEM_HD int count_below(unsigned) const { return 0; }
  GEM_HD int lowest(unsigned bits) const { return bits_in(~bits & (bits - 1U)); }
  /// Of a number of each lane: the sum over all lanes and over those of lower rank, and the highest.
  GEM_HD int sum(int mine) const { return mine; }
  GEM_HD int sum_below(int) const { return 0; }
  GEM_HD std::uint32_t highest(std::uint32_t mine) const { return mine; }
};

/// The host's thread group of one.
class OneThreadGroup {
 public:
  using Lanes = OneLane;
  using Wide = OneLane;  // as many lanes as an outline has edges, or as `Lanes`
  using Warp = OneLane;

  int block() const { return 0; }
  int blocks() const { return 1; }
  int thread() const { return 0; }
  int threads() const { return 1; }
  Lanes lanes() const { return {}; }
  Wide wide() const { return {}; }
  Warp warp() const { return {}; }
  void barrier() {}
  void block_barrier() {}
  BlockCell& shared() { return shared_; }
  /// Fast memory of the block.
  std::byte* shared_memory() { return shared_memory_.data(); }
  std::size_t shared_bytes() const { return shared_memory_.size(); }
  /// Fast memory of another block, where the thread group's blocks can reach it.
  std::byte* shared_memory_of(int) const { return const_cast<std::byte*>(shared_memory_.data()); }
  static constexpr bool reads_other_blocks = true;
  // whether its blocks move for themselves what their points meet; then it has write_whole(), read_whole(), pause(),
  // and a barrier in two halves, arrive_asking() and wait_for_asked()
  static constexpr bool has_halos = false;
  static constexpr int kept_points = 2;  // that a thread keeps in registers while it iterates
  /// Reads the clock at the end of a stage.
  void lap(int) const {}
  void write_laps(std::int64_t*) const {}
  static int barriers() { return 0; }
  /// The thread group, or a copy that a thread has for itself in its registers; and what that has counted goes back.
  OneThreadGroup& in_registers() { return *this; }
  void returned(const OneThreadGroup&) {}
  void raise(std::uint32_t alarms) { shared_.alarms |= alarms; }
  std::uint32_t alarms() const { return shared_.alarms; }
  void lower_alarms() { shared_.alarms = 0; }

  template <class T>
  static T add(T* sum, T value) {
    const T before = *sum;
    *sum += value;
    return before;
  }
  template <class T>
  static void highest(T* value, T other) {
    if (other > *value) *value = other;
  }
  static void set_bit(std::uint32_t* word, std::uint32_t bit) { *word |= bit; }

 private:
  BlockCell shared_{};
  std::vector<std::byte> shared_memory_ = std::vector<std::byte>(1 << 20);
};

/// One block of a thread group as a thread group of its own: its barriers keep nobody else.
template <class Group>
class OneBlock {
 public:
  using Lanes = typename Group::Lanes;
  using Warp = typename Group::Warp;
  static constexpr bool reads_other_blocks = true;
  static constexpr bool has_halos = false;
  static constexpr int kept_points = Group::kept_points;

  GEM_DEVICE explicit OneBlock(Group& group) : group_(group) {}

  GEM_DEVICE int block() const { return 0; }
  GEM_DEVICE int blocks() const { return 1; }
  GEM_DEVICE int thread() const { return group_.thread(); }
  GEM_DEVICE int threads() const { return group_.threads(); }
  GEM_DEVICE Lanes lanes() const { return group_.lanes(); }
  GEM_DEVICE Warp warp() const { return group_.warp(); }
  GEM_DEVICE void barrier() { group_.block_barrier(); }
  GEM_DEVICE void block_barrier() { group_.block_barrier(); }
  GEM_DEVICE BlockCell& shared() { return group_.shared(); }
  GEM_DEVICE std::byte* shared_memory() { return group_.shared_memory(); }
  GEM_DEVICE std::byte* shared_memory_of(int) const { return group_.shared_memory(); }
  GEM_DEVICE void lap(int stage) { group_.lap(stage); }
  GEM_DEVICE OneBlock in_registers() const { return *this; }
  GEM_DEVICE void returned(const OneBlock&) {}
  template <class T>
  GEM_DEVICE static T add(T* sum, T value) {
    return Group::add(sum, value);
  }
  template <class T>
  GEM_DEVICE static void highest(T* value, T other) {
    Group::highest(value, other);
  }

 private:
  Group& group_;
};

}  // namespace gem
