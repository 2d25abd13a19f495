// Equivalence of two sets of runs within a margin by two one-sided tests (TOST), and corrections for many tests.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// The difference of the means (b - a), its interval of confidence 1 - 2 level, and p: the probability of a result at
/// least this clear if the true difference equals the margin.
struct Equivalence {
  IntervalEstimate difference;
  double p = 1.0;
  bool equivalent = false;  // p < level: the interval lies within the margin
};

/// Uses Welch's t, so the deviations may differ. A difference that is merely not significant proves nothing; this test
/// does. Throws std::invalid_argument unless each set has two values and the margin is positive.
Equivalence equivalence_test(std::span<const double> a, std::span<const double> b, double margin, double level = 0.05);

/// p values adjusted for their number by Holm's method, in the given order. If those below the level are rejected, the
/// probability of any false rejection is below the level.
std::vector<double> holm(std::span<const double> p);

/// Fisher's method: the probability, without any effect, of independent p values at least this small together. -2 sum
/// ln p has a chi-square law with two degrees of freedom per value. Conservative for rank tests, whose p values are
/// discrete. 1 without values. Throws std::invalid_argument for a p outside (0, 1].
double combined_chance(std::span<const double> p);

/// Factor by which a normal interval of this confidence must be widened so that `comparisons` of them hold together
/// with that confidence (Bonferroni); 1 for one comparison. Throws std::invalid_argument for fewer than one comparison
/// or a confidence outside (0, 1).
double widening(std::size_t comparisons, double confidence = 0.95);

}  // namespace gem
