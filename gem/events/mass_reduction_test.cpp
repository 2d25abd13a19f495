// Mass reduction factor and effective mass: a table of worked cases, and compliance against its definition.
#include "gem/events/mass_reduction.h"

#include <gtest/gtest.h>

#include "gem/base/random.h"

namespace gem {
namespace {

TEST(MassReduction, WorkedTable) {
  // the mean floe as a square, 0.5 m thick, against a platform of 1e8 kg hit centrally at 0.25 m/s
  const double area = 62.82, mass = 900.0 * 0.5 * area, r2 = area / 6.0;
  const CollisionMass floe{1.0 / mass, 1.0 / (mass * r2)}, platform{1e-8, 1e-11};
  const double factor[] = {1.0, 1.09551, 1.38204, 1.85960};
  const double effective[] = {28261.0, 25797.7, 20450.3, 15199.4};
  const double impulse[] = {7065.25, 6449.43, 5112.58, 3799.84};
  const Vec2 normal{1.0, 0.0};
  for (int eta = 0; eta < 4; ++eta) {
    const Vec2 arm{3.0, -static_cast<double>(eta)};
    EXPECT_DOUBLE_EQ(cross(arm, normal), eta);
    EXPECT_NEAR(mass_reduction_factor(normal, arm, r2) / factor[eta], 1.0, 5e-6);
    const double m_e = 1.0 / contact_compliance(platform, {-50.0, 0.0}, floe, arm, normal).nn;
    EXPECT_NEAR(m_e / effective[eta], 1.0, 5e-6);
    EXPECT_NEAR(m_e * 0.25 / impulse[eta], 1.0, 5e-6);
    EXPECT_NEAR(1.0 / inverse_effective_mass(floe, arm, normal), mass / mass_reduction_factor(normal, arm, r2), 1e-9);
  }
}

TEST(MassReduction, ComplianceIsTheResponseToAUnitImpulse) {
  RandomSequence random(Random(11, 0));
  for (int i = 0; i < 1000; ++i) {
    const CollisionMass a{random.uniform(), random.uniform()}, b{random.uniform(), random.uniform()};
    const Vec2 arm_a{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0)};
    const Vec2 arm_b{random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0)};
    const Rotation q = strict::rotation_of_turns(random.uniform());
    const Vec2 normal{q.cosine, q.sine}, tangent = turned_left(normal);
    auto response = [&](Vec2 impulse) {
      return (a.inverse_mass + b.inverse_mass) * impulse + cross(b.inverse_inertia * cross(arm_b, impulse), arm_b) +
             cross(a.inverse_inertia * cross(arm_a, impulse), arm_a);
    };
    const ContactCompliance k = contact_compliance(a, arm_a, b, arm_b, normal);
    EXPECT_NEAR(k.nn, dot(response(normal), normal), 1e-12);
    EXPECT_NEAR(k.tt, dot(response(tangent), tangent), 1e-12);
    EXPECT_NEAR(k.nt, dot(response(tangent), normal), 1e-12);
    EXPECT_NEAR(k.nt, dot(response(normal), tangent), 1e-12);
    EXPECT_GE(k.nn * k.tt - k.nt * k.nt, 0.0);
  }
}

}  // namespace
}  // namespace gem
