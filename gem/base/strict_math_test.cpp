// Strict functions: error bounds against extended precision over the whole range, exact values, special arguments.
#include "gem/base/strict_math.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "gem/base/random.h"

namespace gem {
namespace {

constexpr int draws = 100000;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// Relative error against an extended-precision value.
double error(double computed, long double exact) {
  return static_cast<double>(std::fabs((static_cast<long double>(computed) - exact) / exact));
}

/// A positive number with a logarithm uniform between those of 2^low and 2^high.
double any_size(RandomSequence& random, double low, double high) {
  return static_cast<double>(std::exp2(static_cast<long double>(random.uniform(low, high))));
}

TEST(StrictMath, ExtendedPrecisionIsExtended) { EXPECT_GE(std::numeric_limits<long double>::digits, 64); }

TEST(StrictMath, LogOverTheWholeRangeAndNearOne) {
  RandomSequence random(Random(1, 0));
  double worst = 0.0;
  for (int i = 0; i < draws; ++i) {
    const double wide = any_size(random, -1074.0, 1024.0);
    worst = std::max(worst, error(strict::log(wide), std::log(static_cast<long double>(wide))));
    const double near_one = 1.0 + random.uniform(-0.3, 0.3) * random.uniform() * random.uniform();
    if (near_one != 1.0)
      worst = std::max(worst, error(strict::log(near_one), std::log(static_cast<long double>(near_one))));
  }
  RecordProperty("worst_in_1e-16", std::to_string(worst * 1e16));
  EXPECT_LT(worst, 4e-16);
}

TEST(StrictMath, Log1pFromSubnormalToHuge) {
  RandomSequence random(Random(2, 0));
  double worst = 0.0;
  auto check = [&](double z) {
    const long double exact = std::log1p(static_cast<long double>(z));
    // a subnormal result has a larger spacing
    if (z > 1e-300) {
      worst = std::max(worst, error(strict::log1p(z), exact));
    } else {
      EXPECT_NEAR(strict::log1p(z), static_cast<double>(exact), 2.0 * smallest) << z;
    }
  };
  for (int i = 0; i < draws; ++i) {
    check(any_size(random, -1074.0, 1024.0));
    check(any_size(random, -8.0, 60.0));
    check(random.uniform(0.0, 0.6));
  }
  RecordProperty("worst_in_1e-16", std::to_string(worst * 1e16));
  EXPECT_LT(worst, 4e-16);
}

TEST(StrictMath, ExpOverTheWholeRange) {
  RandomSequence random(Random(3, 0));
  double worst = 0.0;
  for (int i = 0; i < draws; ++i) {
    for (const double y : {random.uniform(-708.0, 709.78), random.uniform(-1.0, 1.0)})
      worst = std::max(worst, error(strict::exp(y), std::exp(static_cast<long double>(y))));
    const double low = random.uniform(-746.0, -708.0);
    EXPECT_NEAR(strict::exp(low), static_cast<double>(std::exp(static_cast<long double>(low))),
                smallest + 4e-16 * strict::exp(low))
        << low;
  }
  RecordProperty("worst_in_1e-16", std::to_string(worst * 1e16));
  EXPECT_LT(worst, 4e-16);
}

TEST(StrictMath, PowerWithItsStatedBound) {
  RandomSequence random(Random(4, 0));
  double worst = 0.0;
  for (int i = 0; i < draws; ++i) {
    const double x = any_size(random, -200.0, 200.0), p = random.uniform(-3.0, 3.0);
    const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(p));
    const double allowed = 1.0 + std::fabs(p * std::log(x));
    worst = std::max(worst, error(strict::power(x, p), exact) / allowed);
  }
  RecordProperty("worst_in_1e-16", std::to_string(worst * 1e16));
  EXPECT_LT(worst, 4e-16);
}

TEST(StrictMath, RotationOfTurns) {
  RandomSequence random(Random(5, 0));
  constexpr long double full = 6.283185307179586476925286766559L;
  double worst = 0.0;
  for (int i = 0; i < draws; ++i) {
    const double turns = random.uniform(-4.0, 4.0);
    const long double angle = full * (static_cast<long double>(turns) - std::floor(static_cast<long double>(turns)));
    const Rotation r = strict::rotation_of_turns(turns);
    worst = std::max(worst, static_cast<double>(std::fabs(r.cosine - std::cos(angle))));
    worst = std::max(worst, static_cast<double>(std::fabs(r.sine - std::sin(angle))));
  }
  RecordProperty("worst_in_1e-16", std::to_string(worst * 1e16));
  EXPECT_LT(worst, 4e-16);
}

TEST(StrictMath, QuarterTurnsAreExact) {
  EXPECT_EQ(strict::rotation_of_turns(0.25).sine, 1.0);
  EXPECT_EQ(strict::rotation_of_turns(0.25).cosine, 0.0);
  EXPECT_EQ(strict::rotation_of_turns(-0.5).cosine, -1.0);
  EXPECT_EQ(strict::rotation_of_turns(2.75).sine, -1.0);
  EXPECT_EQ(strict::rotation_of_angle(0.0).cosine, 1.0);
}

TEST(StrictMath, AngleOfARotation) {
  for (int k = -3141; k <= 3141; ++k) {
    const long double angle = 1e-3L * k;
    const Rotation q{static_cast<double>(std::cos(angle)), static_cast<double>(std::sin(angle))};
    EXPECT_NEAR(strict::angle_of(q), static_cast<double>(angle), 1e-15) << k;
  }
  EXPECT_EQ(strict::angle_of({1.0, 0.0}), 0.0);
  EXPECT_NEAR(strict::angle_of({0.0, 1.0}), 0.25 * strict::two_pi, 1e-15);
  EXPECT_NEAR(strict::angle_of({0.0, -1.0}), -0.25 * strict::two_pi, 1e-15);
  EXPECT_EQ(strict::angle_of({-1.0, 0.0}), 0.5 * strict::two_pi);
}

TEST(StrictMath, ExactAtZeroAndOne) {
  EXPECT_EQ(strict::log(1.0), 0.0);
  EXPECT_EQ(strict::log1p(0.0), 0.0);
  EXPECT_EQ(strict::exp(0.0), 1.0);
  for (const double p : {0.1, 0.9, 1.0, 1.9, 700.0}) {
    EXPECT_EQ(strict::power(1.0, p), 1.0) << p;
    EXPECT_EQ(strict::power(0.0, p), 0.0) << p;
    EXPECT_EQ(strict::power(7.3 * p, 0.0), 1.0) << p;
    EXPECT_EQ(strict::power(7.3 * p, 1.0), 7.3 * p) << p;
  }
}

TEST(StrictMath, EndsOfTheRangeAndWhatIsNoNumber) {
  EXPECT_EQ(strict::exp(710.0), infinity);
  EXPECT_EQ(strict::exp(1e300), infinity);
  EXPECT_EQ(strict::exp(infinity), infinity);
  EXPECT_EQ(strict::exp(-746.0), 0.0);
  EXPECT_EQ(strict::exp(-infinity), 0.0);
  EXPECT_EQ(strict::log(infinity), infinity);
  EXPECT_EQ(strict::log1p(infinity), infinity);
  EXPECT_EQ(strict::power(1e300, 2.0), infinity);
  EXPECT_EQ(strict::power(1e-300, 2.0), 0.0);
  for (const double result : {strict::exp(nan), strict::log(nan), strict::log1p(nan), strict::power(nan, 0.9)})
    EXPECT_TRUE(std::isnan(result));
}

}  // namespace
}  // namespace gem
