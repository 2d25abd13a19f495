// Maximum likelihood in one dimension (Grimshaw 1993).
#include "gem/analysis/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace gem {
namespace {

// With ratio = shape / scale the best shape for a given ratio is the mean of ln(1 + ratio y), and the log likelihood
// that is left depends on the ratio alone.
double shape_for(std::span<const double> excesses, double ratio) {
  double sum = 0.0;
  for (const double y : excesses) sum += std::log1p(ratio * y);
  return sum / static_cast<double>(excesses.size());
}

/// Log likelihood per excess, less a constant; minus infinity where the shape is not above -1.
double likelihood(std::span<const double> excesses, double ratio, double mean) {
  if (std::abs(ratio) * mean < 1e-9) return -std::log(mean) - 1.0;
  const double shape = shape_for(excesses, ratio);
  if (shape <= -1.0) return -std::numeric_limits<double>::infinity();
  return -std::log(shape / ratio) - shape - 1.0;
}

/// The largest value of a function of one hump between low and high, by the golden section.
template <class Function>
double highest(double low, double high, const Function& function) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int pass = 0; pass < 80; ++pass) {
    const double left = high - golden * (high - low);
    const double right = low + golden * (high - low);
    (function(left) < function(right) ? low : high) = function(left) < function(right) ? left : right;
  }
  return 0.5 * (low + high);
}

}  // namespace

double Pareto::probability_above(double excess) const {
  if (excess <= 0.0) return 1.0;
  if (shape == 0.0) return std::exp(-excess / scale);
  const double base = 1.0 + shape * excess / scale;
  return base > 0.0 ? std::pow(base, -1.0 / shape) : 0.0;
}

double Pareto::excess_at(double p) const {
  return shape == 0.0 ? -scale * std::log(p) : scale * std::expm1(-shape * std::log(p)) / shape;
}

Pareto fit_pareto(std::span<const double> excesses) {
  if (excesses.size() < 10 || *std::min_element(excesses.begin(), excesses.end()) <= 0.0)
    throw std::invalid_argument("a Pareto law needs ten positive excesses");
  const double largest = *std::max_element(excesses.begin(), excesses.end());
  const double mean = std::accumulate(excesses.begin(), excesses.end(), 0.0) / static_cast<double>(excesses.size());
  const auto function = [&](double ratio) { return likelihood(excesses, ratio, mean); };
  // A coarse search first, because the likelihood may have several humps: ratios from just above -1 / largest, where
  // the law ends at the largest excess, to heavy tails of shape about 2.
  const auto ratio_at = [&](int i) {
    const double u = static_cast<double>(i) / 100.0;
    return i < 100 ? -(1.0 - u) * (1.0 - 1e-6) / largest : (std::exp(6.0 * (u - 1.0)) - 1.0) / mean;
  };
  int best = 1;
  for (int i = 2; i < 199; ++i)
    if (function(ratio_at(i)) > function(ratio_at(best))) best = i;
  const double ratio = highest(ratio_at(best - 1), ratio_at(best + 1), function);
  if (std::abs(ratio) * mean < 1e-9) return {0.0, mean};
  const double shape = shape_for(excesses, ratio);
  return {shape, shape / ratio};
}

}  // namespace gem
