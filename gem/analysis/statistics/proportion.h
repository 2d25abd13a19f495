// Estimates a probability from the number of successes.
#pragma once

#include <cstddef>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// The share of successes among `trials` and its score interval (Wilson 1927): the probabilities that a normal test
/// would not reject. Valid for few trials and for shares of 0 and 1. Throws std::invalid_argument without trials, for
/// more successes than trials, or for a confidence outside (0, 1).
IntervalEstimate wilson_share(std::size_t successes, std::size_t trials, double confidence = 0.95);

}  // namespace gem
