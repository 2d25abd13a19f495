// The limit on the position repair of a body in one time step.
#include "gem/engine/step/body_repair.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gem {
namespace {

double farthest(const BodyRepair& repair, double radius) {
  return length(repair.shift) + radius * std::abs(repair.turn);
}

TEST(BodyRepair, AppliesWhatIsWithinReachToTheBit) {
  const BodyRepair done = within_reach({{3e-3, -4e-3}, 1e-3}, 5.0, 0.01 + 1e-12);
  EXPECT_EQ(done.shift.x, 3e-3);
  EXPECT_EQ(done.shift.y, -4e-3);
  EXPECT_EQ(done.turn, 1e-3);
}

TEST(BodyRepair, NoPointGoesFartherThanTheReach) {
  const BodyRepair asked{{0.12, -0.05}, -0.04};
  const BodyRepair done = within_reach(asked, 2.0, 0.025);
  EXPECT_NEAR(farthest(done, 2.0), 0.025, 1e-15);
  EXPECT_NEAR(done.shift.x / done.shift.y, asked.shift.x / asked.shift.y, 1e-14) << "the direction stays";
  EXPECT_NEAR(done.turn / done.shift.x, asked.turn / asked.shift.x, 1e-14) << "turn and shift are cut alike";
}

TEST(BodyRepair, KeepsNaN) {
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(within_reach({{no_number, 0.0}, 0.0}, 1.0, 0.01).shift.x));
  EXPECT_TRUE(std::isnan(within_reach({{0.0, 0.0}, no_number}, 1.0, 0.01).turn));
}

}  // namespace
}  // namespace gem
