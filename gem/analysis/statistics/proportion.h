// How often something happens, from how often it happened.
#pragma once

#include <cstddef>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// The share of `trials` that succeeded with its interval by Wilson's score (Wilson 1927): the shares that a normal
/// test would not reject. Sound for few trials and for shares of 0 and 1. Needs a trial, no more successes than trials
/// and a confidence in (0, 1), otherwise std::invalid_argument.
IntervalEstimate wilson_share(std::size_t successes, std::size_t trials, double confidence = 0.95);

}  // namespace gem
