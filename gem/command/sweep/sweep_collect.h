// gem sweep collect: the runs of a sweep as one table in one file.
#pragma once

#include <string>

namespace gem {

struct SweepCollectChoice {
  std::string folder;
  std::string output;
  std::string command_line;
  std::string index;        // of the runs meant; empty: all
  double from_s = 0.0;      // the analysis leaves out what is before
  double interval_s = 1.0;  // of the displacement, no shorter than a run was recorded; 0: none
  bool exact = false;       // displacement and velocity in double precision, for runs that are to be compared
  bool null_model = true;   // compare the motion with records of the null model: most of the time
  bool partial = false;
  bool overwrite = false;
};

/// Writes the summary, which `gem paper` reads in place of the run files if nothing is left out before `from_s`.
/// Returns 0. Throws Error(file_system) if runs are not done (and not partial), Error(usage) for options that do not go
/// together or with the runs.
int collect_sweep(const SweepCollectChoice& choice);

}  // namespace gem
