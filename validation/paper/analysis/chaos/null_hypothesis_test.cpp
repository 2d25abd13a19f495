// The test rejects chaos, and rejects records of its own hypothesis as rarely as stated.
#include "validation/paper/analysis/chaos/null_hypothesis.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gem/analysis/test_signals.h"
#include "validation/paper/analysis/chaos/impulse_oscillator.h"
#include "validation/paper/analysis/chaos/nonlinearity.h"

namespace gem {
namespace {

std::vector<double> noise(std::uint64_t seed) { return red_noise(256, 0.7, seed); }

TEST(NullTest, RejectsChaos) {
  const auto error = [](std::span<const double> x) { return prediction_error(x, {{2, 1, 1}, 1, 5}); };
  const NullTest test = test_against(logistic_map(256, 4.0), error, noise, 19);
  EXPECT_EQ(test.p_low, 0.05);
  EXPECT_EQ(test.p_high, 1.0);
  EXPECT_EQ(test.two_sided(), 0.1);
  EXPECT_LT(test.observed, 0.5 * *std::min_element(test.of_null.begin(), test.of_null.end()));
  EXPECT_EQ(test.of_null.size(), 19u);
}

// 200 records against 39 of the same hypothesis each: a two-sided test rejects 5 %; one standard deviation is 1.5 %.
TEST(NullTest, PassesItsOwnHypothesis) {
  const auto asymmetry = [](std::span<const double> x) { return time_reversal_asymmetry(x, 1); };
  int rejected = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed)
    rejected += test_against(noise(seed), asymmetry, noise, 39, 1000 * (seed + 1)).two_sided() <= 0.05 ? 1 : 0;
  EXPECT_GE(rejected, 1);
  EXPECT_LE(rejected, 22);
}

// The null model, sampled eight times per period for 125 periods, is linear, so 5 % are rejected. Of 60 records one
// standard deviation is 1.7.
TEST(LongNullTest, PassesTheNullModel) {
  ImpulseOscillator model;
  model.natural_period = 80.0;
  model.damping_ratio = 0.02;
  const auto record = [&model](std::uint64_t seed) { return impulse_oscillator(model, 1000, 10.0, seed).position; };
  const auto error = [](std::span<const double> x) { return prediction_error(x, {{3, 2, 16}, 4, 5}); };
  int rejected = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed)
    rejected += test_against(record(777 + seed), error, record, 19, 100000 + 1000 * seed).p_low <= 0.05 ? 1 : 0;
  EXPECT_LE(rejected, 9);
}

}  // namespace
}  // namespace gem
