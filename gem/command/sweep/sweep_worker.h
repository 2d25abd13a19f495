// What one process of a sweep does.
#pragma once

#include <atomic>
#include <vector>

#include "gem/command/sweep/sweep_member.h"

namespace gem {

/// A run that a process must make, and its entry on the board.
struct SweepTask {
  const SweepMember* member;
  SweepBoard::Entry* entry;
};

/// Runs one member into its file, unless it is done or another process is running it. Writes its row and its board
/// entry. Never throws: an error belongs to the run.
void run_sweep_member(const SweepTask& task, const SweepSettings& settings, const std::atomic<int>& stop);

/// Runs several members together on a GPU. If they do not fit into its memory together, smaller batches are tried; with
/// engine auto a run that does not fit alone goes to the CPU. Never throws.
void run_sweep_batch(const std::vector<SweepTask>& tasks, const SweepSettings& settings, const std::atomic<int>& stop);

}  // namespace gem
