// gem sweep collect: the runs of a sweep as one table in one file.
#pragma once

#include <string>

namespace gem {

struct SweepCollectChoice {
  std::string folder;
  std::string output;
  std::string command_line;
  double from_s = 0.0;  // the analysis leaves out what is before
  bool partial = false;
  bool overwrite = false;
};

/// Writes the summary. Returns 0. Throws Error(file_system) if runs are not done (and not partial).
int collect_sweep(const SweepCollectChoice& choice);

}  // namespace gem
