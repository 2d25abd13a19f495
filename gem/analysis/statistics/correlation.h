// Correlation in a record: autocorrelation, the number of independent samples, and the interval of the mean.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// Autocorrelation of the mean-removed record at lags 0 ... maximum_lag. Each lag is divided by the number of all
/// samples, so that no weighted sum is negative. Zero for a constant record. Throws std::invalid_argument unless
/// maximum_lag < size.
std::vector<double> autocorrelation(std::span<const double> signal, std::size_t maximum_lag);

/// Number of independent samples whose mean would have the same scatter as the mean of this record: size / (1 + 2 sum
/// of (1 - lag / maximum_lag) autocorrelation). `maximum_lag` must be several correlation times. The result exceeds
/// size for a record that oscillates about its mean.
double effective_samples(std::span<const double> signal, std::size_t maximum_lag);

/// Mean and its interval from the effective number of samples, by Student's t with 1.5 size / maximum_lag degrees of
/// freedom (those of the weighted sum). Throws std::invalid_argument unless size >= 4 maximum_lag and maximum_lag >= 1.
IntervalEstimate mean_by_effective_samples(std::span<const double> signal, std::size_t maximum_lag,
                                           double confidence = 0.95);

}  // namespace gem
