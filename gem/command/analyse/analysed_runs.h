// The runs that `gem analyse` was given, and what they say together.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/run_analysis.h"
#include "gem/analysis/runs_analysis.h"
#include "gem/engine/step/ledger.h"
#include "gem/record/verdict.h"

namespace gem {

/// A mooring line: its largest tension, if the run recorded it, strength (0: none) and time of failure (0: it held).
struct LineFinding {
  std::optional<double> largest;  // [N]
  double at = 0.0;                // [s]
  double strength, break_time;    // [N], [s]
};

/// The findings of one run, its file, its duration and the verdict on it.
struct AnalysedRun {
  std::string path, name;
  std::string state_hash;  // empty if the run did not end in order
  double duration_s = 0.0;
  RunVerdict verdict;
  std::vector<Finding> findings;
  std::vector<LineFinding> lines;                    // of the mooring
  std::optional<ContactEnergy> contact_energy = {};  // of compliant contacts
};

/// What several runs of one condition say together.
struct CombinedRuns {
  std::vector<RunsFinding> means;
  std::vector<RunsExtreme> extremes;  // empty for fewer than five runs
};

/// The platform's record from `from_s` on. Throws Error(usage) if it is too short, otherwise like load_run().
AnalysedRun analysed(const std::string& path, double from_s, bool allow_incomplete);

/// Throws Error(usage) unless the runs have one condition and one length and no run is given twice.
CombinedRuns combined(const std::vector<AnalysedRun>& runs);

}  // namespace gem
