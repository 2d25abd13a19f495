// Wilson's interval against printed values and against its definition.
#include "gem/analysis/statistics/proportion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace gem {
namespace {

TEST(Proportion, HasTheEndsThatTheScoreTestJustRejects) {
  const double z = 1.959963984540054;
  for (const auto& [successes, trials] : {std::pair(3U, 10U), {29U, 30U}, {1U, 4U}}) {
    const IntervalEstimate share = wilson_share(successes, trials);
    for (const double end : {share.low, share.high})
      EXPECT_NEAR(std::abs(share.value - end) / std::sqrt(end * (1.0 - end) / trials), z, 1e-9);
  }
}

TEST(Proportion, AllOrNoneLeaveRoom) {
  const IntervalEstimate all = wilson_share(30, 30);
  EXPECT_EQ(all.value, 1.0);
  EXPECT_NEAR(all.low, 30.0 / (30.0 + 1.959963984540054 * 1.959963984540054), 1e-12);
  EXPECT_NEAR(all.high, 1.0, 1e-12);
  for (std::size_t n = 1; n < 100; ++n) {
    EXPECT_LE(wilson_share(n, n).high, 1.0);
    EXPECT_GE(wilson_share(0, n).low, 0.0);
  }
  EXPECT_NEAR(wilson_share(0, 30).high, 1.0 - all.low, 1e-12);
  EXPECT_LT(wilson_share(3, 3).low, 0.5) << "three of three may still be chance";
  EXPECT_GT(wilson_share(4, 4).low, 0.5);
}

TEST(Proportion, RefusesNonsense) {
  EXPECT_THROW(wilson_share(0, 0), std::invalid_argument);
  EXPECT_THROW(wilson_share(2, 1), std::invalid_argument);
  EXPECT_THROW(wilson_share(1, 2, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace gem
