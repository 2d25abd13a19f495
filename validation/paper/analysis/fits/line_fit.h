// A straight line through points, with intervals of its slope and of its value at zero.
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

/// Least squares with independent errors of one size in y, by Student's t with size - 2 degrees of freedom. Throws
/// std::invalid_argument without three points and two different x.
LineFit fit_line(std::span<const double> x, std::span<const double> y, double confidence = 0.95);

/// The slope common to groups of points, each with a level of its own, by least squares within the groups and Student's
/// t with size - groups - 1 degrees of freedom. Throws std::invalid_argument unless there are two more points than
/// groups, and two different x in one group.
IntervalEstimate common_slope(std::span<const double> x, std::span<const double> y,
                              std::span<const std::uint64_t> group, double confidence = 0.95);

}  // namespace gem
