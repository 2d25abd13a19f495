// Conditional exceedance rates by hand, and extremes of peaks whose law is known.
#include "validation/paper/analysis/extremes/acer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

TEST(Acer, ByHand) {
  const std::vector<std::vector<double>> runs = {{1, 3, 3, 1, 1, 3}, {3, 1, 3, 1, 1, 1}};
  const std::vector<double> levels = {2.0};
  // k = 1: 3 of 6 and 2 of 6. k = 2: after one low peak, 2 of 5 and 1 of 5. k = 3: after two, 1 of 4 and 0 of 4.
  EXPECT_NEAR(acer(runs, 1, levels).rate[0], 2.5 / 6.0, 1e-15);
  EXPECT_NEAR(acer(runs, 2, levels).rate[0], 0.3, 1e-15);
  EXPECT_NEAR(acer(runs, 3, levels).rate[0], 0.125, 1e-15);
  EXPECT_NEAR(acer(runs, 2, levels).half_width[0], 1.96 * 0.1, 1e-12);
  EXPECT_THROW(acer(runs, 6, levels), std::invalid_argument);
  EXPECT_THROW(acer({runs[0]}, 1, levels), std::invalid_argument);
}

/// Peaks of a narrow-band normal record: independent, P(peak > x) = exp(-x^2 / 2).
std::vector<std::vector<double>> rayleigh_runs(std::size_t runs, std::size_t peaks, std::uint64_t seed) {
  RandomSequence random = test_random(seed);
  std::vector<std::vector<double>> result(runs, std::vector<double>(peaks));
  for (auto& run : result)
    for (double& peak : run) peak = std::sqrt(-2.0 * std::log(random.uniform()));
  return result;
}

TEST(AcerTail, OfACurveWithoutScatterIsExact) {
  AcerCurve curve;
  const AcerTail truth{0.8, 0.5, 0.3, 1.7};
  for (int i = 0; i < 30; ++i) {
    curve.level.push_back(1.0 + 0.1 * i);
    curve.rate.push_back(truth.rate(curve.level.back()));
    curve.half_width.push_back(0.1 * curve.rate.back());
  }
  const auto tail = fit_acer_tail(curve, 1.0);
  ASSERT_TRUE(tail.has_value());
  // The valley of b and c is flat, but all its points give the same tail.
  EXPECT_NEAR(tail->quantile(0.9, 1000.0), truth.quantile(0.9, 1000.0), 0.01 * truth.quantile(0.9, 1000.0));
  EXPECT_NEAR(truth.rate(truth.quantile(0.9, 1000.0)) * 1000.0, -std::log(0.9), 1e-12);
}

TEST(AcerQuantile, OfRayleighPeaks) {
  const AcerQuestion question{1, 1.2, 40, 0.9, 300.0};
  const auto estimate = acer_quantile(rayleigh_runs(20, 100, 4), question, {50, 0.95, 1});
  ASSERT_TRUE(estimate.has_value());
  // P(peak > x) = -ln 0.9 / 300.
  const double truth = std::sqrt(2.0 * std::log(300.0 / -std::log(0.9)));
  EXPECT_TRUE(estimate->holds(truth));
  EXPECT_NEAR(estimate->value, truth, 0.15 * truth);
  EXPECT_FALSE(acer_quantile(rayleigh_runs(20, 100, 4), {1, 50.0, 40, 0.9, 300.0}).has_value());
}

// Every peak occurs twice. Order 2 counts each pair once, so its rate is half that of order 1.
TEST(Acer, SecondOrderSeesClusters) {
  auto runs = rayleigh_runs(20, 500, 8);
  for (auto& run : runs) {
    std::vector<double> twice;
    for (const double peak : run) twice.insert(twice.end(), {peak, peak});
    run = twice;
  }
  const std::vector<double> levels = {2.5};
  EXPECT_NEAR(acer(runs, 2, levels).rate[0] / acer(runs, 1, levels).rate[0], 0.5, 0.03);
}

// 60 intervals of 95 %: one standard deviation is 2.8 %. The form of the tail is not exact within its levels, so some
// coverage is lost.
TEST(LongAcerQuantile, IntervalOverRunsCovers) {
  const double truth = std::sqrt(2.0 * std::log(300.0 / -std::log(0.9)));
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const auto estimate =
        acer_quantile(rayleigh_runs(30, 100, 100 + seed), {1, 1.2, 40, 0.9, 300.0}, {100, 0.95, seed});
    ASSERT_TRUE(estimate.has_value());
    covered += estimate->holds(truth) ? 1 : 0;
  }
  EXPECT_GE(covered, 50);
}

}  // namespace
}  // namespace gem
