// How fast two runs with almost equal starts diverge: the growth rate of their distance, and how its onset shifts.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// Mean over pairs of the logarithm of their distance, at each sample. Leave out the time before the disturbance
/// arrives. Throws std::invalid_argument unless all pairs have one length and positive distances.
std::vector<double> mean_log_distance(const std::vector<std::vector<double>>& pairs);

/// Growth of the mean ln(distance) between two sizes. If growth is exponential, its early and late halves have the same
/// rate. Intervals are by the bootstrap over pairs.
struct GrowthRate {
  IntervalEstimate rate;   // [1/s]
  IntervalEstimate early;  // of the first half of the stretch [1/s]
  IntervalEstimate late;   // of the second half [1/s]
  double begin = 0.0;      // of the stretch, from the first sample [s]
  double end = 0.0;        // [s]
};

/// Fits a line from the first sample whose mean ln(distance) is at least ln(low) to the last before it reaches
/// ln(high), which must lie below saturation. Empty if these are fewer than six samples. Needs two pairs.
std::optional<GrowthRate> growth_rate(const std::vector<std::vector<double>>& pairs, double interval_s, double low,
                                      double high, const Resampling& resampling = {});

/// Time at which the distance first reaches `level` [s], interpolated in its logarithm; empty if it never does.
std::optional<double> onset_time(std::span<const double> distance, double interval_s, double level);

/// Onsets of disturbances of different size. Exponential growth delays the onset by ln(1 / size) / rate.
struct OnsetShift {
  IntervalEstimate slope;  // of the onset over ln(size) [s]
  IntervalEstimate rate;   // -1 / slope [1/s]; an end is infinite where the slope may be zero
};
/// `field` names the disturbed field; each field has an onset of its own besides the shift. Throws
/// std::invalid_argument unless there are two more onsets than fields, one field has two sizes, and all sizes are
/// positive.
OnsetShift onset_shift(std::span<const double> sizes, std::span<const double> onsets,
                       std::span<const std::uint64_t> field);

}  // namespace gem
