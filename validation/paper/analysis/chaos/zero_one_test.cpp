// The 0-1 test on motion known to be regular, chaotic or random.
#include "validation/paper/analysis/chaos/zero_one.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

// Published values for at least 1000 samples of the logistic map: below 0.01 at 3.55, above 0.99 at 3.97.
TEST(ZeroOneTest, OfTheLogisticMap) {
  EXPECT_NEAR(zero_one_test(logistic_map(1000, 3.55), 40).k, 0.0, 0.05);
  EXPECT_NEAR(zero_one_test(logistic_map(1000, 3.97), 40).k, 1.0, 0.05);
}

TEST(ZeroOneTest, OfTwoFrequenciesAndOfNoise) {
  const ZeroOne regular = zero_one_test(sum_of(sine(1000, 4.3), sine(1000, 6.1)), 40);
  EXPECT_LT(regular.k, 0.1);
  EXPECT_LE(regular.lower_quartile, regular.k);
  EXPECT_GE(regular.upper_quartile, regular.k);
  // Noise gives 1 too: the test does not distinguish it from chaos.
  EXPECT_GT(zero_one_test(white_noise(1000, 1.0, 1), 40).k, 0.95);
}

TEST(ZeroOneTest, RefusesAConstant) {
  EXPECT_THROW(zero_one_test(std::vector<double>(200, 1.0)), std::invalid_argument);
  EXPECT_THROW(zero_one_test(white_noise(99, 1.0, 1)), std::invalid_argument);
}

TEST(EveryNth, KeepsTheFirst) {
  EXPECT_EQ(every_nth(std::vector<double>{1, 2, 3, 4, 5}, 2), (std::vector<double>{1, 3, 5}));
  EXPECT_THROW(every_nth(std::vector<double>{1.0}, 0), std::invalid_argument);
}

}  // namespace
}  // namespace gem
