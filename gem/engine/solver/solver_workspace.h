// What a block has before it while it iterates a coupled time step.
#pragma once

#include <cstddef>

#include "gem/engine/solver/coupled_visit.h"
#include "gem/engine/solver/device_points_cells.h"
#include "gem/engine/solver/iteration_control.h"

namespace gem {

/// How far the iterations of a time step are.
struct Progress {
  IterationControl control;
  float residual = 0.0F;
  int turn = 0;  // of the three places for residuals
};

/// The same between two launches; `done`: the last round was made.
struct RoundsMade {
  Progress progress;
  bool done;
};

/// A block's stretch of [0, count).
struct Stretch {
  std::int32_t begin, end;
  GEM_DEVICE std::int32_t count() const { return end - begin; }
};

/// Lengths of a row's two parts, as B and as A, that are told apart where bodies are put in order; longer ones count as
/// the longest.
constexpr std::int32_t part_lengths = 8, row_kinds = part_lengths * part_lengths;

/// What a block copies of the bodies that its points meet, see device_halo.h; all in its shared memory.
struct HaloWorkspace {
  std::int32_t bodies;
  SolverEntry* entry;
  AddedMotion* motion;
  std::int32_t records;  // of the bodies; they stand from the start on
  std::int32_t* source;  // of each record: its place among those of the scene
};

/// The same for all threads of the block, and kept in its shared memory, so that no thread has to keep it for itself.
struct SolverWorkspace {
  StepLength<float> pace;
  Stretch points;            // that the block iterates
  Stretch fast;              // those of them that stand in its shared memory, after those in registers
  std::size_t fast_from;     // where they begin there: see HeldTable
  std::int32_t bodies;       // moving, with points
  Stretch own;               // the block's stretch of them, by sorted place
  Stretch moved;             // that it moves in an iteration: these, or those of its points, see device_halo.h
  SolverEntry* entry;        // by place among them; or in order, see in_order
  SolverEntry* moved_entry;  // of those that it moves, by place among them: the same list, or another
  AddedMotion* motion;       // the same, in the block's shared memory; null: they stand by body
  bool fits;                 // motions and, at its end, entries stand there while the block iterates
  bool in_order;             // of their rows, so that neighbouring threads have as much to do: rank is the place
  bool platform;             // the first that it moves is the platform
  bool has_halo;             // it moves bodies of other blocks for itself
  HaloWorkspace halo;
  std::size_t stage_bytes;  // of shared memory, from the start, that nothing stands in where there is no halo
  std::int32_t records;     // places of shared memory, from the start, of motions and records
};

}  // namespace gem
