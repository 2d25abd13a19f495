// Extremes by peaks over a threshold: the Pareto law of the peaks, and return values with intervals.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/interval_estimate.h"
#include "validation/paper/analysis/extremes/pareto.h"

namespace gem {

/// The peaks of one run, far enough apart to be independent, and its duration.
struct RunPeaks {
  std::vector<double> peaks;
  double duration = 0.0;  // [s]
};

/// Peaks above a threshold occur at a rate, and their excesses have a Pareto law.
struct ThresholdModel {
  double threshold = 0.0;
  double rate = 0.0;  // peaks per second [1/s]
  Pareto law;

  /// The value that the maximum over `duration` [s] does not exceed with probability p in (0, 1). The threshold itself
  /// if it is exceeded with less than probability 1 - p.
  double quantile(double p, double duration) const;
};

/// One model for all runs, from their peaks above the threshold; empty with fewer than ten of them.
std::optional<ThresholdModel> fit_threshold_model(std::span<const RunPeaks> runs, double threshold);

/// Result for one threshold. Above the lowest threshold for which the law holds, the shape and the modified scale
/// (scale - shape threshold) are constant. Intervals are by the bootstrap over runs.
struct ThresholdStability {
  double threshold = 0.0;
  std::size_t peaks = 0;
  IntervalEstimate shape;
  IntervalEstimate modified_scale;
  IntervalEstimate quantile;
};

struct ReturnValue {
  double p = 0.9;             // probability that the maximum is not above the return value
  double duration = 10800.0;  // [s]
};

/// Results for several thresholds; those with fewer than 20 peaks are left out. Throws std::invalid_argument with fewer
/// than two runs.
std::vector<ThresholdStability> threshold_stability(std::span<const RunPeaks> runs, std::span<const double> thresholds,
                                                    const ReturnValue& asked, const Resampling& resampling = {});

}  // namespace gem
