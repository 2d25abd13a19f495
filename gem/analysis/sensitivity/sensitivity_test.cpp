// Shares of variance against models whose shares are known exactly.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "gem/analysis/sensitivity/regression.h"
#include "gem/analysis/sensitivity/sobol.h"
#include "gem/analysis/statistics/random_streams.h"

namespace gem {
namespace {

using Model = std::function<double(const std::vector<double>&)>;

RandomSequence numbers_of(std::uint64_t seed) { return random_sequence(seed, AnalysisStream::test_signal); }

/// Draws of inputs uniform in (0, 1); `noise` is the deviation of normal noise in each repeat.
DrawnRuns drawn(const Model& model, std::size_t inputs, std::size_t draws, std::uint64_t seed, double noise = 0.0,
                std::size_t repeats = 1) {
  RandomSequence random = numbers_of(seed);
  DrawnRuns runs;
  runs.inputs.assign(inputs, std::vector<double>(draws));
  for (std::size_t i = 0; i < draws; ++i) {
    std::vector<double> x(inputs);
    for (std::size_t k = 0; k < inputs; ++k) runs.inputs[k][i] = x[k] = random.uniform();
    runs.outputs.emplace_back();
    for (std::size_t r = 0; r < repeats; ++r) runs.outputs.back().push_back(model(x) + noise * random.normal());
  }
  return runs;
}

SaltelliRuns saltelli(const Model& model, std::size_t inputs, std::size_t draws, std::uint64_t seed) {
  RandomSequence random = numbers_of(seed);
  SaltelliRuns runs;
  runs.a_with_b.resize(inputs);
  for (std::size_t i = 0; i < draws; ++i) {
    std::vector<double> a(inputs), b(inputs);
    for (double& x : a) x = random.uniform();
    for (double& x : b) x = random.uniform();
    runs.a.push_back(model(a));
    runs.b.push_back(model(b));
    for (std::size_t k = 0; k < inputs; ++k) {
      std::vector<double> mixed = a;
      mixed[k] = b[k];
      runs.a_with_b[k].push_back(model(mixed));
    }
  }
  return runs;
}

/// y = 4 x0 - 2 x1 + 0 x2 with noise: variances 16/12, 4/12, 0 and 4/12, so shares 2/3, 1/6, 0 and 1/6.
double linear_model(const std::vector<double>& x) { return 4.0 * x[0] - 2.0 * x[1]; }
const double linear_noise = std::sqrt(4.0 / 12.0);
const std::vector<double> linear_shares = {16.0 / 24.0, 4.0 / 24.0, 0.0};

/// Ishigami and Homma 1990: sin a + 7 sin^2 b + 0.1 c^4 sin a, inputs uniform in (-pi, pi).
double ishigami(const std::vector<double>& x) {
  const auto angle = [&x](std::size_t k) { return std::numbers::pi * (2.0 * x[k] - 1.0); };
  return std::sin(angle(0)) + 7.0 * std::pow(std::sin(angle(1)), 2.0) +
         0.1 * std::pow(angle(2), 4.0) * std::sin(angle(0));
}
// Their variances in closed form: V = a^2 / 8 + b pi^4 / 5 + b^2 pi^8 / 18 + 1 / 2 with a = 7, b = 0.1.
const std::vector<double> ishigami_first = {0.31390519114781146, 0.44241114479004084, 0.0};
const std::vector<double> ishigami_total = {0.55758885520995916, 0.44241114479004084, 0.24368366406214773};

/// Sobol's g-function with a = 0, 1, 9: first_k = V_k / V with V_k = 1 / (3 (1 + a_k)^2), V = prod (1 + V_k) - 1.
const std::vector<double> g_parameters = {0.0, 1.0, 9.0};
double g_function(const std::vector<double>& x) {
  double product = 1.0;
  for (std::size_t k = 0; k < x.size(); ++k)
    product *= (std::abs(4.0 * x[k] - 2.0) + g_parameters[k]) / (1.0 + g_parameters[k]);
  return product;
}

TEST(Ranks, EqualValuesShareTheirMean) {
  EXPECT_EQ(ranks({3.0, 1.0, 3.0, 2.0}), (std::vector<double>{3.5, 1.0, 3.5, 2.0}));
  EXPECT_TRUE(ranks({}).empty());
  const DrawnRuns runs = ranked({{{0.5, -1.0}}, {{7.0, 9.0}, {8.0, 1.0}}});
  EXPECT_EQ(runs.inputs[0], (std::vector<double>{2.0, 1.0}));
  EXPECT_EQ(runs.outputs[1], (std::vector<double>{3.0, 1.0}));
}

/// Without noise the coefficients of a sample are exact: share_k = c_k^2 var(x_k) / var(y), whatever was drawn.
TEST(TrendShares, AreExactWithoutNoise) {
  const DrawnRuns runs = drawn([](const std::vector<double>& x) { return 3.0 * x[0] - x[1]; }, 2, 50, 1);
  const TrendShares shares = trend_shares(runs, {50});
  std::vector<double> y;
  for (const auto& outputs : runs.outputs) y.push_back(outputs[0]);
  const auto variance = [](const std::vector<double>& v) {
    const double mean = std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
    double sum = 0.0;
    for (const double x : v) sum += (x - mean) * (x - mean);
    return sum;
  };
  EXPECT_NEAR(shares.inputs[0].share.value, 9.0 * variance(runs.inputs[0]) / variance(y), 1e-12);
  EXPECT_NEAR(shares.inputs[1].share.value, variance(runs.inputs[1]) / variance(y), 1e-12);
  EXPECT_GT(shares.inputs[0].coefficient.value, 0.0);
  EXPECT_LT(shares.inputs[1].coefficient.value, 0.0);
  EXPECT_NEAR(shares.explained, 1.0, 1e-12);
}

/// The error of a share of 4000 draws is about 0.01.
TEST(TrendShares, FindTheSharesOfALinearModel) {
  const TrendShares shares = trend_shares(drawn(linear_model, 3, 4000, 2, linear_noise), {50});
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(shares.inputs[k].share.value, linear_shares[k], 0.03) << k;
  EXPECT_NEAR(shares.explained, 20.0 / 24.0, 0.03);
}

/// 95 % intervals of 40 draws with two repeats each: of 200 studies at least 90 % must hold the truth. By chance fewer
/// than 180 of 200 happen with a probability of 0.2 % if the intervals are right.
TEST(TrendShares, IntervalsHoldTheTruth) {
  std::vector<int> held(3, 0);
  for (std::uint64_t study = 0; study < 200; ++study) {
    const TrendShares shares = trend_shares(drawn(linear_model, 3, 40, 100 + study, linear_noise, 2), {200});
    for (std::size_t k = 0; k < 3; ++k) held[k] += shares.inputs[k].share.holds(linear_shares[k]) ? 1 : 0;
  }
  for (const int count : held) EXPECT_GE(count, 180);
}

TEST(TrendShares, RanksSeeACurvedTrendAsOne) {
  const DrawnRuns runs = drawn([](const std::vector<double>& x) { return std::exp(12.0 * x[0]); }, 2, 200, 3);
  EXPECT_LT(trend_shares(runs, {20}).inputs[0].share.value, 0.7);
  EXPECT_NEAR(trend_shares(ranked(runs), {20}).inputs[0].share.value, 1.0, 1e-2);
}

TEST(TrendShares, InputsThatNeverChangeHaveNone) {
  DrawnRuns runs = drawn(linear_model, 3, 30, 4);
  runs.inputs[2].assign(30, 0.1);
  const TrendShares shares = trend_shares(runs, {20});
  EXPECT_EQ(shares.inputs[2].share.value, 0.0);
  EXPECT_NEAR(shares.explained, 1.0, 1e-9);
  EXPECT_THROW(trend_shares(drawn(linear_model, 3, 13, 4)), std::invalid_argument);
}

TEST(SobolIndices, OfTheIshigamiFunction) {
  const std::vector<SobolIndex> indices = sobol_indices(saltelli(ishigami, 3, 4000, 1));
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(indices[k].first.value, ishigami_first[k], 0.05) << k;
    EXPECT_NEAR(indices[k].total.value, ishigami_total[k], 0.05) << k;
    EXPECT_TRUE(indices[k].first.holds(ishigami_first[k])) << k;
    EXPECT_TRUE(indices[k].total.holds(ishigami_total[k])) << k;
  }
}

TEST(SobolIndices, OfTheGFunction) {
  std::vector<double> part;
  double variance = 1.0;
  for (const double a : g_parameters) {
    part.push_back(1.0 / (3.0 * (1.0 + a) * (1.0 + a)));
    variance *= 1.0 + part.back();
  }
  variance -= 1.0;
  const std::vector<SobolIndex> indices = sobol_indices(saltelli(g_function, 3, 4000, 2), {200});
  for (std::size_t k = 0; k < 3; ++k) {
    const double total = part[k] * (variance + 1.0) / (1.0 + part[k]) / variance;
    EXPECT_NEAR(indices[k].first.value, part[k] / variance, 0.05) << k;
    EXPECT_NEAR(indices[k].total.value, total, 0.05) << k;
  }
  SaltelliRuns broken = saltelli(g_function, 3, 10, 2);
  broken.b.pop_back();
  EXPECT_THROW(sobol_indices(broken), std::invalid_argument);
}

TEST(FirstOrder, FromPlainDraws) {
  const std::vector<IntervalEstimate> first = first_order_indices(drawn(ishigami, 3, 4000, 5), {100});
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(first[k].value, ishigami_first[k], 0.05) << k;
  EXPECT_THROW(first_order_indices(drawn(ishigami, 3, 39, 5)), std::invalid_argument);
}

/// As for trends; here with a dependence that no trend shows: y = (2 x - 1)^2 + noise of the same variance.
TEST(FirstOrder, IntervalsHoldTheTruth) {
  const Model bent = [](const std::vector<double>& x) { return (2.0 * x[0] - 1.0) * (2.0 * x[0] - 1.0); };
  const double noise = std::sqrt(4.0 / 45.0);  // the variance of the square
  int held = 0, held_none = 0;
  for (std::uint64_t study = 0; study < 200; ++study) {
    const std::vector<IntervalEstimate> first = first_order_indices(drawn(bent, 2, 100, 400 + study, noise), {200});
    held += first[0].holds(0.5) ? 1 : 0;
    held_none += first[1].holds(0.0) ? 1 : 0;
  }
  EXPECT_GE(held, 180);
  EXPECT_GE(held_none, 180);
}

/// Noise of a quarter of the variance between repeats.
TEST(RepeatShare, IsTheVarianceWithinDraws) {
  const Model model = [](const std::vector<double>& x) { return 6.0 * x[0]; };  // variance 3
  EXPECT_NEAR(repeat_share(drawn(model, 1, 4000, 6, 1.0, 2), {50}).value, 0.25, 0.02);
  EXPECT_NEAR(repeat_share(drawn(model, 1, 4000, 7, 1.0, 3), {50}).value, 0.25, 0.02);
  EXPECT_EQ(repeat_share(drawn(model, 1, 10, 8, 0.0, 2), {50}).value, 0.0);
  const IntervalEstimate all = repeat_share(drawn([](const std::vector<double>&) { return 0.0; }, 1, 30, 9, 1.0, 2));
  EXPECT_LE(all.high, 1.0);
  EXPECT_TRUE(all.holds(1.0));
  int held = 0;
  for (std::uint64_t study = 0; study < 200; ++study)
    held += repeat_share(drawn(model, 1, 40, 800 + study, 1.0, 2), {200}).holds(0.25) ? 1 : 0;
  EXPECT_GE(held, 180);
  EXPECT_THROW(repeat_share(drawn(model, 1, 40, 8)), std::invalid_argument);
}

}  // namespace
}  // namespace gem
