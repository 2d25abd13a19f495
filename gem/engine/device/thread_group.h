// The threads that work on a device scene: a thread group, and what the threads of a block share.
//
// A thread group consists of blocks. The threads of a block share a BlockCell and stand in groups of lanes that work on
// one pair together. Between two barriers every array element has one writer. Each thread has its own copy of the group
// object, with these members:
//
// | member                                 | what                                                                    |
// |----------------------------------------|-------------------------------------------------------------------------|
// | Lanes, Wide, Warp; lanes(), ...        | groups of threads; Wide has about as many lanes as an outline has edges |
// | block(), blocks(), thread(), threads() | which thread this is                                                    |
// | barrier(), block_barrier()             | barrier of all threads, of the threads of a block                       |
// | shared()                               | the BlockCell                                                           |
// | shared_memory(), shared_bytes()        | the shared memory of the block                                          |
// | reads_other_blocks                     | whether a block reaches the shared memory of other blocks               |
// | shared_memory_of(block)                | where reads_other_blocks: that memory                                   |
// | has_halos                              | whether a block moves all bodies that its points meet (device_halo.h)   |
// | write_whole(), read_whole(), pause()   | where has_halos: exchange of records without a barrier                  |
// | arrive_with_residual(),                | where has_halos: a split barrier that also reduces the largest          |
// | wait_for_residual()                    | residual of all blocks                                                  |
// | kept_points                            | points that a thread keeps in registers while it iterates               |
// | raise(), alarms(), lower_alarms()      | see Alarm                                                               |
// | add(), highest(), set_bit(),           | atomic operations                                                       |
// | exchange_if()                          |                                                                         |
#pragma once

#include <cstddef>
#include <cstdint>

#include "gem/base/macros.h"
#include "gem/engine/solver/solver_workspace.h"

namespace gem {

/// A bit is raised by any thread and seen by all after the next barrier.
enum Alarm : std::uint32_t {
  alarm_strayed = 1,
  alarm_not_finite = 2,
  alarm_list_full = 4,
  alarm_ring_full = 8,
  alarm_solver_full = 16
};

/// What the threads of one block share.
struct BlockCell {
  std::int32_t candidates, touching_count, touched;
  std::int32_t contacts;
  std::uint64_t overlap;
  std::uint32_t alarms;
  std::uint32_t arrivals;  // of all blocks, at the barriers that this block has passed
  // coupled
  std::int32_t points, first_point;  // points that the block found; index of the first among all
  std::int32_t records;              // records in the block's shared memory
  std::int32_t taken, first_taken;   // points that the block iterates; index of the first
  std::uint32_t block_residual;      // bits of the largest residual of the block's points, with halos
  std::uint32_t grid_residual;       // bits of the largest residual of all blocks, with halos
  std::int32_t iterations;
  double residual, energy_created;
  std::uint64_t share, complementarity, cone_excess;  // bits of the largest, numbers >= 0
  SolverWorkspace workspace;
  std::int32_t of_kind[row_kinds];  // bodies of the block by kind_of() their rows
};

/// The number of set bits.
GEM_HD GEM_INLINE int bits_in(std::uint32_t bits) {
  bits -= bits >> 1 & 0x55555555U;
  bits = (bits & 0x33333333U) + (bits >> 2 & 0x33333333U);
  return static_cast<int>(((bits + (bits >> 4)) & 0x0f0f0f0fU) * 0x01010101U >> 24);
}

}  // namespace gem
