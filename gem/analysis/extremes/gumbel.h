// Gumbel's law of largest values: fits to block maxima, quantiles, and the change of duration.
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
  /// The value that a maximum stays below with probability p in (0, 1).
  double quantile(double p) const;
  double probability_below(double x) const;
  /// The law of the maximum over `factor` times the duration, of independent stretches.
  Gumbel over(double factor) const;
};

/// Mean and standard deviation matched. Needs two different maxima, otherwise std::invalid_argument.
Gumbel fit_gumbel_by_moments(std::span<const double> maxima);

/// Maximum likelihood. Needs two different maxima, otherwise std::invalid_argument.
Gumbel fit_gumbel(std::span<const double> maxima);

/// Quantile p of the largest value over `factor` times the duration of a block, by maximum likelihood, with its
/// interval by the bootstrap over blocks (one block per run: over runs). Needs five maxima, not all alike, otherwise
/// std::invalid_argument.
IntervalEstimate gumbel_quantile(std::span<const double> maxima, double p, double factor = 1.0,
                                 const Resampling& resampling = {});

}  // namespace gem
