// Are two sets of runs the same within a margin? Two one-sided tests (TOST); and a correction for many tests.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// The difference of the means (b - a) with its interval of confidence 1 - 2 level, and the chance of so clear a result
/// when the true difference is as large as the margin.
struct Equivalence {
  IntervalEstimate difference;
  double p = 1.0;
  bool equivalent = false;  // p < level: the interval lies within the margin
};

/// Welch's t: deviations may differ. A difference that is not significant proves nothing; this does. Needs two values
/// each and a positive margin, otherwise std::invalid_argument.
Equivalence equivalence_test(std::span<const double> a, std::span<const double> b, double margin, double level = 0.05);

/// p values adjusted for their number (Holm), in the given order: reject those below the level, and the chance of even
/// one false rejection stays below it.
std::vector<double> holm(std::span<const double> p);

/// The chance of independent p values as small as these together without any effect, by Fisher's method: -2 sum ln p
/// has a chi-square law with two degrees of freedom for each. On the safe side for ranks, which have a least p. 1 for
/// no p at all; a p outside (0, 1] throws std::invalid_argument.
double combined_chance(std::span<const double> p);

/// How much wider a normal interval of this confidence must be so that `comparisons` of them all hold with that
/// confidence (Bonferroni): 1 for one. Needs one comparison and a confidence in (0, 1), otherwise
/// std::invalid_argument.
double widening(std::size_t comparisons, double confidence = 0.95);

}  // namespace gem
