// Who works on a device scene: the interface of a crew of threads, and the crew of one that runs the same code on the
// host.
//
// A crew is made of blocks; a block of threads that share a BlockCell; a block's threads stand in groups of `lanes`
// that look at one pair together. Between two barriers every array element has one writer.
#pragma once

#include <cstdint>

#include "gem/base/macros.h"

namespace gem {

/// Raised by any thread, seen by all after the next barrier.
enum Alarm : std::uint32_t { alarm_strayed = 1, alarm_not_finite = 2, alarm_list_full = 4, alarm_ring_full = 8 };

/// What the threads of one block share.
struct BlockCell {
  std::int32_t looks, touches, touched;
  std::int32_t contacts;
  std::uint64_t overlap;
  std::uint32_t alarms;
};

/// Lanes of a group that has one.
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
  /// Of the bits of a ballot: how many are set, and how many below the own.
  int count(unsigned bits) const { return bits & 1U ? 1 : 0; }
  int count_below(unsigned) const { return 0; }
};

/// The host's crew of one.
class SoloCrew {
 public:
  using Lanes = OneLane;
  using Warp = OneLane;

  int block() const { return 0; }
  int blocks() const { return 1; }
  int thread() const { return 0; }
  int threads() const { return 1; }
  Lanes lanes() const { return {}; }
  Warp warp() const { return {}; }
  void barrier() {}
  void block_barrier() {}
  BlockCell& shared() { return shared_; }
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
};

}  // namespace gem
