// Exceedance by hand, and peaks of cycles.
#include "gem/analysis/extremes/exceedance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

TEST(Exceedance, ByHand) {
  const ExceedanceCurve curve = exceedance(std::vector<double>{3.0, 1.0, 2.0, 2.0});
  EXPECT_EQ(curve.level, (std::vector<double>{1.0, 2.0, 2.0, 3.0}));
  EXPECT_EQ(curve.probability, (std::vector<double>{0.75, 0.25, 0.25, 0.0}));
  EXPECT_NEAR(exceedance(std::vector<double>(100, 1.0)).band, 0.1358, 1e-4);
  EXPECT_TRUE(exceedance({}).level.empty());
}

// 300 samples of 200 uniform values: the 95 % band contains the whole curve in at least 95 % of them; one standard
// deviation is 1.3 %.
TEST(Exceedance, ItsBandHoldsTheTrueCurve) {
  int held = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    std::vector<double> values(200);
    RandomSequence random = test_random(seed);
    for (double& value : values) value = random.uniform();
    const ExceedanceCurve curve = exceedance(values);
    double worst = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      // The curve jumps at its level, so both sides of the step count.
      const double truth = 1.0 - curve.level[i];
      worst = std::max({worst, std::abs(curve.probability[i] - truth), std::abs(curve.probability[i] + 0.005 - truth)});
    }
    held += worst <= curve.band ? 1 : 0;
  }
  EXPECT_GE(held, 274);
}

TEST(CyclePeaks, OnePerCycleHoweverItWiggles) {
  const std::vector<double> signal = sum_of(sine(1050, 100.0, 2.0, 1.0), sine(1050, 7.0, 0.1, 0.0));
  const std::vector<double> peaks = cycle_peaks(signal);
  ASSERT_EQ(peaks.size(), 9u);
  for (const double peak : peaks) EXPECT_NEAR(peak, 2.05, 0.06);
  EXPECT_TRUE(cycle_peaks({}).empty());
}

}  // namespace
}  // namespace gem
