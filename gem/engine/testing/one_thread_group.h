// For tests: a thread group of one, which runs device code on the calling thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "gem/engine/device/thread_group.h"
#include "gem/engine/solver/device/device_points_cells.h"

namespace gem::test {

/// A lane group of one lane.
struct OneLane {
  static constexpr int size = 1;
  int rank() const { return 0; }
  unsigned ballot(bool mine) const { return mine ? 1U : 0U; }
  template <class T>
  T from(const T& mine, int) const {
    return mine;
  }
  template <class T>
  T partner(const T& mine, int) const {
    return mine;
  }
  void sync() const {}
  /// For a set of bits: their number, the number below the own lane, and the lowest.
  int count(unsigned bits) const { return bits_in(bits); }
  int count_below(unsigned) const { return 0; }
  int lowest(unsigned bits) const { return bits_in(~bits & (bits - 1U)); }
  /// For a number per lane: the sum over all lanes, the sum over lower lanes, and the largest.
  int sum(int mine) const { return mine; }
  int sum_below(int) const { return 0; }
  std::uint32_t highest(std::uint32_t mine) const { return mine; }
};

/// A thread group of one.
class OneThreadGroup {
 public:
  using Lanes = OneLane;
  using Wide = OneLane;
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
  BlockCell& shared() { return own_->cell; }
  std::byte* shared_memory() { return own_->shared_memory.data(); }
  std::size_t shared_bytes() const { return own_->shared_memory.size(); }
  static constexpr bool reads_other_blocks = false;
  static constexpr bool has_halos = true;
  static constexpr int kept_points = 2;
  static void write_whole(NumberedHalf* to, const NumberedHalf& value) { *to = value; }
  static NumberedHalf read_whole(const NumberedHalf* from) { return *from; }
  static void pause() {}
  void arrive_with_residual(std::uint32_t* residual_bits) {
    highest(residual_bits, shared().block_residual);
    shared().block_residual = 0;
  }
  void wait_for_residual(const std::uint32_t* residual_bits) { shared().grid_residual = *residual_bits; }
  static int barriers() { return 0; }
  void raise(std::uint32_t alarms) { shared().alarms |= alarms; }
  std::uint32_t alarms() const { return own_->cell.alarms; }
  void lower_alarms() { shared().alarms = 0; }

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
  static bool exchange_if(std::int32_t* value, std::int32_t expected, std::int32_t wanted) {
    if (*value != expected) return false;
    *value = wanted;
    return true;
  }

 private:
  struct Own {
    BlockCell cell{};
    std::vector<std::byte> shared_memory = std::vector<std::byte>(1 << 20);
  };
  std::shared_ptr<Own> own_ = std::make_shared<Own>();  // shared by all copies
};

}  // namespace gem::test
