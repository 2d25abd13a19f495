// Combines runs of one condition: means over runs and extremes, with intervals over runs.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gem/analysis/extremes/gumbel.h"
#include "gem/analysis/run_analysis.h"
#include "gem/analysis/statistics/bootstrap.h"

namespace gem {

/// One finding over the runs that have a value for it.
struct RunsFinding {
  std::string name;
  std::size_t runs = 0;
  double deviation = 0.0;  // standard deviation between runs; 0 for one run
  double smallest = 0.0;
  double largest = 0.0;
  std::optional<IntervalEstimate> mean;  // empty if no run has a value; for one run the interval is the value itself
};

/// One row per name, in the order of the first run. All runs must have the same names, as from analyse_platform().
/// Largest excursions (names ending in `_largest_m`) are combined by their absolute values.
std::vector<RunsFinding> combine_runs(const std::vector<std::vector<Finding>>& runs);

/// The largest value of one exposure by the Gumbel law, from the largest values of runs of that duration.
struct RunsExtreme {
  std::string name;
  Gumbel by_likelihood, by_moments;
  IntervalEstimate most_probable;  // the mode
  IntervalEstimate p90;            // nine of ten exposures do not exceed it
};

/// For the magnitude of one finding. Empty with fewer than five runs or if all values are equal.
std::optional<RunsExtreme> extreme_of(const std::vector<std::vector<Finding>>& runs, const std::string& name,
                                      const Resampling& resampling = {});

}  // namespace gem
