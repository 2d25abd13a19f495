// Least squares by GSL.
#include "gem/analysis/line_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gem {

LineFit fit_line(std::span<const double> x, std::span<const double> y, double confidence) {
  if (x.size() < 3 || x.size() != y.size() ||
      *std::max_element(x.begin(), x.end()) == *std::min_element(x.begin(), x.end()))
    throw std::invalid_argument("a line needs three points at two places");
  double intercept = 0.0;
  double slope = 0.0;
  double var_intercept = 0.0;
  double covariance = 0.0;
  double var_slope = 0.0;
  double squares = 0.0;
  gsl_fit_linear(x.data(), 1, y.data(), 1, x.size(), &intercept, &slope, &var_intercept, &covariance, &var_slope,
                 &squares);
  const double freedom = static_cast<double>(x.size()) - 2.0;
  const double quantile = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, freedom);
  const auto around = [quantile](double value, double variance) {
    const double half = quantile * std::sqrt(variance);
    return IntervalEstimate{value, value - half, value + half};
  };
  return {around(slope, var_slope), around(intercept, var_intercept), std::sqrt(squares / freedom)};
}

}  // namespace gem
