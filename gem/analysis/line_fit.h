// A straight line through points, with the intervals of its slope and of its value at zero.
#pragma once

#include <cstddef>
#include <span>

#include "gem/analysis/interval_estimate.h"

namespace gem {

struct LineFit {
  IntervalEstimate slope;
  IntervalEstimate intercept;
  double scatter = 0.0;  // standard deviation of the points about the line
};

/// Least squares with independent errors of one size in y: Student's t with size - 2 degrees of freedom. Needs three
/// points and two different x, otherwise std::invalid_argument.
LineFit fit_line(std::span<const double> x, std::span<const double> y, double confidence = 0.95);

}  // namespace gem
