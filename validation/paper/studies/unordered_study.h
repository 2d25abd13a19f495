// Repeats of run 1 whose sums are taken in single precision in no fixed order (build/unordered_sums): when they
// part, how fast, and how large what parts them is in a moment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "validation/paper/analysis/chaos/divergence.h"
#include "validation/paper/statements/folder_numbers.h"

namespace gem {

/// One run of the study. Differences of sums are relative to the sum of the lengths of what was added.
struct UnorderedRun {
  std::string contacts;  // independent or coupled
  std::string sums;      // ordered; zero, velocity: in no order, from zero or added to the velocity; "moved 1e-9" [m]
  int run = 0;           // repeat, or the floe that was moved
  std::string state_hash;
  double swing_m = 0.0;    // deviation of x
  double taken = 0.0;      // sums in single precision
  double several = 0.0;    // of them with enough terms for their order to matter
  double changed = 0.0;    // of them whose order changed their bits
  double order_rms = 0.0;  // against the order of the contacts, over `several`
  double order_largest = 0.0;
  double rounding_rms = 0.0;  // against double precision, over `taken`
  double rounding_largest = 0.0;
  double platform_rms = 0.0;  // of the platform's velocity, against the order of the contacts, a moment [m/s]
  std::string commit;
};

/// Pairs of one kind.
struct UnorderedPairs {
  std::string contacts, sums;
  bool repeats = false;  // repeat against repeat, none in two pairs; otherwise against the run in order
  double swing_m = 0.0;  // of the run in order
  std::vector<std::vector<double>> distances;  // as in DivergenceStudy, from t = 0 [m]
  std::optional<GrowthRate> growth;
};

struct UnorderedStudy {
  double interval_s = 1.0;
  std::vector<UnorderedRun> runs;
  std::vector<UnorderedPairs> pairs;
};

/// From unordered_runs.csv and unordered_distances.csv in a folder; without them there is no study. Throws
/// Error(file_system) naming file and line of what cannot be understood.
UnorderedStudy read_unordered_study(const std::filesystem::path& folder);

/// unordered_parting_s: of every pair of `independent` repeats, as parting_s_<moved>.
void add_unordered_numbers(const UnorderedStudy& study, FolderNumbers& numbers);

}  // namespace gem
