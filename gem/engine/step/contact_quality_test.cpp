// Each contact law, satisfied and violated at one point by a known amount; and whole time steps of a crowded scene.
#include "gem/engine/step/contact_quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/engine/step/contact_outcome.h"
#include "gem/engine/step/step_constants.h"
#include "gem/engine/testing/speed_still_asked.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

/// Two bodies of 2 kg, central contact along x: compliance 1/kg.
constexpr CollisionMass mass{0.5, 0.0};

Contact touching(ContactImpulse impulse, double before_n, double before_t) {
  Contact contact;
  contact.count = 1;
  contact.normal = {1.0, 0.0};
  contact.friction = 0.5;
  contact.slot[0].impulse = impulse;
  contact.slot[0].normal_before = before_n;
  contact.slot[0].tangential_before = before_t;
  return contact;
}

PointQuality quality_of(const Contact& contact, Vec2 after) {
  return point_quality(contact, contact.slot[0], mass, mass, after);
}

TEST(ContactQuality, PlasticImpactMissesNothing) {
  const PointQuality q = quality_of(touching({0.3, 0.1}, -0.3, -0.1), {0.0, 0.0});
  EXPECT_EQ(q.complementarity, 0.0);
  EXPECT_EQ(q.cone_excess, 0.0);
  EXPECT_DOUBLE_EQ(q.work, -0.5 * (0.3 * 0.3 + 0.1 * 0.1));
}

TEST(ContactQuality, ComplementarityIsTheSpeedStillAskedFor) {
  EXPECT_DOUBLE_EQ(quality_of(touching({0.3, 0.0}, -0.4, 0.0), {-0.1, 0.0}).complementarity, 0.1);  // still closes
  EXPECT_DOUBLE_EQ(quality_of(touching({0.0, 0.0}, -0.1, 0.0), {-0.1, 0.0}).complementarity, 0.1);
  EXPECT_EQ(quality_of(touching({0.0, 0.0}, 0.1, 0.0), {0.1, 0.0}).complementarity, 0.0);         // parts freely
  EXPECT_DOUBLE_EQ(quality_of(touching({0.3, 0.0}, 0.0, 0.0), {0.2, 0.0}).complementarity, 0.2);  // pushed apart
  EXPECT_DOUBLE_EQ(quality_of(touching({0.3, 0.0}, 0.1, 0.0), {0.4, 0.0}).complementarity, 0.3);  // ... all of P_n
}

TEST(ContactQuality, CrushingMayCloseAndAGapMayCloseSoFar) {
  Contact crushed = touching({0.3, 0.0}, -0.4, 0.0);
  crushed.slot[0].cap = 0.3;
  EXPECT_EQ(quality_of(crushed, {-0.1, 0.0}).complementarity, 0.0);
  crushed.slot[0].cap = 0.35;
  EXPECT_NEAR(quality_of(crushed, {-0.1, 0.0}).complementarity, 0.05, 1e-15);
  Contact apart = touching({0.0, 0.0}, -0.1, 0.0);
  apart.slot[0].target = -0.1;
  EXPECT_EQ(quality_of(apart, {-0.1, 0.0}).complementarity, 0.0);
}

TEST(ContactQuality, ConeExcessAndWorkOfAWrongImpulse) {
  const PointQuality q = quality_of(touching({0.2, -0.15}, 0.1, 0.0), {0.3, -0.15});
  EXPECT_DOUBLE_EQ(q.cone_excess, 0.15 - 0.5 * 0.2);
  EXPECT_GT(q.work, 0.0);
}

/// In the order of the contacts, as the points of one body. Three sums, one for each piece, would round otherwise.
TEST(ContactQuality, WorkOfPiecesOnAFixedBodyCountsForTheirOwner) {
  const SceneDef scene = test::pieces_scene(1);
  const Bodies field = make_field(scene);
  const FieldState f = make_field_state(field, step_constants(scene, field));
  ASSERT_EQ(f.bodies.kind[3], BodyKind::fixed);
  constexpr double half_rounding = 0x1p-53;
  std::vector<ContactOutcome> outcomes(3);
  for (std::int32_t piece = 0; piece < 3; ++piece) {
    outcomes[piece].a = piece;
    outcomes[piece].b = 3;
    outcomes[piece].count = 1;
    outcomes[piece].point[0].quality.work = piece == 1 ? 1.0 : half_rounding;
  }
  std::vector<double> work;
  StepQuality quality;
  StepLog log;
  note_outcomes(f, outcomes, work, quality, log);
  EXPECT_EQ(quality.energy_created, 1.0);
}

TEST(ContactQuality, ACrowdIsResolvedToItsToleranceWithoutCreatingEnergy) {
  SceneDef scene = test::busy_scene(4);
  scene.numerics.iterations_maximum = 5000;
  const Bodies field = test::busy_field(scene);
  const double residual = step_constants(scene, field).residual_speed;
  // a bound on the momentum of any body [N s]
  double momentum = 0.0;
  for (const double kg : field.mass) momentum = std::max(momentum, kg * residual / scene.numerics.residual_tolerance);
  for (const char* name : {"reference", "cpu"}) {
    const auto engine = test::busy_engine(scene, name);
    StepLog log;
    engine->advance(200, log);
    StepQuality worst;
    for (const StepQuality& quality : log.quality) worst.worsen(quality);
    ASSERT_GT(worst.contacts, 20);
    ASSERT_LE(worst.residual, residual);
    EXPECT_LE(worst.complementarity, test::speed_still_asked(field, residual));
    EXPECT_GT(worst.complementarity, 0.0);
    EXPECT_LE(worst.cone_excess, 1e-15 * momentum) << "beyond the rounding of one impulse";
    EXPECT_EQ(worst.energy_created, 0.0);
  }
}

}  // namespace
}  // namespace gem
