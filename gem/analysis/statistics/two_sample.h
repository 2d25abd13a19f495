// Do two sets of runs differ? Permutation and Kolmogorov-Smirnov tests of one number per run.
//
// The samples of one run are correlated: a test of them rejects almost always, even for the same model. Test numbers of
// independent runs only.
#pragma once

#include <span>

#include "gem/analysis/statistics/bootstrap.h"

namespace gem {

/// A statistic and the chance of at least as much of it without a difference.
struct TestResult {
  double statistic = 0.0;
  double p = 1.0;
};

/// Difference of the means (b - a), two-sided, by reassigning the runs at random `resampling.count` times. Needs two
/// values each, otherwise std::invalid_argument.
TestResult permutation_test(std::span<const double> a, std::span<const double> b, const Resampling& resampling = {});

/// Largest distance of the two distributions. The chance is by permutation, so ties and small sets are right. Needs two
/// values each, otherwise std::invalid_argument.
TestResult kolmogorov_smirnov_test(std::span<const double> a, std::span<const double> b,
                                   const Resampling& resampling = {});

/// Largest distance between the distributions of a and b.
double kolmogorov_smirnov_distance(std::span<const double> a, std::span<const double> b);

}  // namespace gem
