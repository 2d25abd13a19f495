// Who works on a device scene: a thread group of threads, and what the threads of a block share.
//
// A thread group is made of blocks; a block of threads that share a BlockCell; a block's threads stand in groups of
// `lanes` that look at one pair together. Between two barriers every array element has one writer. A thread's thread
// group can be copied, and has
//
// | member                              | what                                                                      |
// | Lanes, Wide, Warp; lanes(), ...     | groups of threads; Wide has about as many lanes as an outline has edges   |
// | block(), blocks(), thread(), threads() | who the thread is                                                      |
// | barrier(), block_barrier()          | all threads meet; those of a block do                                     |
// | shared(), room(), room_bytes()      | the block's cell and its shared memory                                      |
// | shares_rooms, room_of(block)        | whether a block reaches the shared memory of others, and where that is      |
// | has_halos                           | whether blocks move for themselves what their points meet; then there are |
// |                                     | write_whole(), read_whole(), pause(), and a barrier in two halves,        |
// |                                     | arrive_asking() and wait_for_asked()                                      |
// | kept_points                         | that a thread keeps in registers while it iterates                        |
// | raise(), alarms(), lower_alarms()   | see Alarm                                                                 |
// | add(), highest(), set_bit()         | what several threads may do to one number at a time                       |
#pragma once

#include <cstddef>
#include <cstdint>

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
  std::uint32_t arrivals;  // of all blocks at the barriers that this one has passed
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

}  // namespace gem
