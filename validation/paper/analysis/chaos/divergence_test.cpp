// Growth rates of the Lorenz system and the logistic map, from pairs and from onsets.
#include "validation/paper/analysis/chaos/divergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "gem/analysis/test_signals.h"
#include "validation/paper/analysis/chaos/test_lorenz.h"

namespace gem {
namespace {

/// Distances of pairs of the logistic map at r = 4 that start `size` apart.
std::vector<std::vector<double>> logistic_pairs(std::size_t pairs, double size, std::size_t steps) {
  RandomSequence random = test_random(1);
  std::vector<std::vector<double>> distances;
  for (std::size_t p = 0; p < pairs; ++p) {
    double x = random.uniform(0.1, 0.9);
    double y = x + size;
    auto& distance = distances.emplace_back();
    for (std::size_t i = 0; i < steps; ++i) {
      distance.push_back(std::abs(x - y));
      x = 4.0 * x * (1.0 - x);
      y = 4.0 * y * (1.0 - y);
    }
  }
  return distances;
}

std::vector<double> lorenz_distance(double start, double size, std::size_t samples, double interval) {
  Lorenz one(start);
  Lorenz other(start);
  other.disturb(size);
  std::vector<double> distance;
  for (std::size_t i = 0; i < samples; ++i) {
    distance.push_back(one.distance(other));
    one.advance(interval);
    other.advance(interval);
  }
  return distance;
}

// The rate is ln 2 per step. ln|slope| of one step has the deviation pi / sqrt(12). 100 pairs over 27 almost
// uncorrelated steps give a scatter of 0.9 / sqrt(2700) = 0.02.
TEST(GrowthRate, OfTheLogisticMapIsLnTwo) {
  const auto growth = growth_rate(logistic_pairs(100, 1e-12, 60), 1.0, 1e-11, 1e-3, {200, 0.95, 1});
  ASSERT_TRUE(growth.has_value());
  EXPECT_TRUE(growth->rate.holds(std::numbers::ln2)) << growth->rate.low << ' ' << growth->rate.high;
  EXPECT_LT(growth->rate.high - growth->rate.low, 0.1);
  EXPECT_TRUE(growth->early.holds(std::numbers::ln2));
  EXPECT_TRUE(growth->late.holds(std::numbers::ln2));
  EXPECT_NEAR(growth->end - growth->begin, std::log(1e8) / std::numbers::ln2, 3.0);
}

TEST(GrowthRate, RefusesWhatHasNoLogarithm) {
  EXPECT_THROW(growth_rate({{0.0, 1.0}, {1.0, 1.0}}, 1.0, 0.1, 0.5), std::invalid_argument);
  EXPECT_THROW(mean_log_distance({{1.0, 1.0}, {1.0}}), std::invalid_argument);
  EXPECT_THROW(mean_log_distance({}), std::invalid_argument);
  EXPECT_FALSE(growth_rate({{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}, 1.0, 0.1, 0.5).has_value());
}

TEST(OnsetTime, LiesBetweenSamples) {
  const std::vector<double> distance = {1e-6, 1e-4, 1e-2};
  EXPECT_NEAR(*onset_time(distance, 10.0, 1e-3), 15.0, 1e-12);
  EXPECT_EQ(*onset_time(distance, 10.0, 1e-7), 0.0);
  EXPECT_FALSE(onset_time(distance, 10.0, 1.0).has_value());
  EXPECT_EQ(*onset_time(std::vector<double>{0.0, 1.0}, 10.0, 0.5), 10.0);
}

// Sizes from 1e-12 to 1e-6 with 30 pairs each. An onset scatters by 0.9 sqrt(steps) / ln 2 = 6 steps. 120 onsets over a
// range of 14 in ln(size), deviation 5, give the slope to 8 %.
TEST(OnsetShift, OfTheLogisticMap) {
  std::vector<double> sizes;
  std::vector<double> onsets;
  for (const double size : {1e-12, 1e-10, 1e-8, 1e-6})
    for (const auto& distance : logistic_pairs(30, size, 80)) {
      sizes.push_back(size);
      onsets.push_back(*onset_time(distance, 1.0, 1e-2));
    }
  const OnsetShift shift = onset_shift(sizes, onsets, std::vector<std::uint64_t>(sizes.size(), 1));
  EXPECT_TRUE(shift.rate.holds(std::numbers::ln2));
  EXPECT_LT(shift.rate.high - shift.rate.low, 0.3);
  EXPECT_THROW(onset_shift(std::vector<double>{0.0, 1.0, 2.0}, std::vector<double>{1.0, 2.0, 3.0},
                           std::vector<std::uint64_t>{1, 1, 1}),
               std::invalid_argument);
}

// Onsets that do not depend on the size allow any rate, so the interval has no upper end.
TEST(OnsetShift, WithoutAShiftHasNoUpperEnd) {
  const OnsetShift shift = onset_shift(std::vector<double>{1e-9, 1e-7, 1e-5, 1e-3},
                                       std::vector<double>{5.0, 6.0, 5.5, 5.8}, std::vector<std::uint64_t>{1, 1, 1, 1});
  EXPECT_TRUE(std::isinf(shift.rate.high));
}

TEST(LongGrowthRate, OfTheLorenzSystem) {
  std::vector<std::vector<double>> pairs;
  for (int i = 0; i < 40; ++i) pairs.push_back(lorenz_distance(0.1 * i, 1e-9, 300, 0.1));
  const auto growth = growth_rate(pairs, 0.1, 1e-8, 1e-1);
  ASSERT_TRUE(growth.has_value());
  EXPECT_TRUE(growth->rate.holds(kLorenzExponent)) << growth->rate.low << ' ' << growth->rate.high;
  EXPECT_LT(growth->rate.high - growth->rate.low, 0.2);
}

}  // namespace
}  // namespace gem
