// Thinned records keep their extremes, and numbers are formatted well.
#include "gem/report/figures/series.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gem/report/display.h"

namespace gem {
namespace {

TEST(Envelope, KeepsEverySpikeInTimeOrder) {
  std::vector<double> signal(10007, 0.0);
  signal[3] = 5.0;
  signal[777] = -4.0;
  signal[10006] = 9.0;
  const std::vector<std::size_t> kept = envelope(signal, 100);
  ASSERT_LE(kept.size(), 200u);
  double high = 0.0;
  double low = 0.0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (i > 0) {
      EXPECT_LT(kept[i - 1], kept[i]);
    }
    high += std::max(signal[kept[i]], 0.0);
    low += std::min(signal[kept[i]], 0.0);
  }
  EXPECT_DOUBLE_EQ(high, 14.0);
  EXPECT_DOUBLE_EQ(low, -4.0);
}

TEST(Envelope, KeepsAShortRecordWhole) { EXPECT_EQ(envelope(std::vector<double>(7, 1.0), 4).size(), 7u); }

TEST(Every, KeepsTheFirstAndTheLastSample) {
  for (const std::size_t samples : {1u, 5u, 100u, 101u, 199u, 72001u}) {
    const std::vector<std::size_t> kept = every(samples, 100);
    EXPECT_LE(kept.size(), 100u);
    EXPECT_EQ(kept.front(), 0u);
    EXPECT_EQ(kept.back(), samples - 1);
  }
  EXPECT_TRUE(every(0, 10).empty());
}

TEST(SamplesWithin, IncludesBothEnds) {
  const std::vector<double> time = {0.0, 1.0, 2.0, 3.0, 4.0};
  const SampleRange range = samples_within(time, 1.0, 3.0);
  EXPECT_EQ(range.begin, 1u);
  EXPECT_EQ(range.end, 4u);
}

TEST(Display, RoundsToSignificantDigits) {
  EXPECT_EQ(rounded_text(88.8577), "88.9");
  EXPECT_EQ(rounded_text(1234.5), "1234");
  EXPECT_EQ(rounded_text(-0.012345), "-0.0123");
  EXPECT_EQ(rounded_text(99.97), "100");
  EXPECT_EQ(rounded_text(0.0), "0");
  EXPECT_EQ(rounded_text(std::nan("")), "-");
  EXPECT_EQ(exponent_text(3.14e-14), "3.1e-14");
}

TEST(Display, ChoosesAUnitThatFits) {
  EXPECT_EQ(with_unit(0.0374, length_unit(0.0374)), "37.4 mm");
  EXPECT_EQ(with_unit(1.5, length_unit(1.5)), "1.50 m");
  EXPECT_EQ(with_unit(153000.0, force_unit(153000.0)), "153 kN");
  EXPECT_EQ(with_unit(2.55e6, force_unit(2.55e6)), "2.55 MN");
  EXPECT_EQ(with_unit(7200.0, time_unit(7200.0)), "2.00 h");
}

}  // namespace
}  // namespace gem
