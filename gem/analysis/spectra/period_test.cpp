// Periods by crossings and by maxima of signals whose periods are known.
#include "gem/analysis/spectra/period.h"

#include <gtest/gtest.h>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

TEST(CrossingPeriod, OfALineInNoise) {
  // Noise of deviation 0.02 on a slope of 2 pi / 90 per sample shifts a crossing by 0.29 samples, so no crossing is
  // counted twice.
  const auto estimate = crossing_period(sum_of(sine(7200, 90.0), white_noise(7200, 0.02, 3)), 1.0);
  ASSERT_TRUE(estimate.has_value());
  EXPECT_LE(estimate->low, 90.0);
  EXPECT_GE(estimate->high, 90.0);
  EXPECT_LT(estimate->high - estimate->low, 0.2);
}

TEST(MaximaPeriod, CountsWigglesApartFromCrossings) {
  const std::vector<double> signal = sum_of(sine(8000, 100.0), sine(8000, 10.0, 0.5, 0.3));
  const auto wiggles = maxima_period(signal, 1.0);
  const auto crossings = crossing_period(sum_of(sine(8000, 100.0), sine(8000, 10.0, 0.05, 0.3)), 1.0);
  ASSERT_TRUE(wiggles && crossings);
  EXPECT_NEAR(wiggles->period, 10.0, 0.1);
  EXPECT_NEAR(crossings->period, 100.0, 0.1);
}

TEST(MaximaPeriod, CountsAFlatTopOnce) {
  std::vector<double> signal;
  for (int i = 0; i < 30; ++i) signal.insert(signal.end(), {0.0, 1.0, 1.0, 1.0, 0.0, 0.0, 2.0, 1.0});
  const auto maxima = maxima_period(signal, 1.0);
  ASSERT_TRUE(maxima.has_value());
  EXPECT_NEAR(maxima->period, 4.0, 0.1);
}

TEST(CrossingPeriod, IsEmptyWithFewCycles) {
  EXPECT_FALSE(crossing_period(sine(1000, 90.0), 1.0).has_value());
  EXPECT_FALSE(maxima_period(std::vector<double>(1000, 1.0), 1.0).has_value());
  EXPECT_FALSE(crossing_period({}, 1.0).has_value());
}

// 2 h of an oscillator of 90 s with 0.5 % damping. 200 intervals of 95 %: one standard deviation is 1.5 %. Both methods
// measure the natural period. The start from rest costs at most a few percent of coverage.
TEST(LongPeriods, CoverThePeriodOfADrivenOscillator) {
  int by_crossings = 0;
  int by_spectrum = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const std::vector<double> x = driven_oscillator(7200, 90.0, 0.005, seed);
    const auto crossings = crossing_period(x, 1.0);
    const auto spectral = spectral_period(eigenspectra(x, 1.0));
    ASSERT_TRUE(crossings && spectral);
    by_crossings += crossings->low <= 90.0 && 90.0 <= crossings->high ? 1 : 0;
    by_spectrum += spectral->low <= 90.0 && 90.0 <= spectral->high ? 1 : 0;
  }
  EXPECT_GE(by_crossings, 176);
  EXPECT_GE(by_spectrum, 176);
}

}  // namespace
}  // namespace gem
