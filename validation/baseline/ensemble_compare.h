// Compares ensembles with that of the first setting: means with intervals, and tests of equivalence within the plan's
// margins.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"
#include "validation/baseline/ensemble_plan.h"

namespace gem::baseline {

/// One number of one case and setting: its value for each seed.
using BySeed = std::map<int, double>;

struct Compared {
  std::string quantity;
  IntervalEstimate first, other;                  // means with 95 % intervals by the bootstrap over runs
  double deviation_first = 0.0, deviation = 0.0;  // between runs
  std::size_t runs_first = 0, runs = 0;
  IntervalEstimate difference;         // of the means, 90 %: within the margin means equivalent at the 5 % level
  IntervalEstimate paired_difference;  // over the seeds that both settings have, 95 %
  double margin = 0.0;
  double p = 1.0;       // of two one-sided Welch tests
  double p_holm = 1.0;  // adjusted for all quantities of the case and setting
  std::string verdict;  // equivalent | beyond the margin | undecided | too few runs
};

/// Compares all quantities of a plan, in its order. `first` and `other` hold the values of one case by quantity. Values
/// that are not finite are left out.
std::vector<Compared> compare(const EnsemblePlan& plan, const std::map<std::string, BySeed>& first,
                              const std::map<std::string, BySeed>& other);

}  // namespace gem::baseline
