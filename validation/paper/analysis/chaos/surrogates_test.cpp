// Surrogates keep values and spectrum; tests against them reject chaos and pass linear noise as often as they say.
#include "validation/paper/analysis/chaos/surrogates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "gem/analysis/statistics/correlation.h"
#include "gem/analysis/test_signals.h"
#include "validation/paper/analysis/chaos/impulse_oscillator.h"
#include "validation/paper/analysis/chaos/nonlinearity.h"
#include "validation/paper/analysis/chaos/test_lorenz.h"

namespace gem {
namespace {

TEST(Surrogate, KeepsTheValuesAndTheCorrelation) {
  const std::vector<double> signal = red_noise(1024, 0.8, 3);
  const std::vector<double> other = surrogate(signal, 5);
  std::vector<double> a = signal;
  std::vector<double> b = other;
  EXPECT_NE(a, b);
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  EXPECT_EQ(a, b);
  const std::vector<double> before = autocorrelation(signal, 20);
  const std::vector<double> after = autocorrelation(other, 20);
  // What the last exchange of values leaves of the spectrum, and the ends that the circular transform joins.
  for (std::size_t lag = 1; lag <= 20; ++lag) EXPECT_NEAR(after[lag], before[lag], 0.02) << lag;
  EXPECT_EQ(other, surrogate(signal, 5));
  EXPECT_NE(other, surrogate(signal, 6));
  EXPECT_THROW(surrogate(std::vector<double>(15, 1.0), 1), std::invalid_argument);
}

TEST(TimeReversalAsymmetry, OfASawTooth) {
  std::vector<double> saw(200);
  for (std::size_t i = 0; i < saw.size(); ++i) saw[i] = static_cast<double>(i % 10);
  const double forward = time_reversal_asymmetry(saw, 1);
  std::reverse(saw.begin(), saw.end());
  EXPECT_DOUBLE_EQ(time_reversal_asymmetry(saw, 1), -forward);
  EXPECT_LT(forward, -1.0);
  EXPECT_EQ(time_reversal_asymmetry(std::vector<double>(50, 1.0), 3), 0.0);
  EXPECT_THROW(time_reversal_asymmetry(saw, 0), std::invalid_argument);
}

TEST(PredictionError, OfAMapAndOfNoise) {
  EXPECT_LT(prediction_error(logistic_map(500, 4.0), {{1, 1, 1}, 1, 4}), 0.1);
  // The mean of ten neighbours of independent values: sqrt(1 + 1/10).
  EXPECT_NEAR(prediction_error(white_noise(800, 1.0, 2), {{3, 1, 1}, 1, 10}), 1.05, 0.08);
  EXPECT_THROW(prediction_error(std::vector<double>(100, 1.0)), std::invalid_argument);
  EXPECT_THROW(prediction_error(white_noise(8, 1.0, 1), {{3, 4, 1}, 1, 10}), std::invalid_argument);
}

TEST(SurrogateTest, RejectsChaos) {
  const auto error = [](std::span<const double> x) { return prediction_error(x, {{2, 1, 1}, 1, 5}); };
  const SurrogateTest test = surrogate_test(logistic_map(256, 4.0), error, 19);
  EXPECT_EQ(test.p_low, 0.05);
  EXPECT_LT(test.observed, 0.5 * *std::min_element(test.surrogates.begin(), test.surrogates.end()));
  EXPECT_EQ(test.surrogates.size(), 19u);
}

TEST(LongSurrogateTest, RejectsTheLorenzSystem) {
  const std::vector<double> x = Lorenz(0.7).record(1024, 0.1);
  const auto error = [](std::span<const double> s) { return prediction_error(s, {{3, 1, 10}, 2, 5}); };
  EXPECT_EQ(surrogate_test(x, error, 39).p_low, 1.0 / 40.0);
}

// 200 records of linear noise, 19 surrogates: a one-sided test rejects 5 %, one deviation is 1.5 %.
TEST(LongSurrogateTest, PassesRedNoise) {
  const auto error = [](std::span<const double> x) { return prediction_error(x, {{3, 1, 5}, 1, 5}); };
  int by_error = 0;
  int by_asymmetry = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::vector<double> noise = red_noise(256, 0.7, 50 + seed);
    by_error += surrogate_test(noise, error, 19, 1000 * seed).p_low <= 0.05 ? 1 : 0;
    by_asymmetry += surrogate_test(
                        noise, [](std::span<const double> x) { return time_reversal_asymmetry(x, 1); }, 39, 1000 * seed)
                                .two_sided() <= 0.05
                        ? 1
                        : 0;
  }
  EXPECT_LE(by_error, 22);
  EXPECT_LE(by_asymmetry, 22);
}

TEST(EndMatched, EndsAsItBegins) {
  const std::vector<double> signal = sine(500, 37.0);
  const std::vector<double> stretch = end_matched(signal, 185);
  ASSERT_EQ(stretch.size(), 185u);
  // Five whole periods: the sample after the last is the first again; the slope turns by (2 pi / 37)^2 a sample.
  EXPECT_NEAR(stretch.back() + (stretch[1] - stretch[0]), stretch[0], 0.03);
  EXPECT_THROW(end_matched(signal, 499), std::invalid_argument);
}

// The null model sampled eight times a period for 125 periods: linear, so 5 % are rejected; of 60, one deviation
// is 1.7.
TEST(LongSurrogateTest, PassesTheNullModel) {
  ImpulseOscillator model;
  model.natural_period = 80.0;
  model.damping_ratio = 0.02;
  const auto record = [&model](std::uint64_t seed) {
    std::vector<double> x = impulse_oscillator(model, 1500, 10.0, seed).position;
    return end_matched(std::span(x).subspan(400), 1000);
  };
  const auto error = [](std::span<const double> x) { return prediction_error(x, {{3, 2, 16}, 4, 5}); };
  int by_surrogates = 0;
  int by_model = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const std::vector<double> x = record(777 + seed);
    by_surrogates += surrogate_test(x, error, 19, 1000 * seed).p_low <= 0.05 ? 1 : 0;
    by_model += test_against(x, error, record, 19, 100000 + 1000 * seed).p_low <= 0.05 ? 1 : 0;
  }
  EXPECT_LE(by_surrogates, 9);
  EXPECT_LE(by_model, 9);
}

}  // namespace
}  // namespace gem
