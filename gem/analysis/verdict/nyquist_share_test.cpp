// The Nyquist share of forces for which it is known.
#include "gem/analysis/verdict/nyquist_share.h"

#include <gtest/gtest.h>

#include <numbers>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

NyquistShare share_of(const std::vector<double>& force) {
  NyquistShare share;
  for (const double value : force) share.add({1e3 + value, 0.0});
  return share;
}

TEST(NyquistShare, OfASineIsTheSquaredSineOfHalfItsPhaseStep) {
  for (const int steps : {4, 10, 100}) {
    const double half = std::sin(std::numbers::pi / steps);
    // one difference is missing: up to twice its mean square of all steps
    EXPECT_NEAR(share_of(sine(1000U * steps, steps)).value(), half * half, 2e-3 / steps * half * half) << steps;
  }
}

TEST(NyquistShare, OfNoiseIsHalfOfWhatTwoStepsDoNotShare) {
  // N = (1 - correlation of neighbours) / 2, here with a standard deviation of at most 1 / (2 sqrt 40000) = 0.0025
  EXPECT_NEAR(share_of(white_noise(40000, 1.0, 1)).value(), 0.5, 0.01);
  EXPECT_NEAR(share_of(red_noise(40000, 0.8, 2)).value(), 0.1, 0.01);
  EXPECT_NEAR(share_of(red_noise(40000, -0.8, 3)).value(), 0.9, 0.01);
}

TEST(NyquistShare, OfAForceThatIsOnAndOffIsOne) {
  NyquistShare share;
  for (int i = 0; i < 10000; ++i) share.add({i % 2 == 0 ? 3e5 : 0.0, i % 2 == 0 ? -1e5 : 0.0});
  EXPECT_NEAR(share.value(), 1.0, 1.01e-4);  // 9999 differences for 10000 steps
  EXPECT_EQ(share.loaded(), 5000);
}

TEST(NyquistShare, OfSingleHitsIsAHalf) {
  NyquistShare share;
  for (int i = 0; i < 100000; ++i) share.add({i % 1000 == 500 ? 1e5 : 0.0, 0.0});
  EXPECT_NEAR(share.value(), 0.5, 6e-4);  // 1/2 over 1 - p with a hit in p = 1/1000 of the steps
  EXPECT_EQ(share.loaded(), 100);
}

TEST(NyquistShare, OfAForceThatNeverChangesIsUnknown) {
  NyquistShare share;
  for (int i = 0; i < 100; ++i) share.add({1e5, 0.0});
  EXPECT_TRUE(std::isnan(share.value()));
  EXPECT_EQ(share.loaded(), 100);
}

}  // namespace
}  // namespace gem
