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

/// The peaks of one run, far enough apart to be independent, and how long it lasted.
struct RunPeaks {
  std::vector<double> peaks;
  double duration = 0.0;  // [s]
};

/// Peaks above a threshold come at a rate and exceed it by a Pareto law.
struct ThresholdModel {
  double threshold = 0.0;
  double rate = 0.0;  // peaks per second [1/s]
  Pareto law;

  /// The value that the maximum of `duration` [s] stays below with probability p in (0, 1); the threshold itself where
  /// even that is less probable.
  double quantile(double p, double duration) const;
};

/// One model for all runs, from their peaks above the threshold; empty with fewer than ten of them.
std::optional<ThresholdModel> fit_threshold_model(std::span<const RunPeaks> runs, double threshold);

/// What one threshold makes of the runs. Shape and modified scale (scale - shape threshold) stay level above the
/// lowest threshold for which the law holds; intervals by the bootstrap over runs.
struct ThresholdStability {
  double threshold = 0.0;
  std::size_t peaks = 0;
  IntervalEstimate shape;
  IntervalEstimate modified_scale;
  IntervalEstimate quantile;
};

struct ReturnValue {
  double p = 0.9;             // probability that the maximum stays below
  double duration = 10800.0;  // [s]
};

/// The table for several thresholds; those with fewer than 20 peaks are left out. Needs two runs, otherwise
/// std::invalid_argument.
std::vector<ThresholdStability> threshold_stability(std::span<const RunPeaks> runs, std::span<const double> thresholds,
                                                    const ReturnValue& asked, const Resampling& resampling = {});

}  // namespace gem
