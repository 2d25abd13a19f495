// What a block works on while it iterates a coupled time step.
#pragma once

#include <cstddef>

#include "gem/engine/solver/coupled_visit.h"
#include "gem/engine/solver/device/device_points_cells.h"
#include "gem/engine/solver/iteration_control.h"

namespace gem {

/// Progress of the iterations of a time step.
struct RoundProgress {
  IterationControl control;
  float residual = 0.0F;
  int turn = 0;  // index of the current one of three places for residuals
};

/// Progress between two launches.
struct RoundsMade {
  RoundProgress progress;
  bool done;  // the last round is over
};

/// A block's range of indices.
struct Stretch {
  std::int32_t begin, end;
  GEM_DEVICE std::int32_t count() const { return end - begin; }
};

/// Row lengths that are told apart where bodies are sorted, for each of the two parts as B and as A. Longer parts count
/// as the longest.
constexpr std::int32_t part_lengths = 8, row_kinds = part_lengths * part_lengths;

/// The halo of a block (device_halo.h); all arrays are in its shared memory.
struct HaloWorkspace {
  std::int32_t bodies;
  SolverEntry* entry;
  AddedMotion* motion;
  std::int32_t records;  // of the bodies; they begin at the start of shared memory
  std::int32_t* source;  // of each record: its index in the scene's records
};

/// The state of the iterations in one block. It stands in shared memory, so no thread needs registers for it.
struct SolverWorkspace {
  StepLength<float> pace;
  Stretch points;                    // points that the block iterates
  Stretch shared_points;             // those in shared memory; they follow those in registers
  std::size_t shared_points_offset;  // where they begin in shared memory [bytes]: see LoadedTable
  std::int32_t bodies;               // moving ones with points, of all blocks
  Stretch own;                       // the block's range of them, in sorted order
  Stretch moved;                     // bodies that the block moves in an iteration: `own`, or its halo
  SolverEntry* entry;                // of bodies with points, in sorted order; by row length if in_order
  SolverEntry* moved_entry;          // of the bodies in `moved`: `entry`, or the halo's
  AddedMotion* motion;               // of the bodies in `moved`, in shared memory; null: in DeviceScene::added
  bool fits;                         // shared memory holds motions, and entries at its end, while the block iterates
  bool in_order;                     // entries are sorted by row length; `rank` is the index in sorted order
  bool platform;                     // the first of `moved` is the platform
  bool has_halo;                     // the block moves its halo
  HaloWorkspace halo;
  std::size_t stage_bytes;  // free bytes at the start of shared memory where there is no halo
  std::int32_t records;     // motions and records at the start of shared memory
};

}  // namespace gem
