// Impact: worked cases, the transition from stick to slip, and the contact laws on random impacts.
#include "gem/events/impact.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/base/random.h"

namespace gem {
namespace {

struct Velocity {
  double normal = 0.0;
  double tangential = 0.0;
};

Velocity after(const ContactCompliance& k, Velocity u, ContactImpulse p) {
  return {u.normal + k.nn * p.normal + k.nt * p.tangential, u.tangential + k.nt * p.normal + k.tt * p.tangential};
}

/// Compliance of a 10 m square of 45 t, turned by 30 degrees, on a fixed wall below its lowest corner.
ContactCompliance square_on_wall() {
  const CollisionMass square{1.0 / 45000.0, 1.0 / 750000.0};
  return contact_compliance({}, {}, square, {-1.83012701892219, -6.83012701892219}, {0.0, 1.0});
}

ContactCompliance random_compliance(RandomSequence& random, double reach) {
  const CollisionMass a{random.uniform() < 0.3 ? 0.0 : random.uniform(),
                        random.uniform() < 0.3 ? 0.0 : random.uniform()};
  const CollisionMass b{0.01 + random.uniform(), random.uniform()};
  const Vec2 arm_a{random.uniform(-reach, reach), random.uniform(-reach, reach)};
  const Vec2 arm_b{random.uniform(-reach, reach), random.uniform(-reach, reach)};
  const Rotation q = strict::rotation_of_turns(random.uniform());
  return contact_compliance(a, arm_a, b, arm_b, {q.cosine, q.sine});
}

TEST(Impact, FrictionlessTakesTheClosingVelocity) {
  const ContactCompliance k = square_on_wall();
  const double j = impact_frictionless(k.nn, -0.5, 0.0);
  EXPECT_NEAR(j, 18734.982439, 1e-5);
  EXPECT_NEAR(impulse_work(j, -0.5, 0.0), -4683.74560974, 1e-7);
  EXPECT_EQ(impact_frictionless(k.nn, 0.1, 0.0), 0.0);
  EXPECT_EQ(impact_frictionless(k.nn, 0.1, 0.1), 0.0);
  EXPECT_NEAR(impact_frictionless(k.nn, 0.1, 0.2) * k.nn, 0.1, 1e-15);
}

TEST(Impact, StickAndSlipOfAWorkedCase) {
  const ContactCompliance k = square_on_wall();
  // the tangent is the normal turned left: -x
  const Velocity u{-0.5, 0.4};
  const ContactImpulse slip = impact_one_step(k, u.normal, u.tangential, 0.0, 0.1);
  EXPECT_NEAR(slip.normal, 19982.9142651, 1e-6);
  EXPECT_NEAR(slip.tangential, -1998.29142651, 1e-7);
  EXPECT_NEAR(after(k, u, slip).tangential, 0.564346676072, 1e-12);
  const ContactImpulse stick = impact_one_step(k, u.normal, u.tangential, 0.0, 0.6);
  EXPECT_NEAR(stick.normal, 24744.5893444, 1e-6);
  EXPECT_NEAR(stick.tangential, -9623.07852446, 1e-6);
  EXPECT_NEAR(after(k, u, stick).tangential, 0.0, 1e-14);
}

TEST(Impact, BorderOfStickAndSlip) {
  const ContactCompliance k = square_on_wall();
  constexpr double threshold = 0.38889627104;
  const Velocity u{-0.5, 0.4};
  const ContactImpulse below = impact_one_step(k, u.normal, u.tangential, 0.0, threshold - 1e-6);
  const ContactImpulse above = impact_one_step(k, u.normal, u.tangential, 0.0, threshold + 1e-6);
  EXPECT_GT(after(k, u, below).tangential, 1e-9);
  EXPECT_NEAR(after(k, u, above).tangential, 0.0, 1e-14);
  // continuous across the border: both impulses within the change of mu
  EXPECT_NEAR(below.normal / above.normal, 1.0, 1e-5);
  EXPECT_NEAR(below.tangential / above.tangential, 1.0, 1e-5);
}

TEST(Impact, FixedDirectionMayPushPastZero) {
  // no coupling: slip 0.1 against friction that could remove 1.0
  const ContactCompliance k{1.0, 1.0, 0.0};
  const ContactImpulse fixed = impact_fixed_direction(k, -1.0, 0.1, 0.0, 1.0);
  EXPECT_DOUBLE_EQ(fixed.normal, 1.0);
  EXPECT_DOUBLE_EQ(fixed.tangential, -1.0);
  EXPECT_DOUBLE_EQ(after(k, {-1.0, 0.1}, fixed).tangential, -0.9);
  EXPECT_DOUBLE_EQ(impact_one_step(k, -1.0, 0.1, 0.0, 1.0).tangential, -0.1);
  // without tangential motion there is no direction to oppose
  EXPECT_EQ(impact_fixed_direction(k, -1.0, 0.0, 0.0, 1.0).tangential, 0.0);
}

TEST(Impact, NothingForPartingBodies) {
  const ContactCompliance k{1.0, 1.0, 0.3};
  for (const double u_n : {0.0, 0.2}) {
    EXPECT_EQ(impact_one_step(k, u_n, 1.0, 0.0, 0.5).normal, 0.0);
    EXPECT_EQ(impact_one_step(k, u_n, 1.0, 0.0, 0.5).tangential, 0.0);
    EXPECT_EQ(impact_fixed_direction(k, u_n, 1.0, 0.0, 0.5).normal, 0.0);
    EXPECT_EQ(impact_fixed_direction(k, u_n, 1.0, 0.0, 0.5).tangential, 0.0);
  }
}

TEST(Impact, RandomOneStepObeysCoulombAndLosesEnergy) {
  RandomSequence random(Random(21, 0));
  int sticks = 0, slips = 0, jams = 0;
  for (int i = 0; i < 100000; ++i) {
    const ContactCompliance k = random_compliance(random, 3.0);
    const Velocity u{-random.uniform(), random.uniform(-2.0, 2.0)};
    const double mu = random.uniform(0.0, 1.5);
    const ContactImpulse p = impact_one_step(k, u.normal, u.tangential, 0.0, mu);
    const Velocity v = after(k, u, p);
    const double scale = 1.0 + k.nn * p.normal + std::fabs(k.nt * p.tangential);
    ASSERT_GE(p.normal, 0.0) << i;
    ASSERT_NEAR(v.normal, 0.0, 1e-12 * scale) << i;
    const double work =
        impulse_work(p.normal, u.normal, v.normal) + impulse_work(p.tangential, u.tangential, v.tangential);
    ASSERT_LE(work, 1e-12 * p.normal * scale) << i;
    if (k.nn - mu * std::fabs(k.nt) <= 0.0) ++jams;
    ASSERT_LE(std::fabs(p.tangential), mu * p.normal * (1.0 + 1e-12)) << i;
    if (std::fabs(p.tangential) < mu * p.normal * (1.0 - 1e-9)) {
      ++sticks;
      ASSERT_NEAR(v.tangential, 0.0, 1e-12 * (scale + k.tt * std::fabs(p.tangential))) << i;
    } else {
      ++slips;
      ASSERT_LE(p.tangential * v.tangential, 1e-12 * p.normal * scale) << i;
    }
  }
  EXPECT_GT(sticks, 5000);
  EXPECT_GT(slips, 5000);
  EXPECT_GT(jams, 5000);  // the law also holds for impacts where slip in one direction has no solution
}

TEST(Impact, RandomFixedDirectionObeysItsLaw) {
  RandomSequence random(Random(22, 0));
  int sliding = 0;
  for (int i = 0; i < 100000; ++i) {
    const ContactCompliance k = random_compliance(random, 3.0);
    const Velocity u{-random.uniform(), random.uniform(-2.0, 2.0)};
    const double mu = random.uniform(0.0, 0.5), target = random.uniform() < 0.5 ? 0.0 : 0.3 * random.uniform();
    const ContactImpulse p = impact_fixed_direction(k, u.normal, u.tangential, target, mu);
    const Velocity v = after(k, u, p);
    ASSERT_GE(p.normal, 0.0) << i;
    ASSERT_NEAR(v.normal, target, 1e-12 * (1.0 + k.nn * p.normal)) << i;
    ASSERT_LE(std::fabs(p.tangential), mu * p.normal * (1.0 + 1e-12)) << i;
    ASSERT_LE(p.tangential * u.tangential, 0.0) << i;
    if (p.tangential != 0.0) ++sliding;
  }
  EXPECT_GT(sliding, 50000);
}

TEST(Impact, JammedCornerSticksOrLosesItsFriction) {
  // k_nn - mu k_nt < 0: friction in this direction would dig the corner in, so that slip has no solution
  const ContactCompliance k{1.0, 1.5, 1.2};
  const double mu = 1.0;
  RandomSequence random(Random(23, 0));
  int stuck = 0, unrubbed = 0;
  for (int i = 0; i < 10000; ++i) {
    const Velocity u{-random.uniform(), random.uniform(0.0, 1.0)};
    const ContactImpulse p = impact_one_step(k, u.normal, u.tangential, 0.0, mu);
    const Velocity v = after(k, u, p);
    ASSERT_GE(p.normal, 0.0);
    ASSERT_NEAR(v.normal, 0.0, 1e-11);
    ASSERT_LE(std::fabs(p.tangential), mu * p.normal * (1.0 + 1e-12));
    if (std::fabs(v.tangential) < 1e-11) ++stuck;
    const ContactImpulse fixed = impact_fixed_direction(k, u.normal, u.tangential, 0.0, mu);
    ASSERT_DOUBLE_EQ(fixed.normal, -u.normal);
    if (fixed.tangential == 0.0) ++unrubbed;
  }
  EXPECT_GT(stuck, 9000);
  EXPECT_EQ(unrubbed, 10000);
}

}  // namespace
}  // namespace gem
