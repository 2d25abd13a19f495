// What a call of `gem sweep run` is going to do, settled before anything is computed.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "gem/command/command.h"
#include "gem/command/sweep/sweep_run.h"
#include "gem/command/sweep/sweep_worker.h"

namespace gem {

struct SweepPlan {
  std::vector<SweepMember> members;               // all of the sweep
  std::vector<std::size_t> chosen;                // places among them
  std::vector<SweepRow> rows;                     // of the chosen, as they stand
  std::vector<std::size_t> to_do;                 // places among `chosen`
  std::vector<std::vector<std::size_t>> batches;  // places among `to_do` that one process makes together or alone
  std::vector<int> devices;                       // GPUs, each for one batch at a time; none: each run by itself
  SweepSettings settings;
  int jobs = 1;   // processes at a time, each with one batch
  Estimate need;  // memory of the largest `jobs` batches at once, disk and time steps of all that is to do
};

/// Reads the sweep file and the folder. Warnings are said in `log`. Throws Error(usage) for a choice that cannot be,
/// Error(file_system) if a file of another case or engine stands where a run is to go.
SweepPlan plan_sweep(const SweepRunChoice& choice, RunLog& log);

/// Shares runs of so many time steps out among batches: on GPUs as even as their lengths allow, no batch too large,
/// else each run by itself. A batch lists places among `steps`, ascending.
std::vector<std::vector<std::size_t>> share_runs(const std::vector<std::int64_t>& steps, std::size_t devices);

/// Processes at a time where nobody asks for a number, for so many batches that could go side by side: on GPUs all of
/// them, whatever the threads of each; otherwise as many as the processors feed with so many threads (0: one).
int open_jobs(int side_by_side, bool on_gpus, int processors, int threads);

/// For --dry-run.
std::string plan_text(const SweepPlan& plan);
std::string plan_json(const SweepPlan& plan);

/// The rows of all members as far as the manifest knows of the same cases, else as missing.
std::vector<SweepRow> known_rows(const std::string& folder, const std::vector<SweepMember>& members);

}  // namespace gem
