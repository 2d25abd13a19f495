// A linear model in several variables: least squares with the intervals of every coefficient.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

struct LinearModel {
  std::vector<IntervalEstimate> slopes;  // one per column
  IntervalEstimate intercept;
  double scatter = 0.0;  // standard deviation of the points about the model
};

/// y = intercept + sum of slope_c column_c, with independent errors of one size, by Student's t with the remaining
/// degrees of freedom. Throws std::invalid_argument unless there are two more points than coefficients and the columns
/// are independent.
LinearModel fit_linear_model(const std::vector<std::vector<double>>& columns, std::span<const double> y,
                             double confidence = 0.95);

}  // namespace gem
