// What one process of a sweep does.
#pragma once

#include <atomic>
#include <vector>

#include "gem/command/sweep/sweep_member.h"

namespace gem {

/// A run that a process is to make, and its entry of the board.
struct SweepTask {
  const SweepMember* member;
  SweepBoard::Entry* entry;
};

/// Runs one member into its file unless that is done or another process is at it; writes its row and its entry. Never
/// throws: a fault is the run's own.
void run_sweep_member(const SweepTask& task, const SweepSettings& settings, const std::atomic<int>& stop);

/// The same for several members, moved on together on a GPU; those that do not fit into its
/// memory together are run in smaller batches, and with engine auto on the CPU where there is no other way.
void run_sweep_batch(const std::vector<SweepTask>& tasks, const SweepSettings& settings, const std::atomic<int>& stop);

}  // namespace gem
