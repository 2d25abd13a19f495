// Moments, extremes and the interval of the mean on records computed by hand or with known correlation.
#include "gem/analysis/moments.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace gem {
namespace {

TEST(Moments, OfAShortRecord) {
  const std::vector<double> signal = {1.0, 2.0, 3.0, 6.0};
  const Moments result = moments(signal);
  EXPECT_DOUBLE_EQ(result.mean, 3.0);
  EXPECT_DOUBLE_EQ(result.deviation, std::sqrt(14.0 / 4.0));
  EXPECT_DOUBLE_EQ(result.minimum, 1.0);
  EXPECT_DOUBLE_EQ(result.maximum, 6.0);
}

TEST(Excursions, AreSignedOnAnAxisAndRadialInThePlane) {
  const std::vector<double> x = {0.0, 3.0, -4.0, 1.0};
  const std::vector<double> y = {0.0, 4.5, 1.0, 1.0};
  EXPECT_DOUBLE_EQ(maximum_excursion(x).value, -4.0);
  EXPECT_EQ(maximum_excursion(x).sample, 2u);
  EXPECT_DOUBLE_EQ(maximum_excursion(x, -2.0).value, 5.0);
  const Excursion radial = maximum_radial_excursion(x, y, 0.0, 0.5);
  EXPECT_DOUBLE_EQ(radial.value, 5.0);
  EXPECT_EQ(radial.sample, 1u);
}

TEST(Percentile, InterpolatesTheSortedRecord) {
  const std::vector<double> signal = {4.0, 1.0, 3.0, 2.0, 5.0};
  EXPECT_DOUBLE_EQ(percentile(signal, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(percentile(signal, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(percentile(signal, 0.9), 4.6);
}

TEST(Intermittency, IsTheFractionOfSamplesInContact) {
  EXPECT_DOUBLE_EQ(intermittency(std::vector<double>{0.0, 2.0, 1.0, 0.0, 0.0}), 0.4);
  EXPECT_DOUBLE_EQ(intermittency({}), 0.0);
}

// x[i] = 0.95 x[i-1] + noise: the mean of n samples has the deviation 1 / (1 - 0.95) / sqrt(n), six times that of
// independent samples. About 95 of 100 intervals must hold the true mean 0; 85 to 100 is four deviations wide.
TEST(BatchMean, CoversTheMeanOfACorrelatedRecord) {
  std::mt19937_64 bits(42);
  std::normal_distribution<double> normal(0.0, 1.0);
  const std::size_t count = 10000;
  const double known = 1.96 * 20.0 / std::sqrt(static_cast<double>(count));
  int covered = 0;
  double width = 0.0;
  for (int run = 0; run < 100; ++run) {
    std::vector<double> signal(count);
    double value = 0.0;
    for (double& sample : signal) sample = value = 0.95 * value + normal(bits);
    const MeanEstimate estimate = batch_mean(signal);
    covered += std::abs(estimate.mean) <= estimate.half_width ? 1 : 0;
    width += estimate.half_width / 100.0;
  }
  EXPECT_GE(covered, 85);
  EXPECT_NEAR(width, known, 0.15 * known);
}

TEST(BatchMean, RefusesARecordShorterThanItsBatches) {
  EXPECT_THROW(batch_mean(std::vector<double>(5, 1.0)), std::invalid_argument);
}

}  // namespace
}  // namespace gem
