// Contacts of a few bodies with impulses in closed form.
#include "gem/engine/reference/contact_problem.h"

#include <gtest/gtest.h>

namespace gem::reference {
namespace {

/// Discs of 2 kg that do not rotate by default.
ProblemBody disc(Vec2 velocity, double inverse_inertia = 0.0) { return {{0.5, inverse_inertia}, velocity, 0.0}; }
const ProblemBody wall{};

/// B is to the right of A and touches it half-way between the centres.
ProblemPoint right_of(std::int32_t a, std::int32_t b, double friction = 0.0) {
  ProblemPoint p;
  p.a = a;
  p.b = b;
  p.normal = {1.0, 0.0};
  p.arm_a = {1.0, 0.0};
  p.arm_b = {-1.0, 0.0};
  p.friction = friction;
  return p;
}

TEST(ContactProblem, TwoBodiesGoOnTogether) {
  const ContactSolution s =
      solve_contacts({right_of(0, 1)}, {disc({3.0, 0.0}), disc({1.0, 0.0})}, FrictionLaw::one_step);
  EXPECT_DOUBLE_EQ(s.impulse[0].normal, 2.0);  // 2 kg from 3 to 2 m/s
  EXPECT_EQ(s.impulse[0].tangential, 0.0);
}

TEST(ContactProblem, ARowAgainstAWallTransmitsEverything) {
  std::vector<ProblemPoint> points;
  std::vector<ProblemBody> bodies;
  constexpr int count = 20;
  for (int i = 0; i < count; ++i) {
    bodies.push_back(disc({1.0, 0.0}));
    points.push_back(right_of(i, i + 1));
  }
  bodies.push_back(wall);
  const ContactSolution s = solve_contacts(points, bodies, FrictionLaw::one_step);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(s.impulse[i].normal, 2.0 * (i + 1), 1e-11) << i;
}

TEST(ContactProblem, AGapMayCloseAndNoMore) {
  ProblemPoint p = right_of(0, 1);
  p.target = -0.5;
  const ContactSolution s = solve_contacts({p}, {disc({1.0, 0.0}), wall}, FrictionLaw::one_step);
  EXPECT_DOUBLE_EQ(s.impulse[0].normal, 1.0);
}

TEST(ContactProblem, BodiesThatNothingJoinsAreSolvedApart) {
  // the wall connects no bodies
  const ContactSolution s = solve_contacts({right_of(0, 2), right_of(1, 2)},
                                           {disc({1.0, 0.0}), disc({-1.0, 0.0}), wall}, FrictionLaw::one_step);
  EXPECT_DOUBLE_EQ(s.impulse[0].normal, 2.0);
  EXPECT_EQ(s.impulse[1].normal, 0.0);
}

TEST(ContactProblem, FrictionStopsASlipOrIsAllUsed) {
  const std::vector<ProblemBody> bodies{disc({1.0, 0.2}), wall};
  const ContactSolution stick = solve_contacts({right_of(0, 1, 0.5)}, bodies, FrictionLaw::one_step);
  EXPECT_NEAR(stick.impulse[0].normal, 2.0, 1e-13);
  EXPECT_NEAR(stick.impulse[0].tangential, 0.4, 1e-13);  // on B, which slips down relative to A
  const ContactSolution slip = solve_contacts({right_of(0, 1, 0.1)}, bodies, FrictionLaw::one_step);
  EXPECT_NEAR(slip.impulse[0].tangential, 0.2, 1e-13);
}

TEST(ContactProblem, FixedDirectionUsesAllOfTheFriction) {
  const ContactSolution s =
      solve_contacts({right_of(0, 1, 0.5)}, {disc({1.0, 0.2}), wall}, FrictionLaw::fixed_direction);
  EXPECT_NEAR(s.impulse[0].normal, 2.0, 1e-13);
  EXPECT_NEAR(s.impulse[0].tangential, 1.0, 1e-13);
  const ContactSolution straight =
      solve_contacts({right_of(0, 1, 0.5)}, {disc({1.0, 0.0}), wall}, FrictionLaw::fixed_direction);
  EXPECT_EQ(straight.impulse[0].tangential, 0.0);
}

TEST(ContactProblem, AHitInTwoStepsObeysTheLawOfOneImpact) {
  const CollisionMass mass_a{0.5, 0.8}, mass_b{0.5, 0.6};
  ProblemPoint p = right_of(0, 1);
  p.arm_a = {1.0, 0.4};
  p.arm_b = {-1.0, -0.3};
  const ContactCompliance k = contact_compliance(mass_a, p.arm_a, mass_b, p.arm_b, p.normal);
  for (const double slip : {-0.5, -0.02, 0.1})
    for (const double mu : {0.05, 0.2, 0.6})
      for (const double first : {-1.4, -0.7, -0.01}) {  // what the gap lets through
        const ContactImpulse law = impact_one_step(k, -1.5, slip, 0.0, mu);
        std::vector<ProblemBody> bodies{{mass_a, {1.0, -slip}, 0.0}, {mass_b, {-0.5, 0.0}, 0.0}};
        p.friction = mu;
        p.target = first;
        p.spare = {};
        const ContactImpulse one = solve_contacts({p}, bodies, FrictionLaw::one_step).impulse[0];
        const Vec2 given{one.normal, one.tangential};
        bodies[1].velocity += mass_b.inverse_mass * given;
        bodies[1].spin += mass_b.inverse_inertia * cross(p.arm_b, given);
        bodies[0].velocity -= mass_a.inverse_mass * given;
        bodies[0].spin -= mass_a.inverse_inertia * cross(p.arm_a, given);
        p.target = 0.0;
        p.spare = spare_friction(mu, one, rise_of_load(0.0, one.normal), k, -first);
        const ContactImpulse two = solve_contacts({p}, bodies, FrictionLaw::one_step).impulse[0];
        EXPECT_GE(two.normal, 0.0);
        EXPECT_NEAR(one.normal + two.normal, law.normal, 1e-12) << slip << ' ' << mu << ' ' << first;
        EXPECT_NEAR(one.tangential + two.tangential, law.tangential, 1e-12) << slip << ' ' << mu << ' ' << first;
      }
}

TEST(ContactProblem, OnePointObeysTheLawOfAnImpact) {
  const std::vector<ProblemBody> bodies{disc({1.0, 0.3}, 0.8), disc({-0.5, -0.2}, 0.6)};
  ProblemPoint p = right_of(0, 1);
  p.arm_a = {1.0, 0.4};
  p.arm_b = {-1.0, -0.3};
  const ContactCompliance k = contact_compliance(bodies[0].mass, p.arm_a, bodies[1].mass, p.arm_b, p.normal);
  for (const double mu : {0.05, 0.2, 0.6}) {
    p.friction = mu;
    const ContactImpulse law = impact_one_step(k, -1.5, -0.5, 0.0, mu);
    const ContactSolution s = solve_contacts({p}, bodies, FrictionLaw::one_step);
    EXPECT_NEAR(s.impulse[0].normal, law.normal, 1e-12) << mu;
    EXPECT_NEAR(s.impulse[0].tangential, law.tangential, 1e-12) << mu;
    const ContactImpulse fixed = impact_fixed_direction(k, -1.5, -0.5, 0.0, mu);
    const ContactSolution f = solve_contacts({p}, bodies, FrictionLaw::fixed_direction);
    EXPECT_NEAR(f.impulse[0].normal, fixed.normal, 1e-12) << mu;
    EXPECT_NEAR(f.impulse[0].tangential, fixed.tangential, 1e-12) << mu;
  }
}

}  // namespace
}  // namespace gem::reference
