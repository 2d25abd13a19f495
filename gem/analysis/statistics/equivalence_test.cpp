// Equivalence and corrections for many tests: against tables, and by their error rates.
#include "gem/analysis/statistics/equivalence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

// Two sets of four with variance 5/3 each: error sqrt(2 * 5/12), 6 degrees of freedom, t(0.95) = 1.9432.
TEST(EquivalenceTest, ByHand) {
  const std::vector<double> a = {1.0, 2.0, 3.0, 4.0};
  const std::vector<double> b = {1.5, 2.5, 3.5, 4.5};
  const Equivalence wide = equivalence_test(a, b, 3.0);
  EXPECT_DOUBLE_EQ(wide.difference.value, 0.5);
  EXPECT_NEAR(wide.difference.high, 0.5 + 1.9432 * 0.912871, 1e-4);
  EXPECT_TRUE(wide.equivalent);
  const Equivalence narrow = equivalence_test(a, b, 2.0);
  EXPECT_FALSE(narrow.equivalent);
  EXPECT_GT(narrow.p, 0.05);
  EXPECT_GT(equivalence_test(a, b, 0.2).p, 0.5);
  EXPECT_THROW(equivalence_test(a, b, 0.0), std::invalid_argument);
}

TEST(EquivalenceTest, OfIdenticalRuns) {
  const std::vector<double> a(5, 2.0);
  EXPECT_TRUE(equivalence_test(a, a, 0.1).equivalent);
  EXPECT_FALSE(equivalence_test(a, std::vector<double>(5, 3.0), 0.1).equivalent);
}

// If the true difference equals the margin, 5 % are called equivalent; of 2000 one standard deviation is 0.5 %.
TEST(EquivalenceTest, IsWrongAsRarelyAsStated) {
  int wrong = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    std::vector<double> b = white_noise(15, 2.0, 2 * seed + 1);
    for (double& value : b) value += 3.0;
    wrong += equivalence_test(white_noise(15, 1.0, 2 * seed), b, 3.0).equivalent ? 1 : 0;
  }
  EXPECT_NEAR(wrong, 100, 40);
}

TEST(ManyTests, AdjustedByHand) {
  const std::vector<double> p = {0.01, 0.04, 0.03, 0.5};
  const std::vector<double> by_holm = holm(p);
  EXPECT_NEAR(by_holm[0], 0.04, 1e-15);
  EXPECT_NEAR(by_holm[2], 0.09, 1e-15);
  EXPECT_NEAR(by_holm[1], 0.09, 1e-15);
  EXPECT_NEAR(by_holm[3], 0.5, 1e-15);
  EXPECT_TRUE(holm({}).empty());
}

TEST(CombinedChance, FollowsFishersMethod) {
  EXPECT_NEAR(combined_chance(std::vector<double>{0.03}), 0.03, 1e-12);
  // The product P of two p values has the probability P (1 - ln P).
  EXPECT_NEAR(combined_chance(std::vector<double>{0.1, 0.2}), 0.02 * (1.0 - std::log(0.02)), 1e-12);
  EXPECT_EQ(combined_chance(std::vector<double>{1.0, 1.0}), 1.0);
  EXPECT_EQ(combined_chance({}), 1.0);
  EXPECT_THROW(combined_chance(std::vector<double>{0.0}), std::invalid_argument);
}

TEST(Widening, IsBonferronis) {
  EXPECT_EQ(widening(1), 1.0);
  // 95 % for ten comparisons: 99.5 % each, 2.8070 deviations instead of 1.9600.
  EXPECT_NEAR(widening(10), 2.8070 / 1.9600, 1e-4);
  EXPECT_THROW(widening(0), std::invalid_argument);
}

}  // namespace
}  // namespace gem
