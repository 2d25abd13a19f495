// Fits of the Gumbel law.
#include "gem/analysis/extremes/gumbel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "gem/analysis/statistics/moments.h"

namespace gem {
namespace {

const double kDeviationOfUnit = std::numbers::pi / std::sqrt(6.0);

Moments checked_moments(std::span<const double> maxima) {
  const Moments about = moments(maxima);
  if (maxima.size() < 2 || !(about.maximum > about.minimum))
    throw std::invalid_argument("a Gumbel law needs two different maxima");
  return about;
}

/// Mean of x weighted by exp(-x / scale). Exponents are taken relative to the smallest value, so that none overflows.
double weighted_mean(std::span<const double> maxima, double smallest, double scale) {
  double weight = 0.0;
  double sum = 0.0;
  for (const double x : maxima) {
    const double w = std::exp(-(x - smallest) / scale);
    weight += w;
    sum += w * x;
  }
  return sum / weight;
}

double mode_for(std::span<const double> maxima, double smallest, double scale) {
  double sum = 0.0;
  for (const double x : maxima) sum += std::exp(-(x - smallest) / scale);
  return smallest - scale * std::log(sum / static_cast<double>(maxima.size()));
}

}  // namespace

double Gumbel::mean() const { return mode + std::numbers::egamma * scale; }
double Gumbel::deviation() const { return kDeviationOfUnit * scale; }
double Gumbel::quantile(double p) const { return mode - scale * std::log(-std::log(p)); }
double Gumbel::probability_below(double x) const { return std::exp(-std::exp(-(x - mode) / scale)); }
Gumbel Gumbel::over(double factor) const { return {mode + scale * std::log(factor), scale}; }

Gumbel fit_gumbel_by_moments(std::span<const double> maxima) {
  const Moments about = checked_moments(maxima);
  const auto count = static_cast<double>(maxima.size());
  const double scale = about.deviation * std::sqrt(count / (count - 1.0)) / kDeviationOfUnit;
  return {about.mean - std::numbers::egamma * scale, scale};
}

Gumbel fit_gumbel(std::span<const double> maxima) {
  const Moments about = checked_moments(maxima);
  // The likelihood is largest where scale = mean - weighted_mean(scale). The difference increases with the scale; it is
  // negative near zero and positive at the range of the maxima. So bisection finds the root.
  double low = 0.0;
  double high = about.maximum - about.minimum;
  while (true) {
    const double scale = 0.5 * (low + high);
    if (scale <= low || scale >= high) break;
    (scale < about.mean - weighted_mean(maxima, about.minimum, scale) ? low : high) = scale;
  }
  return {mode_for(maxima, about.minimum, high), high};
}

IntervalEstimate gumbel_quantile(std::span<const double> maxima, double p, double factor,
                                 const Resampling& resampling) {
  if (maxima.size() < 5) throw std::invalid_argument("the interval of an extreme needs five maxima");
  checked_moments(maxima);
  return bootstrap_values(
      maxima,
      [p, factor](std::span<const double> values) {
        const Moments about = moments(values);
        // A resample of one repeated value has no scale; its quantile is the value.
        return about.maximum > about.minimum ? fit_gumbel(values).over(factor).quantile(p) : about.mean;
      },
      resampling);
}

}  // namespace gem
