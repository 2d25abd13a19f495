// Intervals by resampling of samples whose true value is known: they are repeatable and have the stated coverage.
#include "gem/analysis/statistics/bootstrap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(Bootstrap, TheSameSeedGivesTheSameInterval) {
  const std::vector<double> values = white_noise(30, 1.0, 3);
  const IntervalEstimate once = bootstrap_values(values, mean_of);
  const IntervalEstimate again = bootstrap_values(values, mean_of);
  const IntervalEstimate other = bootstrap_values(values, mean_of, {1000, 0.95, 2});
  EXPECT_DOUBLE_EQ(once.value, mean_of(values));
  EXPECT_EQ(once.low, again.low);
  EXPECT_EQ(once.high, again.high);
  EXPECT_NE(once.low, other.low);
}

// The interval of a mean is Student's: 2.045 / sqrt(30) for 30 values. 4000 resamples find its ends to about 4 %.
TEST(Bootstrap, OfAMeanIsAsWideAsStudents) {
  const std::vector<double> values = white_noise(30, 1.0, 4);
  double squares = 0.0;
  for (const double value : values) squares += std::pow(value - mean_of(values), 2);
  const double student = 2.0 * 2.045 * std::sqrt(squares / 29.0 / 30.0);
  const IntervalEstimate estimate = bootstrap_values(values, mean_of, {4000, 0.95, 1});
  EXPECT_NEAR(estimate.high - estimate.low, student, 0.1 * student);
}

TEST(Bootstrap, RefusesOneRunAndSillyOptions) {
  EXPECT_THROW(bootstrap_values(std::vector<double>{1.0}, mean_of), std::invalid_argument);
  EXPECT_THROW(bootstrap_values(std::vector<double>{1.0, 2.0}, mean_of, {5, 0.95, 1}), std::invalid_argument);
  EXPECT_THROW(bootstrap_values(std::vector<double>{1.0, 2.0}, mean_of, {100, 1.0, 1}), std::invalid_argument);
  EXPECT_THROW(moving_block_mean(std::vector<double>(10, 1.0), 6), std::invalid_argument);
  EXPECT_THROW(moving_block_mean(std::vector<double>(10, 1.0), 0), std::invalid_argument);
}

// 2000 intervals of 95 %: the number that contain the true mean is 1900 with a deviation of 10. Student's t is exact
// for normal runs.
TEST(MeanOfRuns, HoldsTheMeanOfAFewRuns) {
  for (const std::size_t runs : {2U, 3U, 4U, 9U}) {
    int covered = 0;
    for (std::uint64_t seed = 0; seed < 2000; ++seed)
      covered += mean_of_runs(white_noise(runs, 1.0, seed)).holds(0.0) ? 1 : 0;
    EXPECT_GE(covered, 1870) << runs;
    EXPECT_LE(covered, 1930) << runs;
  }
}

TEST(MeanOfRuns, IsStudentsOfAFewAndTheBootstrapOfMany) {
  const IntervalEstimate two = mean_of_runs(std::vector<double>{1.0, 3.0});
  EXPECT_DOUBLE_EQ(two.value, 2.0);
  EXPECT_NEAR(two.high - 2.0, 12.7062, 1e-4) << "t of one degree of freedom times a standard error of 1";
  const std::vector<double> many = white_noise(kRunsForBootstrap, 1.0, 3);
  EXPECT_EQ(mean_of_runs(many).low, bootstrap_values(many, mean_of).low);
  EXPECT_THROW(mean_of_runs(std::vector<double>{1.0}), std::invalid_argument);
}

// 400 intervals of 95 %: the share that contain the true mean has a deviation of 1.1 %. The limits 91 and 98.5 % allow
// three deviations and 1 % that a percentile interval of 20 values may lack.
TEST(LongBootstrap, CoversTheMeanOfTwentyRuns) {
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed)
    covered += bootstrap_values(white_noise(20, 1.0, seed), mean_of, {400, 0.95, seed}).holds(0.0) ? 1 : 0;
  EXPECT_GE(covered, 364);
  EXPECT_LE(covered, 394);
}

// A memory of 0.9 decays within 10 samples. Blocks of 200 samples miss 10 / 200 of the variance, 2 % of the width.
TEST(LongBootstrap, MovingBlocksCoverTheMeanOfRedNoise) {
  int covered = 0;
  double width = 0.0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const IntervalEstimate estimate = moving_block_mean(red_noise(8000, 0.9, seed), 200, {400, 0.95, seed});
    covered += estimate.holds(0.0) ? 1 : 0;
    width += (estimate.high - estimate.low) / 400.0;
  }
  EXPECT_GE(covered, 360);
  EXPECT_LE(covered, 394);
  const double known = 2.0 * 1.96 * 10.0 / std::sqrt(8000.0);
  EXPECT_NEAR(width, known, 0.1 * known);
}

}  // namespace
}  // namespace gem
