// Intervals of spectral densities on noise whose spectrum is known: they cover, frequency by frequency.
#include "gem/analysis/spectra/spectrum_interval.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

/// Share of the frequencies that are independent of zero frequency whose interval holds the level of white noise.
double share_covered(const SpectrumInterval& interval, double level) {
  double covered = 0.0;
  double all = 0.0;
  const std::size_t count = interval.spectrum.density.size();
  for (std::size_t i = count / 16; i < count - count / 16; ++i) {
    all += 1.0;
    covered += interval.low[i] <= level && level <= interval.high[i] ? 1.0 : 0.0;
  }
  return covered / all;
}

TEST(SpectrumInterval, HoldsItsOwnEstimate) {
  const std::vector<double> noise = white_noise(512, 1.0, 2);
  for (const SpectrumInterval& interval : {multitaper_interval(noise, 0.5), welch_interval(noise, 0.5, 32.0)}) {
    for (std::size_t i = 1; i < interval.spectrum.density.size(); ++i) {
      EXPECT_LT(interval.low[i], interval.spectrum.density[i]);
      EXPECT_GT(interval.high[i], interval.spectrum.density[i]);
    }
  }
}

// 512 samples in segments of 64: 15 of them, so 30 / (1 + 28/15/36) degrees of freedom.
TEST(SpectrumInterval, WelchCountsItsSegments) {
  const SpectrumInterval interval = welch_interval(white_noise(512, 1.0, 2), 0.5, 32.0);
  EXPECT_EQ(interval.spectrum.segments, 15u);
  EXPECT_NEAR(interval.degrees, 28.52, 0.01);
}

TEST(SpectrumInterval, OfNothingIsNothing) {
  const SpectrumInterval interval = multitaper_interval(std::vector<double>(64, 3.0), 1.0);
  EXPECT_EQ(interval.spectrum.density[9], 0.0);
  EXPECT_EQ(interval.high[9], 0.0);
  EXPECT_THROW(multitaper_interval(std::vector<double>(64, 3.0), 1.0, {2.5, 1}), std::invalid_argument);
}

// Over 20 records of 2048 samples there are some 8000 independent frequencies (multitaper, 5 per bandwidth) and 600
// (Welch): a share of 95 % scatters by 0.3 and 0.9 %. The jackknife of four tapers takes the logarithm of a chi-squared
// value as Student's t, which is known to a percent or two.
TEST(LongSpectrumInterval, CoversTheLevelOfWhiteNoise) {
  double tapered = 0.0;
  double segmented = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const std::vector<double> noise = white_noise(2048, 1.0, seed);
    tapered += share_covered(multitaper_interval(noise, 1.0), 2.0) / 20.0;
    segmented += share_covered(welch_interval(noise, 1.0, 64.0), 2.0) / 20.0;
  }
  EXPECT_NEAR(tapered, 0.95, 0.03);
  EXPECT_NEAR(segmented, 0.95, 0.03);
}

}  // namespace
}  // namespace gem
