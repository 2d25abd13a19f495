// Distributions against their closed forms, and designs against what they promise.
#include "gem/scene/sweep/distribution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "gem/scene/sweep/draw_design.h"
#include "gem/scene/sweep/normal_quantile.h"

namespace gem {
namespace {

double normal_below(double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }

Distribution of(Distribution::Law law, double mean, double deviation, double low, double high) {
  Distribution result;
  result.law = law;
  result.mean = mean;
  result.deviation = deviation;
  result.low = low;
  result.high = high;
  result.prepare();
  return result;
}

struct Known {
  const char* name;
  Distribution distribution;
  std::function<double(double)> below;  // P(X <= x)
};

std::vector<Known> known_laws() {
  using Law = Distribution::Law;
  Distribution table;
  table.law = Law::quantiles;
  table.quantiles = {{0.0, 1.0}, {0.25, 2.0}, {1.0, 8.0}};
  const double a = normal_below(-1.0), b = normal_below(2.0);
  const double variance = std::log(1.0 + 0.25), centre = std::log(4.0) - 0.5 * variance;  // mean 4, deviation 2
  const auto log_below = [=](double x) { return normal_below((std::log(x) - centre) / std::sqrt(variance)); };
  return {{"uniform", of(Law::uniform, 0, 0, -1.0, 3.0), [](double x) { return (x + 1.0) / 4.0; }},
          {"normal", of(Law::normal, 10.0, 2.0, -Distribution::infinity, Distribution::infinity),
           [](double x) { return normal_below((x - 10.0) / 2.0); }},
          {"normal with bounds", of(Law::normal, 10.0, 2.0, 8.0, 14.0),
           [=](double x) { return (normal_below((x - 10.0) / 2.0) - a) / (b - a); }},
          {"lognormal", of(Law::lognormal, 4.0, 2.0, -Distribution::infinity, Distribution::infinity), log_below},
          {"lognormal with bounds", of(Law::lognormal, 4.0, 2.0, 2.0, 9.0),
           [=](double x) { return (log_below(x) - log_below(2.0)) / (log_below(9.0) - log_below(2.0)); }},
          {"quantiles", table, [](double x) { return x < 2.0 ? 0.25 * (x - 1.0) : 0.25 + 0.75 * (x - 2.0) / 6.0; }}};
}

TEST(NormalQuantile, InvertsTheDistributionFunction) {
  for (const double p : {1e-300, 1e-20, 1e-9, 0.001, 0.02425, 0.075, 0.3, 0.5, 0.8, 0.99, 0.999999}) {
    const double x = normal_quantile(p);
    EXPECT_NEAR(normal_below(x) / p, 1.0, 1e-12) << p;  // the distribution function is that steep in the tail
  }
  EXPECT_EQ(normal_quantile(0.5), 0.0);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-15);
}

TEST(Distribution, QuantilesInvertTheDistributionFunction) {
  for (const Known& known : known_laws())
    for (const double u : {1e-6, 0.01, 0.2, 0.25, 0.5, 0.77, 0.99, 1.0 - 1e-6})
      EXPECT_NEAR(known.below(known.distribution.quantile(u)), u, 1e-12) << known.name << " at " << u;
}

/// Kolmogorov and Smirnov at the level 0.1 %: six laws and three seeds would fail by chance once in 55 choices of
/// seeds.
TEST(Distribution, RandomDrawsFollowTheLaw) {
  constexpr std::size_t count = 4000;
  for (const std::uint64_t seed : {1u, 2u, 3u})
    for (const Known& known : known_laws()) {
      std::vector<double> below;
      for (const double u : draw_numbers({Sampling::random, seed, count}, known.name))
        below.push_back(known.below(known.distribution.quantile(u)));
      std::sort(below.begin(), below.end());
      double distance = 0.0;
      for (std::size_t i = 0; i < count; ++i)
        distance = std::max({distance, std::abs(below[i] - static_cast<double>(i) / count),
                             std::abs(below[i] - static_cast<double>(i + 1) / count)});
      EXPECT_LT(distance * std::sqrt(static_cast<double>(count)), 1.95) << known.name << ", seed " << seed;
    }
}

/// In a Latin hypercube of n draws the mean of a bounded law has an error below its range over n.
TEST(Distribution, MomentsOfALatinHypercubeAreNearlyExact) {
  constexpr std::size_t count = 2000;
  const auto mean_of = [](const Known& known, double power) {
    double sum = 0.0;
    for (const double u : draw_numbers({Sampling::latin_hypercube, 7, count}, "x"))
      sum += std::pow(known.distribution.quantile(u), power) / count;
    return sum;
  };
  const std::vector<Known> laws = known_laws();
  EXPECT_NEAR(mean_of(laws[0], 1), 1.0, 4.0 / count);
  EXPECT_NEAR(mean_of(laws[0], 2), 7.0 / 3.0, 9.0 / count);
  EXPECT_NEAR(mean_of(laws[1], 1), 10.0, 0.005);
  EXPECT_NEAR(mean_of(laws[1], 2), 104.0, 0.1);
  // Normal between a = -1 and b = 2 deviations: mean + deviation (phi(a) - phi(b)) / (Phi(b) - Phi(a)).
  EXPECT_NEAR(mean_of(laws[2], 1), 10.0 + 2.0 * (0.24197072451914337 - 0.05399096651318806) / 0.8185946141203637,
              6.0 / count);
  EXPECT_NEAR(mean_of(laws[3], 1), 4.0, 0.02);
  EXPECT_NEAR(mean_of(laws[3], 2), 20.0, 0.5);
  EXPECT_NEAR(mean_of(laws[5], 1), 0.25 * 1.5 + 0.75 * 5.0, 7.0 / count);
}

TEST(Distribution, ValuesComeByTheirWeights) {
  Distribution law;
  law.law = Distribution::Law::values;
  law.values = {200.0, 300.0, 400.0};
  law.weights = {1.0, 2.0, 1.0};
  std::vector<double> seen(3, 0.0);
  for (const double u : draw_numbers({Sampling::random, 1, 4000}, "gap"))
    seen[static_cast<std::size_t>(law.quantile(u) / 100.0) - 2] += 1.0;
  const std::vector<double> expected = {1000.0, 2000.0, 1000.0};
  double chi_square = 0.0;
  for (std::size_t i = 0; i < 3; ++i) chi_square += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
  EXPECT_LT(chi_square, 13.8);  // 0.1 % with two degrees of freedom
}

TEST(Distribution, WholeNumbersAreAllAlike) {
  Distribution law = of(Distribution::Law::uniform, 0, 0, 3.0, 12.0);
  law.whole = true;
  std::vector<double> seen(10, 0.0);
  for (const double u : draw_numbers({Sampling::latin_hypercube, 1, 1000}, "seed")) {
    const double value = law.quantile(u);
    ASSERT_EQ(value, std::floor(value));
    seen.at(static_cast<std::size_t>(value - 3.0)) += 1.0;
  }
  EXPECT_EQ(seen, std::vector<double>(10, 100.0));
  EXPECT_EQ(law.quantile(1.0 - 0x1p-53), 12.0);
  EXPECT_EQ(law.quantile(0x1p-53), 3.0);
}

TEST(DrawDesign, ALatinHypercubeHasOneDrawInEachStratum) {
  for (const std::size_t count : {1u, 2u, 7u, 64u, 1000u})
    for (const char* name : {"friction", "strength"}) {
      std::set<std::size_t> strata;
      for (const double u : draw_numbers({Sampling::latin_hypercube, 5, count}, name)) {
        EXPECT_TRUE(u > 0.0 && u < 1.0);
        strata.insert(static_cast<std::size_t>(u * static_cast<double>(count)));
      }
      EXPECT_EQ(strata.size(), count) << name;
    }
}

TEST(DrawDesign, ARandomDrawDependsOnSeedNameAndNumberOnly) {
  const auto few = draw_numbers({Sampling::random, 5, 10}, "friction");
  const auto many = draw_numbers({Sampling::random, 5, 1000}, "friction");
  EXPECT_TRUE(std::equal(few.begin(), few.end(), many.begin()));
  EXPECT_NE(few, draw_numbers({Sampling::random, 6, 10}, "friction"));
  EXPECT_NE(few, draw_numbers({Sampling::random, 5, 10}, "strength"));
  EXPECT_NE(few, draw_numbers({Sampling::random, 5, 10}, "friction", 1)) << "a repeat";
  EXPECT_NE(few, second_draw_numbers({Sampling::random, 5, 10}, "friction"));
  // These bits are the contract: a change would change every sweep with draws. Computed by a second program.
  EXPECT_EQ(few[0], 0x1.df5b3c70a36b9p-1);
  EXPECT_EQ(draw_numbers({Sampling::latin_hypercube, 5, 10}, "friction")[3], 0x1.04bf19e67f00ap-2);
}

/// The correlation of independent numbers has the deviation 1 / sqrt(n).
TEST(DrawDesign, VariablesAreIndependent) {
  constexpr std::size_t count = 2000;
  const std::vector<std::string> names = {"a", "b", "ab", "ba", "friction", "friction_ice"};
  for (const Sampling sampling : {Sampling::random, Sampling::latin_hypercube})
    for (std::size_t i = 0; i < names.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const auto x = draw_numbers({sampling, 1, count}, names[i]), y = draw_numbers({sampling, 1, count}, names[j]);
        double sum = 0.0;
        for (std::size_t k = 0; k < count; ++k) sum += 12.0 * (x[k] - 0.5) * (y[k] - 0.5) / count;
        EXPECT_LT(std::abs(sum) * std::sqrt(static_cast<double>(count)), 4.0) << names[i] << " and " << names[j];
      }
}

}  // namespace
}  // namespace gem
