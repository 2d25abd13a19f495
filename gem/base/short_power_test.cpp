// The power of inner loops: its error, and the same bits on packs.
#include "gem/base/short_power.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gem {
namespace {

TEST(ShortPower, IsTheLibrarysToItsBound) {
  for (double x = 1e-30; x < 1e8; x *= 1.37)
    for (const double p : {0.1, 0.35, 0.5, 0.75, 1.0, 1.5}) {
      const double exact = std::pow(x, p);
      EXPECT_NEAR(strict::short_power(x, p) / exact, 1.0, 2e-9 * (1.0 + p)) << x << " to the power " << p;
    }
}

TEST(ShortPower, APackHasTheBitsOfItsNumbers) {
  for (double x = 1e-30; x < 1e8; x *= 3.1) {
    const DoublePack base = {x, 1.1 * x, 7.0 * x, 0.3 * x}, p = {0.35, 0.4, 0.5, 0.75};
    const DoublePack all = strict::short_power(base, p);
    for (int lane = 0; lane < double_lanes; ++lane)
      EXPECT_EQ(all[lane], strict::short_power(double{base[lane]}, double{p[lane]})) << x << " lane " << lane;
  }
}

}  // namespace
}  // namespace gem
