// gem sweep run: the runs of a sweep file into a folder, several at a time.
#pragma once

#include <string>
#include <vector>

#include "gem/run/run_log.h"

namespace gem {

struct SweepRunChoice {
  std::string path;
  std::vector<std::string> overrides;
  std::string folder;
  std::string index;  // of the runs meant; empty: all
  std::string engine = "auto";
  std::string jobs;     // processes at a time; empty: one per GPU with a batch, else one per processor
  std::string threads;  // of each run; empty: what is left of the processors
  std::string progress = "auto";
  std::string log_format = "text";
  std::string command_line;
  bool dry_run = false;
  bool overwrite = false;
  bool force = false;
  bool quiet = false;
  bool json = false;
};

/// Runs what is not done yet. Returns the exit code: 0, that of a signal, ExitCode::some_failed, or for a single chosen
/// run its own. Throws Error before anything is computed where the choice itself is at fault.
int run_sweep(const SweepRunChoice& choice);

}  // namespace gem
