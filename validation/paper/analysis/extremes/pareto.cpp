// Maximum likelihood in one dimension (Grimshaw 1993).
#include "validation/paper/analysis/extremes/pareto.h"

#include <gsl/gsl_min.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace gem {
namespace {

// With ratio = shape / scale, the best shape for a given ratio is the mean of ln(1 + ratio y). The log likelihood then
// depends on the ratio alone.
double shape_for(std::span<const double> excesses, double ratio) {
  double sum = 0.0;
  for (const double y : excesses) sum += std::log1p(ratio * y);
  return sum / static_cast<double>(excesses.size());
}

/// Log likelihood per excess without a constant; minus infinity if the shape is not above -1.
double likelihood(std::span<const double> excesses, double ratio, double mean) {
  if (std::abs(ratio) * mean < 1e-9) return -std::log(mean) - 1.0;
  const double shape = shape_for(excesses, ratio);
  if (shape <= -1.0) return -std::numeric_limits<double>::infinity();
  return -std::log(shape / ratio) - shape - 1.0;
}

struct RatioSearch {
  std::span<const double> excesses;
  double mean;

  static double misfit(double ratio, void* search) {
    const auto* self = static_cast<RatioSearch*>(search);
    // The minimiser needs finite numbers.
    return std::min(1e30, -likelihood(self->excesses, ratio, self->mean));
  }
};

/// The ratio of largest likelihood between low and high, by Brent's method from `middle`; the best of the three if the
/// maximum is not between them.
double most_likely_ratio(RatioSearch& search, double low, double middle, double high) {
  const double at_low = RatioSearch::misfit(low, &search);
  const double at_middle = RatioSearch::misfit(middle, &search);
  const double at_high = RatioSearch::misfit(high, &search);
  if (!(at_middle < at_low)) return at_low < at_high ? low : high;
  if (!(at_middle < at_high)) return high;
  struct Free {
    void operator()(gsl_min_fminimizer* minimizer) const { gsl_min_fminimizer_free(minimizer); }
  };
  const std::unique_ptr<gsl_min_fminimizer, Free> minimizer(gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent));
  gsl_function function = {&RatioSearch::misfit, &search};
  gsl_min_fminimizer_set_with_values(minimizer.get(), &function, middle, at_middle, low, at_low, high, at_high);
  for (int pass = 0; pass < 100; ++pass) {
    if (gsl_min_fminimizer_iterate(minimizer.get()) != 0) break;
    const double width = gsl_min_fminimizer_x_upper(minimizer.get()) - gsl_min_fminimizer_x_lower(minimizer.get());
    if (width * search.mean < 1e-9) break;
  }
  return gsl_min_fminimizer_x_minimum(minimizer.get());
}

/// Ratios to try first: from just above -1 / largest, where the law ends at the largest excess, to heavy tails of shape
/// about 2.
std::vector<double> coarse_ratios(double largest, double mean) {
  std::vector<double> ratios;
  for (int i = 0; i < 20; ++i) ratios.push_back(-(1.0 - 0.05 * i) * (1.0 - 1e-6) / largest);
  for (int i = 0; i < 20; ++i) ratios.push_back(std::expm1(0.3 * i) / mean);
  return ratios;
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
  RatioSearch search{excesses, mean};
  // A coarse search first, because the likelihood may have several maxima.
  const std::vector<double> ratios = coarse_ratios(largest, mean);
  std::size_t best = 1;
  for (std::size_t i = 1; i + 1 < ratios.size(); ++i)
    if (RatioSearch::misfit(ratios[i], &search) < RatioSearch::misfit(ratios[best], &search)) best = i;
  const double ratio = most_likely_ratio(search, ratios[best - 1], ratios[best], ratios[best + 1]);
  if (std::abs(ratio) * mean < 1e-9) return {0.0, mean};
  const double shape = shape_for(excesses, ratio);
  return {shape, shape / ratio};
}

}  // namespace gem
