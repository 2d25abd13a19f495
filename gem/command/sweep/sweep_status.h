// gem sweep status: shows the state of each run of a sweep.
#pragma once

#include <string>
#include <vector>

namespace gem {

struct SweepStatusChoice {
  std::string path;  // a folder, or a sweep file with `folder`
  std::string folder;
  std::vector<std::string> overrides;
  bool json = false;
};

/// Prints one row per run. Returns 0 whatever the states are. Throws Error if there is no sweep at `path`.
int sweep_status(const SweepStatusChoice& choice);

}  // namespace gem
