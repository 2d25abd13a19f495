// The F-test finds a line in noise at the right frequency, and finds none where there is none.
#include "gem/analysis/spectra/spectral_line.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

TEST(LineTest, FindsALineInNoise) {
  // Amplitude 0.5 in noise of deviation 1: with 2048 samples the power is 23 times the threshold for a line.
  const double period = 88.8577;
  const auto lines = find_lines(line_test(sum_of(sine(2048, period, 0.5, 0.4), white_noise(2048, 1.0, 9)), 1.0));
  ASSERT_FALSE(lines.empty());
  // Standard deviation of the frequency of a line: sqrt(6) sigma / (pi A T sqrt(N)) = 1.7e-5 Hz. The grid adds 3e-5.
  EXPECT_NEAR(lines.front().frequency, 1.0 / period, 8e-5);
  // Standard deviation of its amplitude: sigma sqrt(2 / N) = 0.03, slightly more with tapers.
  EXPECT_NEAR(lines.front().amplitude, 0.5, 0.12);
  EXPECT_LT(lines.front().significance, 1.0 / 2048.0);
}

TEST(LineTest, SeparatesTwoLines) {
  const auto lines = find_lines(
      line_test(sum_of(sum_of(sine(2000, 90.0), sine(2000, 72.0, 0.8, 1.0)), white_noise(2000, 0.1, 4)), 1.0), 1e-5);
  ASSERT_GE(lines.size(), 2u);
  const double first = 1.0 / lines[0].frequency;
  const double second = 1.0 / lines[1].frequency;
  EXPECT_NEAR(std::min(first, second), 72.0, 0.5);
  EXPECT_NEAR(std::max(first, second), 90.0, 0.5);
}

TEST(LineTest, RefusesTooLittle) {
  EXPECT_THROW(line_test(std::vector<double>(15, 1.0), 1.0), std::invalid_argument);
  EXPECT_THROW(line_test(std::vector<double>(64, 1.0), 1.0, {2.5, 1}), std::invalid_argument);
}

// The significance is a probability: 1 % of noise frequencies have a significance below 1 %. 100 records of 512 samples
// have about 5e4 / 5 independent values of F, so one standard deviation of the share is 0.1 %.
TEST(LongLineTest, FindsLinesInNoiseAsOftenAsItSays) {
  double below = 0.0;
  double all = 0.0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const LineTest test = line_test(white_noise(512, 1.0, seed), 1.0);
    for (std::size_t i = 50; i + 50 < test.significance.size(); ++i) {
      all += 1.0;
      below += test.significance[i] < 0.01 ? 1.0 : 0.0;
    }
  }
  EXPECT_NEAR(below / all, 0.01, 0.003);
}

}  // namespace
}  // namespace gem
