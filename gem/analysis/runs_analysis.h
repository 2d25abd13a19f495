// What several runs of one condition say together: means over runs and extremes, with intervals over runs.
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

/// One finding over the runs that have it.
struct RunsFinding {
  std::string name;
  std::size_t runs = 0;
  double deviation = 0.0;  // between runs; 0 for one run
  double smallest = 0.0;
  double largest = 0.0;
  std::optional<IntervalEstimate> mean;  // empty where no run has it; its interval is the value itself for one run
};

/// One row per name, in the order of the first run. Every run must have the same names, as analyse_platform() gives.
std::vector<RunsFinding> combine_runs(const std::vector<std::vector<Finding>>& runs);

/// The largest value of one exposure from the largest values of runs of that length, by the Gumbel law.
struct RunsExtreme {
  std::string name;
  Gumbel by_likelihood, by_moments;
  IntervalEstimate most_probable;  // the mode
  IntervalEstimate p90;            // not exceeded by nine exposures of ten
};

/// For the magnitude of one finding. Empty with fewer than five runs or values that are all alike.
std::optional<RunsExtreme> extreme_of(const std::vector<std::vector<Finding>>& runs, const std::string& name,
                                      const Resampling& resampling = {});

}  // namespace gem
