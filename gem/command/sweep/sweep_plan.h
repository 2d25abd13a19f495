// What a call of `gem sweep run` will do, settled before anything is computed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gem/command/command.h"
#include "gem/command/sweep/sweep_run.h"
#include "gem/command/sweep/sweep_worker.h"

namespace gem {

struct SweepPlan {
  std::vector<SweepMember> members;  // all members of the sweep
  std::vector<std::size_t> chosen;   // positions in `members`
  std::vector<SweepRow> rows;        // state of each chosen run
  std::vector<std::size_t> to_do;    // positions in `chosen`
  std::vector<std::vector<std::size_t>>
      batches;               // positions in `to_do`; one process makes a batch, together or run by run
  std::vector<int> devices;  // GPUs, one batch at a time on each; empty: each run by itself
  SweepSettings settings;
  int jobs = 1;   // processes at a time, one batch each
  Estimate need;  // of all runs to do; memory and checkpoints only of as many as run at one time, the largest ones
};

/// Reads the sweep file and the folder. Warnings go to `log`. Throws Error(usage) for an impossible choice, and
/// Error(file_system) if the file of a run belongs to another case or engine.
SweepPlan plan_sweep(const SweepRunChoice& choice, RunLog& log);

/// Divides runs with the given numbers of time steps into batches. On GPUs the batches are as even as the run lengths
/// allow and none is too large; without GPUs each run is a batch. A batch lists positions in `steps`, ascending.
std::vector<std::vector<std::size_t>> share_runs(const std::vector<std::int64_t>& steps, std::size_t devices);

/// Default number of processes for `side_by_side` batches. On GPUs: all of them. Otherwise as many as there are
/// processors for `threads` threads each (0 counts as 1).
int open_jobs(int side_by_side, bool on_gpus, int processors, int threads);

/// The text of --dry-run.
std::string plan_text(const SweepPlan& plan);
std::string plan_json(const SweepPlan& plan);

/// The rows of all members: from the manifest where it has the same case, otherwise as missing.
std::vector<SweepRow> known_rows(const std::string& folder, const std::vector<SweepMember>& members);

}  // namespace gem
