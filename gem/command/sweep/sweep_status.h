// gem sweep status: how the runs of a sweep stand.
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

/// Prints one row per run. Returns 0 whatever the rows say. Throws Error if there is nothing to look at.
int sweep_status(const SweepStatusChoice& choice);

}  // namespace gem
