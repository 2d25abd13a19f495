// Equivalence by two one-sided tests, and stepwise corrections of p values.
#include "gem/analysis/statistics/equivalence.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/statistics/moments.h"

namespace gem {
namespace {

/// Squared standard error of the mean.
double squared_error(std::span<const double> values, const Moments& about) {
  return about.deviation * about.deviation / (static_cast<double>(values.size()) - 1.0);
}

std::vector<std::size_t> ascending_p(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return p[a] < p[b]; });
  return order;
}

}  // namespace

Equivalence equivalence_test(std::span<const double> a, std::span<const double> b, double margin, double level) {
  if (a.size() < 2 || b.size() < 2 || !(margin > 0.0))
    throw std::invalid_argument("a test of equivalence needs two runs in each set and a positive margin");
  const Moments about_a = moments(a);
  const Moments about_b = moments(b);
  const double part_a = squared_error(a, about_a);
  const double part_b = squared_error(b, about_b);
  const double difference = about_b.mean - about_a.mean;
  const double error = std::sqrt(part_a + part_b);
  if (!(error > 0.0)) {
    const bool within = std::abs(difference) < margin;
    return {{difference, difference, difference}, within ? 0.0 : 1.0, within};
  }
  const double freedom = std::pow(part_a + part_b, 2) / (part_a * part_a / (static_cast<double>(a.size()) - 1.0) +
                                                         part_b * part_b / (static_cast<double>(b.size()) - 1.0));
  const double half = gsl_cdf_tdist_Pinv(1.0 - level, freedom) * error;
  const double p = gsl_cdf_tdist_Q((margin - std::abs(difference)) / error, freedom);
  return {{difference, difference - half, difference + half}, p, p < level};
}

std::vector<double> holm(std::span<const double> p) {
  std::vector<double> adjusted(p.size());
  double largest = 0.0;
  std::size_t rank = 0;
  for (const std::size_t i : ascending_p(p)) {
    largest = std::max(largest, std::min(1.0, p[i] * static_cast<double>(p.size() - rank++)));
    adjusted[i] = largest;
  }
  return adjusted;
}

double combined_chance(std::span<const double> p) {
  double sum = 0.0;
  for (const double value : p) {
    if (!(value > 0.0 && value <= 1.0)) throw std::invalid_argument("a chance lies between 0 and 1");
    sum -= 2.0 * std::log(value);
  }
  return p.empty() ? 1.0 : gsl_cdf_chisq_Q(sum, 2.0 * static_cast<double>(p.size()));
}

double widening(std::size_t comparisons, double confidence) {
  if (comparisons == 0 || !(confidence > 0.0 && confidence < 1.0))
    throw std::invalid_argument("an interval is widened for one comparison or more at a confidence below 1");
  const double miss = 0.5 * (1.0 - confidence);
  return gsl_cdf_ugaussian_Qinv(miss / static_cast<double>(comparisons)) / gsl_cdf_ugaussian_Qinv(miss);
}

}  // namespace gem
