// Allocation, filter and integral of dynamic positioning.
#include "gem/events/platform/dp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/events/platform/dp_design.h"

namespace gem {
namespace {

DpDef ship_def() {
  DpDef def;
  def.integral_time_s = 200.0;
  def.thruster = {{.kind = ThrusterKind::fixed, .position_m = {80.0, 8.0}, .maximum_N = 2e6, .reverse_share = 0.5},
                  {.kind = ThrusterKind::fixed, .position_m = {80.0, -8.0}, .maximum_N = 2e6, .reverse_share = 0.5},
                  {.kind = ThrusterKind::tunnel, .position_m = {-70.0, 0.0}, .maximum_N = 4e5},
                  {.kind = ThrusterKind::azimuth, .position_m = {-60.0, 0.0}, .maximum_N = 8e5},
                  {.kind = ThrusterKind::tunnel, .position_m = {60.0, 0.0}, .maximum_N = 4e5}};
  return def;
}

DpLaw ship_law(const DpDef& def = ship_def()) { return dp_law(def, {5e7, 5e7, 1e11}, 0.5); }

ShipForce sum_of(const DpLaw& law, const Vec2* thrust) {
  ShipForce sum;
  for (std::int32_t i = 0; i < law.thrusters; ++i) {
    const ShipForce one = dp_force_of(law.thruster[i], thrust[i]);
    sum = {sum.surge + one.surge, sum.sway + one.sway, sum.yaw + one.yaw};
  }
  return sum;
}

void expect_sum(const ShipForce& sum, const ShipForce& demand) {
  constexpr double tolerance = 1e-6;  // [N], a few hundred roundings of 1e6 N
  EXPECT_NEAR(sum.surge, demand.surge, tolerance);
  EXPECT_NEAR(sum.sway, demand.sway, tolerance);
  EXPECT_NEAR(sum.yaw, demand.yaw, 100.0 * tolerance);
}

TEST(DpAllocation, GivesTheDemandWithinTheLimits) {
  const DpLaw law = ship_law();
  Vec2 thrust[thrusters_maximum];
  for (const ShipForce demand : {ShipForce{1e6, 0.0, 0.0}, {-5e5, 2e5, 1e7}, {0.0, -3e5, 2e7}, {1e5, 1e5, -3e7}}) {
    EXPECT_EQ(dp_allocate(law, demand, thrust), 0U);
    expect_sum(sum_of(law, thrust), demand);
    EXPECT_EQ(thrust[2].x, 0.0) << "a tunnel pushes athwart";
    EXPECT_EQ(thrust[0].y, 0.0) << "a fixed one along its direction";
  }
}

TEST(DpAllocation, OthersTakeWhatACutThrusterLeaves) {
  const DpLaw law = ship_law();
  Vec2 thrust[thrusters_maximum];
  // the main propellers give half of their thrust backwards, the azimuth thruster takes the rest
  const ShipForce demand{-2.6e6, 0.0, 0.0};
  EXPECT_EQ(dp_allocate(law, demand, thrust), 3U);
  EXPECT_EQ(thrust[0].x, -1e6);
  EXPECT_EQ(thrust[1].x, -1e6);
  expect_sum(sum_of(law, thrust), demand);
  EXPECT_EQ(dp_allocate(law, {-9e6, 0.0, 0.0}, thrust) & 11U, 11U);
  EXPECT_NEAR(sum_of(law, thrust).surge, -2.8e6, 1e-6) << "all that they have";
  for (std::int32_t i = 0; i < law.thrusters; ++i) EXPECT_LE(length(thrust[i]), law.thruster[i].maximum * (1 + 1e-15));
}

/// The least weighted sum of squares: no step within the null space makes it smaller.
TEST(DpAllocation, IsThePseudoInverse) {
  const DpLaw law = ship_law();
  Vec2 thrust[thrusters_maximum];
  dp_allocate(law, {2e5, 1e5, 5e6}, thrust);
  const auto weighted = [&law](const Vec2* a, const Vec2* b) {
    double sum = 0.0;
    for (std::int32_t i = 0; i < law.thrusters; ++i)
      sum += dot(a[i], b[i]) / (law.thruster[i].maximum * law.thruster[i].maximum);
    return sum;
  };
  // main propellers against each other, their moment taken by the tunnels: no force, no moment
  const Vec2 null[thrusters_maximum] = {{65.0, 0.0}, {-65.0, 0.0}, {0.0, -8.0}, {0.0, 0.0}, {0.0, 8.0}};
  EXPECT_NEAR(sum_of(law, null).yaw, 65.0 * -16.0 + 8.0 * 130.0, 1e-9);
  EXPECT_NEAR(sum_of(law, null).sway, 0.0, 1e-12);
  EXPECT_NEAR(weighted(thrust, null), 0.0, 1e-12 * std::sqrt(weighted(thrust, thrust) * weighted(null, null)));
}

TEST(DpAllocation, ADirectionThatNoThrusterPushesGetsNothing) {
  DpDef def;
  def.thruster = {{.kind = ThrusterKind::tunnel, .position_m = {50.0, 0.0}},
                  {.kind = ThrusterKind::tunnel, .position_m = {-50.0, 0.0}}};
  const DpLaw law = ship_law(def);
  Vec2 thrust[thrusters_maximum];
  dp_allocate(law, {1e5, 2e5, 1e6}, thrust);
  expect_sum(sum_of(law, thrust), {0.0, 2e5, 1e6});
}

TEST(DpFilter, FollowsAStepByItsTimeConstant) {
  DpDef def = ship_def();
  def.filter_time_s = 5.0;
  const DpLaw law = ship_law(def);
  DpState s;
  DpMeasured m{};
  dp_filter(law, m, s);
  s.steps = 1;
  m.position = {2.0, -1.0};
  m.spin = 0.01;
  for (int k = 0; k < 20; ++k) dp_filter(law, m, s);
  const double left = std::exp(-10.0 / 5.0);
  EXPECT_NEAR(s.offset.x, 2.0 * (1.0 - left), 1e-14);
  EXPECT_NEAR(s.offset.y, -(1.0 - left), 1e-14);
  EXPECT_NEAR(s.spin, 0.01 * (1.0 - left), 1e-15);
}

TEST(DpFilter, BeginsAtWhatItSeesAndTakesTheShortWayRound) {
  DpDef def = ship_def();
  def.filter_time_s = 5.0;
  const DpLaw law = ship_law(def);
  DpState s;
  DpMeasured m{};
  m.position = {3.0, 0.0};
  m.rotation = strict::rotation_of_angle(3.1);
  dp_filter(law, m, s);
  EXPECT_EQ(s.offset.x, 3.0);
  EXPECT_NEAR(s.yaw, 3.1, 1e-14);
  s.steps = 1;
  m.rotation = strict::rotation_of_angle(-3.1);
  dp_filter(law, m, s);
  EXPECT_GT(s.yaw, 3.1) << "on over half a turn";
}

TEST(DpHeading, FollowsTheWater) {
  DpDef def = ship_def();
  def.follows_drift = true;
  def.yaw_rad = 0.2;
  const DpLaw law = ship_law(def);
  const Rotation q = strict::rotation_of_angle(1.0);
  EXPECT_NEAR(dp_yaw_error(law, q, {0.3 * std::cos(0.7), 0.3 * std::sin(0.7)}), 0.1, 1e-14);
  EXPECT_NEAR(dp_yaw_error(law, q, {}), 0.8, 1e-14) << "still water has no direction";
}

TEST(DpIntegral, StopsWhereTheThrustersGiveLess) {
  const DpLaw law = ship_law();
  DpState s;
  DpMeasured m{};
  m.position = {1e4, 0.0};  // far beyond their reach
  dp_command(law, m, s);
  EXPECT_LT(s.demand.surge, 2.0 * s.given.surge) << "they give less than half";
  EXPECT_EQ(s.integral.x, 0.0);
  m.position = {0.5, 0.0};
  dp_command(law, m, s);
  EXPECT_NEAR(s.integral.x, 0.5 * law.dt, 1e-15) << "within it grows";
}

TEST(DpThruster, ChangesByItsRate) {
  DpDef def = ship_def();
  def.thruster[3].rate_N_per_s = 1e4;
  const DpLaw law = ship_law(def);
  const Vec2 reached = dp_reached(law.thruster[3], {3e4, 0.0}, {3e4, 4e5});
  EXPECT_EQ(reached.x, 3e4);
  EXPECT_NEAR(reached.y, 5e3, 1e-9);
  EXPECT_EQ(dp_reached(law.thruster[3], {3e4, 0.0}, {3e4, 4e3}).y, 4e3) << "less than the limit is reached";
}

}  // namespace
}  // namespace gem
