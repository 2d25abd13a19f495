// Gumbel fits to samples whose law is known, and the coverage of their intervals.
#include "gem/analysis/extremes/gumbel.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

std::vector<double> sample(const Gumbel& law, std::size_t count, std::uint64_t seed) {
  RandomSequence random = test_random(seed);
  std::vector<double> maxima(count);
  for (double& maximum : maxima) maximum = law.quantile(random.uniform());
  return maxima;
}

TEST(Gumbel, QuantileInvertsTheLawAndDurationMultipliesIt) {
  const Gumbel law{10.0, 2.0};
  EXPECT_NEAR(law.probability_below(law.quantile(0.9)), 0.9, 1e-14);
  // Eight stretches must all stay below.
  EXPECT_NEAR(law.over(8.0).probability_below(15.0), std::pow(law.probability_below(15.0), 8.0), 1e-14);
  EXPECT_NEAR(law.mean(), 10.0 + 0.5772156649 * 2.0, 1e-9);
  EXPECT_NEAR(law.deviation(), 2.0 * 1.2825498302, 1e-9);
}

// Large samples. Likelihood: var(mode) = 1.109 scale^2 / n, var(scale) = 0.608 scale^2 / n. Moments: 1.17 and 1.10.
TEST(Gumbel, FitsFindTheParameters) {
  const std::vector<double> maxima = sample({10.0, 2.0}, 4000, 2);
  const Gumbel likely = fit_gumbel(maxima);
  const Gumbel matched = fit_gumbel_by_moments(maxima);
  const double deviation = 2.0 / std::sqrt(4000.0);
  EXPECT_NEAR(likely.mode, 10.0, 4.0 * std::sqrt(1.109) * deviation);
  EXPECT_NEAR(likely.scale, 2.0, 4.0 * std::sqrt(0.608) * deviation);
  EXPECT_NEAR(matched.mode, 10.0, 4.0 * std::sqrt(1.17) * deviation);
  EXPECT_NEAR(matched.scale, 2.0, 4.0 * std::sqrt(1.10) * deviation);
}

TEST(Gumbel, LikelihoodIsLargestAtTheFit) {
  const std::vector<double> maxima = sample({-5.0, 0.3}, 30, 4);
  const auto log_likelihood = [&](double mode, double scale) {
    double sum = 0.0;
    for (const double x : maxima) sum -= std::log(scale) + (x - mode) / scale + std::exp(-(x - mode) / scale);
    return sum;
  };
  const Gumbel fit = fit_gumbel(maxima);
  const double best = log_likelihood(fit.mode, fit.scale);
  for (const double step : {-1e-4, 1e-4}) {
    EXPECT_GT(best, log_likelihood(fit.mode + step, fit.scale));
    EXPECT_GT(best, log_likelihood(fit.mode, fit.scale + step));
  }
}

TEST(Gumbel, RefusesMaximaThatAreAllAlike) {
  EXPECT_THROW(fit_gumbel(std::vector<double>(9, 1.0)), std::invalid_argument);
  EXPECT_THROW(fit_gumbel_by_moments(std::vector<double>{1.0}), std::invalid_argument);
  EXPECT_THROW(gumbel_quantile(std::vector<double>{1.0, 2.0, 3.0, 4.0}, 0.9), std::invalid_argument);
}

// 300 intervals of 95 % from 30 runs each: one standard deviation is 1.3 %. A bootstrap of 30 values never exceeds the
// largest of them, so the upper end is too low and a few percent of coverage are lost.
TEST(LongGumbel, IntervalOfTheNinetiethPercentileCovers) {
  const Gumbel law{10.0, 2.0};
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed)
    covered += gumbel_quantile(sample(law, 30, seed), 0.9, 1.0, {400, 0.95, seed}).holds(law.quantile(0.9)) ? 1 : 0;
  EXPECT_GE(covered, 267);
  EXPECT_LE(covered, 296);
}

}  // namespace
}  // namespace gem
