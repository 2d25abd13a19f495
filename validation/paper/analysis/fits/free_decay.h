// Period and damping ratio of a free decay from its swings.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

struct FreeDecay {
  IntervalEstimate period;          // damped [s]
  IntervalEstimate damping_ratio;   // of critical
  IntervalEstimate natural_period;  // undamped: period sqrt(1 - damping_ratio^2) [s]
  std::size_t half_cycles = 0;      // between the first and the last crossing
};

/// Fits the decay of a linear oscillator about `rest`. The time of the n-th crossing of rest increases by half a
/// period, and the logarithm of the area of the n-th swing decreases by half the logarithmic decrement. The scatter of
/// these two straight lines gives the intervals. Swings that stay within `floor` of rest are ignored; it must lie well
/// above the noise. Empty with fewer than four crossings.
std::optional<FreeDecay> free_decay(std::span<const double> signal, double interval_s, double rest = 0.0,
                                    double floor = 0.0);

}  // namespace gem
