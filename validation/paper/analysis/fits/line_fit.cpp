// Least squares with GSL.
#include "validation/paper/analysis/fits/line_fit.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <map>
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

IntervalEstimate common_slope(std::span<const double> x, std::span<const double> y,
                              std::span<const std::uint64_t> group, double confidence) {
  if (x.size() != y.size() || x.size() != group.size()) throw std::invalid_argument("points without a group");
  struct Level {
    double count = 0.0, x = 0.0, y = 0.0;
  };
  std::map<std::uint64_t, Level> levels;
  for (std::size_t i = 0; i < x.size(); ++i) {
    Level& level = levels[group[i]];
    level.count += 1.0;
    level.x += x[i];
    level.y += y[i];
  }
  double xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Level& level = levels[group[i]];
    const double dx = x[i] - level.x / level.count, dy = y[i] - level.y / level.count;
    xx += dx * dx;
    xy += dx * dy;
    yy += dy * dy;
  }
  const double freedom = static_cast<double>(x.size()) - static_cast<double>(levels.size()) - 1.0;
  if (!(freedom >= 1.0) || !(xx > 0.0)) throw std::invalid_argument("a slope needs two more points than groups");
  const double slope = xy / xx, squares = std::max(yy - slope * xy, 0.0);
  const double half = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, freedom) * std::sqrt(squares / freedom / xx);
  return {slope, slope - half, slope + half};
}

}  // namespace gem
