// The generalised Pareto law of what exceeds a high threshold.
#pragma once

#include <span>

namespace gem {

/// P(excess > y) = (1 + shape y / scale)^(-1 / shape); exp(-y / scale) for shape 0. A negative shape has a largest
/// possible excess, -scale / shape.
struct Pareto {
  double shape = 0.0;
  double scale = 0.0;  // > 0

  double probability_above(double excess) const;
  /// The excess that is exceeded with probability p in (0, 1).
  double excess_at(double p) const;
};

/// Maximum likelihood, with a shape above -1 (below it the likelihood has no largest value). Needs ten excesses, all
/// positive, otherwise std::invalid_argument.
Pareto fit_pareto(std::span<const double> excesses);

}  // namespace gem
