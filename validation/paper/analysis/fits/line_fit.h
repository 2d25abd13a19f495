// A straight line through points, with the intervals of its slope and of its value at zero.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

struct LineFit {
  IntervalEstimate slope;
  IntervalEstimate intercept;
  double scatter = 0.0;  // standard deviation of the points about the line
};

/// Least squares with independent errors of one size in y: Student's t with size - 2 degrees of freedom. Needs three
/// points and two different x, otherwise std::invalid_argument.
LineFit fit_line(std::span<const double> x, std::span<const double> y, double confidence = 0.95);

/// The slope common to groups of points that each have a level of their own, by least squares within the groups:
/// Student's t with size - groups - 1 degrees of freedom. Needs two more points than groups and, in one group, two
/// different x, otherwise std::invalid_argument.
IntervalEstimate common_slope(std::span<const double> x, std::span<const double> y,
                              std::span<const std::uint64_t> group, double confidence = 0.95);

}  // namespace gem
