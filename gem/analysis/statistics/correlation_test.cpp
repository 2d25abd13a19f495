// Records whose autocorrelation is known.
#include "gem/analysis/statistics/correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

TEST(Autocorrelation, IsTheSumOfProductsByHand) {
  const std::vector<double> signal = {1.0, -1.0, 2.0, -2.0, 0.0};
  const std::vector<double> correlation = autocorrelation(signal, 3);
  // Mean 0, sum of squares 10; products at lag 1: -1 - 2 - 4 + 0, lag 2: 2 + 2 + 0, lag 3: -2 + 0.
  EXPECT_NEAR(correlation[0], 1.0, 1e-14);
  EXPECT_NEAR(correlation[1], -0.7, 1e-14);
  EXPECT_NEAR(correlation[2], 0.4, 1e-14);
  EXPECT_NEAR(correlation[3], -0.2, 1e-14);
}

// Red noise of memory 0.8 has (1 - 0.8) / (1 + 0.8) independent samples per sample. The estimate from 20000 samples
// with 200 lags has a relative deviation of sqrt(4/3 * 200 / 20000) = 12 %; the weights add a bias of 2 %.
TEST(EffectiveSamples, OfRedNoise) {
  double mean = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed)
    mean += 0.1 / effective_samples(red_noise(20000, 0.8, seed), 200) * 20000.0;
  EXPECT_NEAR(mean, 9.0, 9.0 * (0.02 + 3.0 * 0.12 / std::sqrt(10.0)));
}

TEST(EffectiveSamples, OfASwingAreMoreThanItsSamples) {
  EXPECT_GT(effective_samples(sum_of(sine(2000, 50.0), white_noise(2000, 0.1, 1)), 200), 2000.0);
}

TEST(MeanByEffectiveSamples, OfAConstantHasNoWidth) {
  const IntervalEstimate estimate = mean_by_effective_samples(std::vector<double>(100, 2.5), 5);
  EXPECT_EQ(estimate.value, 2.5);
  EXPECT_EQ(estimate.low, 2.5);
  EXPECT_EQ(estimate.high, 2.5);
}

TEST(MeanByEffectiveSamples, RefusesARecordOfFewLags) {
  EXPECT_THROW(mean_by_effective_samples(std::vector<double>(100, 2.5), 30), std::invalid_argument);
  EXPECT_THROW(autocorrelation(std::vector<double>(10, 2.5), 10), std::invalid_argument);
}

// 500 intervals of 95 %: one deviation is 1 %. Allowed: four deviations, and 1 % for the bias of the weights.
TEST(LongMeanByEffectiveSamples, CoversTheMeanOfRedNoise) {
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed)
    covered += mean_by_effective_samples(red_noise(5000, 0.9, seed), 200).holds(0.0) ? 1 : 0;
  EXPECT_GE(covered, 450);
  EXPECT_LE(covered, 495);
}

}  // namespace
}  // namespace gem
