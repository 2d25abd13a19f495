// The generalised Pareto law of excesses over a high threshold.
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

/// Maximum likelihood with a shape above -1; below, the likelihood has no maximum. Throws std::invalid_argument for
/// fewer than ten excesses or one that is not positive.
Pareto fit_pareto(std::span<const double> excesses);

}  // namespace gem
