// Values of a distribution by inverting its distribution function.
#include "gem/scene/sweep/distribution.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gem/base/number_text.h"
#include "gem/base/strict_math.h"
#include "gem/scene/sweep/normal_quantile.h"

namespace gem {
namespace {

double of_quantiles(const std::vector<std::pair<double, double>>& quantiles, double u) {
  const auto above = std::upper_bound(quantiles.begin() + 1, quantiles.end() - 1, u,
                                      [](double p, const auto& point) { return p < point.first; });
  const auto below = above - 1;
  const double share = (u - below->first) / (above->first - below->first);
  return below->second + share * (above->second - below->second);
}

double of_values(const std::vector<double>& values, const std::vector<double>& weights, double u) {
  const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
  double sum = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    sum += weights[i];
    if (u * total < sum) return values[i];
  }
  return values.back();
}

}  // namespace

double Distribution::unbounded(double u) const {
  const double z = u <= 0.5 ? normal_quantile(u) : -normal_quantile(1.0 - u);
  if (law == Law::normal) return mean + deviation * z;
  const double relative = deviation / mean;
  const double variance = strict::log1p(relative * relative);  // of the logarithm
  return strict::exp(strict::log(mean) - 0.5 * variance + std::sqrt(variance) * z);
}

/// By halving: it needs no second function that must agree with the quantile.
double Distribution::probability_below(double x) const {
  if (x == -infinity) return 0.0;
  if (x == infinity) return 1.0;
  double below = 0.0, above = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (below + above);
    (unbounded(middle) < x ? below : above) = middle;
  }
  return 0.5 * (below + above);
}

double Distribution::prepare() {
  if (law != Law::normal && law != Law::lognormal) return 1.0;
  probability_low_ = probability_below(low);
  probability_high_ = probability_below(high);
  return probability_high_ - probability_low_;
}

double Distribution::quantile(double u) const {
  double value = 0.0;
  switch (law) {
    case Law::uniform:
      value = whole ? low + std::floor(u * (high - low + 1.0)) : low + u * (high - low);
      break;
    case Law::normal:
    case Law::lognormal:
      value = unbounded(probability_low_ + u * (probability_high_ - probability_low_));
      break;
    case Law::quantiles:
      value = of_quantiles(quantiles, u);
      break;
    case Law::values:
      return of_values(values, weights, u);
  }
  if (whole) value = std::floor(value + 0.5);
  return std::clamp(value, lowest(), highest());
}

double Distribution::lowest() const {
  if (law == Law::quantiles) return quantiles.front().second;
  if (law == Law::values) return *std::min_element(values.begin(), values.end());
  return law == Law::lognormal ? std::max(low, 0.0) : low;
}

double Distribution::highest() const {
  if (law == Law::quantiles) return quantiles.back().second;
  if (law == Law::values) return *std::max_element(values.begin(), values.end());
  return high;
}

std::string Distribution::text() const {
  const auto moments = [this] { return ", mean " + number_text(mean) + ", deviation " + number_text(deviation); };
  std::string bounds;
  if (low > -infinity) bounds += " from " + number_text(low);
  if (high < infinity) bounds += " to " + number_text(high);
  if (law == Law::uniform) return "uniform" + bounds;
  if (law == Law::normal) return "normal" + moments() + bounds;
  if (law == Law::lognormal) return "lognormal" + moments() + bounds;
  const std::string ends = " from " + number_text(lowest()) + " to " + number_text(highest());
  if (law == Law::quantiles) return "table of " + std::to_string(quantiles.size()) + " quantiles" + ends;
  return "table of " + std::to_string(values.size()) + " values" + ends;
}

}  // namespace gem
