// Period and damping ratio of a free decay, from its extremes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "gem/analysis/estimate.h"

namespace gem {

struct FreeDecay {
  Estimate period;              // damped [s]
  Estimate damping_ratio;       // of critical
  Estimate natural_period;      // undamped: period sqrt(1 - damping_ratio^2) [s]
  std::size_t half_cycles = 0;  // between the first and the last extreme used
};

/// Fits the decay of a linear oscillator about `rest`. Extremes come from a parabola through three samples. The time of
/// the n-th grows by half a period, the logarithm of its size falls by half the logarithmic decrement: two straight
/// lines, whose scatter gives the intervals. Extremes smaller than `floor` end the fit, so that noise does not count as
/// decay. Empty with fewer than four extremes.
std::optional<FreeDecay> free_decay(std::span<const double> signal, double interval_s, double rest = 0.0,
                                    double floor = 0.0);

}  // namespace gem
