// Repeats of run 1 with sums in single precision without a fixed order (build/unordered_sums): when they part, how
// fast, and how large their differences are in one time step.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "validation/paper/analysis/chaos/divergence.h"
#include "validation/paper/statements/folder_numbers.h"

namespace gem {

/// One run of the study. Differences of sums are relative to the sum of the magnitudes of the terms.
struct UnorderedRun {
  std::string contacts;  // independent or coupled
  std::string sums;      // ordered; zero, velocity: in no order, from zero or added to the velocity; "moved 1e-9" [m]
  int run = 0;           // number of the repeat, or of the shifted floe
  std::string state_hash;
  double swing_m = 0.0;    // deviation of x
  double taken = 0.0;      // number of sums in single precision
  double several = 0.0;    // sums with enough terms for their order to matter
  double changed = 0.0;    // sums whose order changed their bits
  double order_rms = 0.0;  // against the order of the contacts, over `several`
  double order_largest = 0.0;
  double rounding_rms = 0.0;  // against double precision, over `taken`
  double rounding_largest = 0.0;
  double platform_rms = 0.0;  // platform velocity against the order of the contacts, per time step [m/s]
  std::string commit;
};

/// Pairs of one kind.
struct UnorderedPairs {
  std::string contacts, sums;
  bool repeats = false;  // pairs of repeats, each in one pair; otherwise pairs with the ordered run
  double swing_m = 0.0;  // of the ordered run
  std::vector<std::vector<double>> distances;  // as in DivergenceStudy, from t = 0 [m]
  std::optional<GrowthRate> growth;
};

struct UnorderedStudy {
  double interval_s = 1.0;
  std::vector<UnorderedRun> runs;
  std::vector<UnorderedPairs> pairs;
};

/// Reads unordered_runs.csv and unordered_distances.csv in a folder; without them the study is empty. Throws
/// Error(file_system) with file and line of a mistake.
UnorderedStudy read_unordered_study(const std::filesystem::path& folder);

/// Adds unordered_parting_s: for every pair of `independent` repeats, as parting_s_<moved>.
void add_unordered_numbers(const UnorderedStudy& study, FolderNumbers& numbers);

}  // namespace gem
