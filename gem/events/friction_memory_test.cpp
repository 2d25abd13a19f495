// Friction of a hit that takes two time steps.
#include "gem/events/friction_memory.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gem {
namespace {

/// A hit may reverse the slip of this point: k_nt / k_tt = 0.8.
constexpr ContactCompliance leaning{1.0, 1.0, 0.8};
constexpr double fast = 1e3;  // a closing speed that sets no limit [m/s]

void expect_none(SpareFriction spare) {
  EXPECT_EQ(spare.left, 0.0);
  EXPECT_EQ(spare.right, 0.0);
}

TEST(FrictionMemory, ASteadyOrFallingLoadLeavesNothing) {
  EXPECT_EQ(rise_of_load(5.0, 5.0), 0.0);
  EXPECT_EQ(rise_of_load(5.0, 3.0), 0.0);
  expect_none(spare_friction(0.3, {5.0, 0.4}, 0.0, leaning, fast));
}

TEST(FrictionMemory, AFreshLoadLeavesWhatItDidNotUse) {
  const SpareFriction spare = spare_friction(0.5, {10.0, 2.0}, rise_of_load(0.0, 10.0), leaning, fast);
  EXPECT_DOUBLE_EQ(spare.left, 3.0);
  EXPECT_DOUBLE_EQ(spare.right, 7.0);
}

TEST(FrictionMemory, OnlyTheRiseCounts) {
  const SpareFriction spare = spare_friction(0.5, {10.0, 2.0}, rise_of_load(6.0, 10.0), leaning, fast);
  EXPECT_DOUBLE_EQ(spare.left, 0.4 * 3.0);
  EXPECT_DOUBLE_EQ(spare.right, 0.4 * 7.0);
}

TEST(FrictionMemory, ASlippingPointHasNoneAlongItsFriction) {
  EXPECT_EQ(spare_friction(0.5, {10.0, 5.0}, 10.0, leaning, fast).left, 0.0);
  EXPECT_EQ(spare_friction(0.5, {10.0, -5.0}, 10.0, leaning, fast).right, 0.0);
  // a point that has just used spare friction of its own carries more than mu P_n
  EXPECT_EQ(spare_friction(0.5, {10.0, 9.0}, 4.0, leaning, fast).left, 0.0);
  EXPECT_EQ(spare_friction(0.5, {10.0, 9.0}, 4.0, leaning, fast).right, 4.0);
}

TEST(FrictionMemory, TheRestOfTheHitLimitsIt) {
  expect_none(spare_friction(0.5, {10.0, 2.0}, 10.0, leaning, 0.0));
  expect_none(spare_friction(0.5, {10.0, 2.0}, 10.0, {1.0, 1.0, -0.5}, fast));  // no slip can reverse
  // sticking takes 0.036 / 0.36 N s for the closing speed, and 0.8 of it in friction
  const SpareFriction spare = spare_friction(0.5, {10.0, 2.0}, 10.0, leaning, 0.036);
  EXPECT_DOUBLE_EQ(spare.left, 0.03);
  EXPECT_DOUBLE_EQ(spare.right, 0.03);
}

TEST(FrictionMemory, BeyondCountsFromTheWiderBound) {
  EXPECT_DOUBLE_EQ(beyond_friction(0.5, {10.0, 7.5}, {2.0, 0.0}), 0.5);
  EXPECT_DOUBLE_EQ(beyond_friction(0.5, {10.0, -7.5}, {2.0, 0.0}), 2.5);
  EXPECT_EQ(beyond_friction(0.5, {10.0, -4.0}, {}), 0.0);
}

TEST(FrictionMemory, AHitKeepsItsDirection) {
  EXPECT_GT(slip_of_hit(-0.2, {10.0, -1.0}, 10.0), 0.0);  // friction was against a slip along t
  EXPECT_EQ(slip_of_hit(-0.2, {10.0, -1.0}, 4.0), -0.2);  // most of the load is old
  EXPECT_EQ(slip_of_hit(-0.2, {0.0, 0.0}, 0.0), -0.2);    // no load
  EXPECT_EQ(slip_of_hit(-0.2, {10.0, 0.0}, 10.0), -0.2);  // no friction yet
}

/// Impulse of the one-step law with spare friction.
ContactImpulse part(const ContactCompliance& k, double u_n, double u_t, double target, double mu, SpareFriction spare) {
  const ContactImpulse stick = impact_one_step(k, u_n, u_t, target, 1e3);
  const auto slip = [&](double direction, double beyond) {
    const double normal = (target - u_n - direction * beyond * k.nt) / (k.nn + direction * mu * k.nt);
    return ContactImpulse{normal, direction * (mu * normal + beyond)};
  };
  if (stick.tangential > mu * stick.normal + spare.left) return slip(1.0, spare.left);
  if (stick.tangential < -(mu * stick.normal + spare.right)) return slip(-1.0, spare.right);
  return stick;
}

TEST(FrictionMemory, TwoPartsOfAHitAreOneHit) {
  const double u_n = -1.0;
  int reversed = 0;
  for (const double nt : {-0.8, -0.3, 0.0, 0.5, 0.7})
    for (const double mu : {0.1, 0.3, 0.6})
      for (const double slip : {-0.8, -0.29, 0.05, 0.31})
        for (const double gap : {0.01, 0.5, 0.99}) {  // speed that the first part leaves [m/s]
          const ContactCompliance k{1.1, 0.9, nt};
          const ContactImpulse whole = impact_one_step(k, u_n, slip, 0.0, mu);
          const ContactImpulse one = part(k, u_n, slip, -gap, mu, {});
          const double u_t = slip + k.nt * one.normal + k.tt * one.tangential;
          const SpareFriction spare = spare_friction(mu, one, rise_of_load(0.0, one.normal), k, gap);
          const ContactImpulse two = part(k, -gap, u_t, 0.0, mu, spare);
          EXPECT_GE(two.normal, 0.0);
          EXPECT_NEAR(one.normal + two.normal, whole.normal, 1e-14) << nt << ' ' << mu << ' ' << slip << ' ' << gap;
          EXPECT_NEAR(one.tangential + two.tangential, whole.tangential, 1e-14)
              << nt << ' ' << mu << ' ' << slip << ' ' << gap;
          if (std::fabs(two.tangential) > 1.01 * mu * two.normal) ++reversed;
        }
  EXPECT_GT(reversed, 5) << "no hit used spare friction";
}

}  // namespace
}  // namespace gem
