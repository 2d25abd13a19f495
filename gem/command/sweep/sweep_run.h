// gem sweep run: runs a sweep file into a folder, several runs at a time.
#pragma once

#include <string>
#include <vector>

#include "gem/run/run_log.h"
#include "gem/run/run_scene.h"

namespace gem {

struct SweepRunChoice {
  std::string path;
  std::vector<std::string> overrides;
  std::string folder;
  std::string index;  // runs to make; empty: all
  std::string engine = "auto";
  std::string jobs;     // processes at a time; empty: one per GPU with a batch, else one per processor
  std::string threads;  // per run; empty: the processors divided by the processes
  std::string progress = "auto";
  std::string log_format = "text";
  std::string command_line;
  double checkpoint_interval_s = usual_checkpoint_interval_s;  // wall time; 0: no checkpoints
  double flush_interval_s = usual_flush_interval_s;            // wall time
  bool dry_run = false;
  bool overwrite = false;
  bool force = false;
  bool quiet = false;
  bool json = false;
  bool strict = false;
};

/// Makes the runs that are not done yet. Returns 0, the exit code of a signal, ExitCode::some_failed, for a single
/// chosen run its own exit code, or if `strict` ExitCode::numerical_stop for a bad run among the chosen ones. Throws
/// Error before anything is computed if the choice itself is wrong.
int run_sweep(const SweepRunChoice& choice);

}  // namespace gem
