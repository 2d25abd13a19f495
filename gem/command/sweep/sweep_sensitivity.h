// gem sweep sensitivity: where the scatter of a sweep with draws comes from.
#pragma once

#include <string>
#include <vector>

namespace gem {

struct SweepSensitivityChoice {
  std::string folder;
  std::string output;                 // folder of the page; empty: FOLDER_sensitivity
  std::vector<std::string> measures;  // names of findings; empty: the usual loads
  double from_s = 0.0;                // earlier times are left out
  std::string table;                  // if not empty: no page, only this CSV file of the runs
  bool partial = false;
  bool json = false;
};

/// Reads the runs that are done, writes the page and prints the shares. Returns 0. Throws Error(file_system) if runs
/// are missing (unless `partial`), and Error(usage) if the sweep draws nothing, or for an unknown measure.
int sweep_sensitivity(const SweepSensitivityChoice& choice);

}  // namespace gem
