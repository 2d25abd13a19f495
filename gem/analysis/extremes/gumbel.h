// The Gumbel law of largest values: fits to block maxima, quantiles, and the change of duration.
#pragma once

#include <cstdint>
#include <span>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// P(maximum <= x) = exp(-exp(-(x - mode) / scale)).
struct Gumbel {
  double mode = 0.0;   // the most probable maximum
  double scale = 0.0;  // > 0

  double mean() const;
  double deviation() const;
  /// The value that a maximum does not exceed with probability p in (0, 1).
  double quantile(double p) const;
  double probability_below(double x) const;
  /// The law of the maximum over `factor` times the duration, if stretches are independent.
  Gumbel over(double factor) const;
};

/// Fit by mean and standard deviation. Throws std::invalid_argument without two different maxima.
Gumbel fit_gumbel_by_moments(std::span<const double> maxima);

/// Fit by maximum likelihood. Throws std::invalid_argument without two different maxima.
Gumbel fit_gumbel(std::span<const double> maxima);

/// Quantile p of the largest value over `factor` times the duration of a block, by maximum likelihood, with its
/// interval by the bootstrap over blocks (with one block per run: over runs). Throws std::invalid_argument with fewer
/// than five maxima or if all are equal.
IntervalEstimate gumbel_quantile(std::span<const double> maxima, double p, double factor = 1.0,
                                 const Resampling& resampling = {});

}  // namespace gem
