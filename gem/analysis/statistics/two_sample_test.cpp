// Tests of two sets of runs: by hand where few, by their rate of false alarms where many.
#include "gem/analysis/statistics/two_sample.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

// Of the 20 ways to deal six values, two are as far apart: p = 0.1. 4000 deals place it to 0.5 %.
TEST(PermutationTest, ByHand) {
  const TestResult result =
      permutation_test(std::vector<double>{1.0, 2.0, 3.0}, std::vector<double>{4.0, 5.0, 6.0}, {4000, 0.95, 1});
  EXPECT_DOUBLE_EQ(result.statistic, 3.0);
  EXPECT_NEAR(result.p, 0.1, 0.02);
  const std::vector<double> alike(5, 2.0);
  EXPECT_EQ(permutation_test(alike, alike).p, 1.0);
  EXPECT_THROW(permutation_test(alike, std::vector<double>{1.0}), std::invalid_argument);
}

TEST(KolmogorovSmirnov, DistanceByHand) {
  const std::vector<double> a = {1.0, 2.0, 2.0, 4.0};
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov_distance(a, std::vector<double>{2.0, 3.0}), 0.25);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov_distance(a, a), 0.0);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov_distance(a, std::vector<double>{5.0, 6.0}), 1.0);
}

TEST(KolmogorovSmirnov, SeesAWiderDistribution) {
  const std::vector<double> a = white_noise(150, 1.0, 1);
  const std::vector<double> b = white_noise(150, 3.0, 2);
  EXPECT_LT(kolmogorov_smirnov_test(a, b).p, 0.01);
  EXPECT_GT(permutation_test(a, b).p, 0.01);
}

// 400 pairs of 20 runs of one model: 5 % of them are rejected, one deviation is 1.1 %. Distances of 20 values take few
// values, so their test rejects less often.
TEST(TwoSample, FalseAlarmsAreAsRareAsStated) {
  int means = 0;
  int shapes = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const std::vector<double> a = white_noise(20, 1.0, 2 * seed);
    const std::vector<double> b = white_noise(20, 1.0, 2 * seed + 1);
    means += permutation_test(a, b, {200, 0.95, seed}).p < 0.05 ? 1 : 0;
    shapes += kolmogorov_smirnov_test(a, b, {200, 0.95, seed}).p < 0.05 ? 1 : 0;
  }
  EXPECT_NEAR(means, 20, 14);
  EXPECT_LE(shapes, 34);
  EXPECT_GE(shapes, 2);
}

}  // namespace
}  // namespace gem
