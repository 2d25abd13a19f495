// A number explained by several others at once: least squares with the intervals of every coefficient.
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

/// y = intercept + sum of slope_c column_c. Independent errors of one size: Student's t with the degrees of freedom
/// that are left. Needs two points more than coefficients and columns that are not multiples of each other, otherwise
/// std::invalid_argument.
LinearModel fit_linear_model(const std::vector<std::vector<double>>& columns, std::span<const double> y,
                             double confidence = 0.95);

}  // namespace gem
