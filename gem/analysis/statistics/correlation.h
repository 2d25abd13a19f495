// How much a record remembers: autocorrelation, the number of independent samples, and the interval of its mean.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// Autocorrelation of the mean-removed record at lags 0 ... maximum_lag, each over all samples (so that no sum of them
/// is negative). All zero for a constant record. Needs maximum_lag < size, otherwise std::invalid_argument.
std::vector<double> autocorrelation(std::span<const double> signal, std::size_t maximum_lag);

/// Number of independent samples whose mean would scatter as much as the mean of this record: size / (1 + 2 sum of
/// (1 - lag / maximum_lag) autocorrelation). `maximum_lag` must be several times the memory of the record. More than
/// size for a record that swings about its mean.
double effective_samples(std::span<const double> signal, std::size_t maximum_lag);

/// Mean and its interval by the effective number of samples. Student's t with 1.5 size / maximum_lag degrees of
/// freedom, those of the weighted sum. Needs size >= 4 maximum_lag and maximum_lag >= 1, otherwise
/// std::invalid_argument.
IntervalEstimate mean_by_effective_samples(std::span<const double> signal, std::size_t maximum_lag,
                                           double confidence = 0.95);

}  // namespace gem
