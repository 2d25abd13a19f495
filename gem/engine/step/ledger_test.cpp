// The ledger closes on scenes with all laws on. It does not close if a velocity is changed. A state that is not finite
// stops the run.
#include "gem/engine/step/ledger.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <tuple>

#include "gem/base/error.h"
#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/field/field.h"

namespace gem {
namespace {

using Combination = std::tuple<ContactSolver, Manifold, Yaw, FrictionLaw>;

class LedgerTest : public testing::TestWithParam<Combination> {};

TEST_P(LedgerTest, ClosesOverTwoThousandTimeSteps) {
  SceneDef scene = test::busy_scene(9);
  std::tie(scene.contact.solver, scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law) = GetParam();
  const auto engine = test::busy_engine(scene, "cpu");
  StepLog log;
  LedgerResidual worst;
  for (int block = 0; block < 20; ++block) {
    engine->advance(100, log);
    const LedgerResidual left = residual(engine->ledger());
    worst.momentum = std::max(worst.momentum, left.momentum);
    worst.angular_momentum = std::max(worst.angular_momentum, left.angular_momentum);
    worst.energy = std::max(worst.energy, left.energy);
  }
  EXPECT_LT(worst.momentum, 1e-12);
  EXPECT_LT(worst.angular_momentum, 1e-12);
  EXPECT_LT(worst.energy, 1e-9);

  // every channel was used
  const Ledger ledger = engine->ledger();
  EXPECT_GT(test::contacts_in(log), 20000);
  EXPECT_LT(ledger[Channel::impact].energy, 0.0);
  EXPECT_NE(ledger[Channel::friction].energy, 0.0);
  EXPECT_NE(ledger[Channel::drag].energy, 0.0);
  EXPECT_LT(ledger[Channel::mooring].energy, 0.0);
  EXPECT_NE(ledger[Channel::platform_drag].energy, 0.0);
  EXPECT_NE(ledger[Channel::retired].momentum.x, 0.0);
  EXPECT_NE(ledger.mooring_force.momentum.x, 0.0);
  if (scene.contact.solver == ContactSolver::independent)
    EXPECT_NE(ledger[Channel::elastic].energy, 0.0);
  else
    EXPECT_NE(ledger[Channel::repair].energy, 0.0);
  // repair moves bodies with their velocities: mass x shift x relative speed per contact, of either sign
  const double repaired = std::abs(ledger[Channel::repair].angular_momentum);
  EXPECT_LT(repaired, 1e-4 * ledger.angular_scale);
  EXPECT_EQ(repaired > 0.0, scene.contact.solver == ContactSolver::coupled);
}

INSTANTIATE_TEST_SUITE_P(Combinations, LedgerTest,
                         testing::Combine(testing::Values(ContactSolver::independent, ContactSolver::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction)),
                         test::LawNames());

TEST(Ledger, AForgedVelocityDoesNotCloseTheBooks) {
  const SceneDef scene = test::busy_scene(10);
  const auto engine = test::busy_engine(scene, "cpu");
  StepLog log;
  engine->advance(200, log);
  const LedgerResidual honest = residual(engine->ledger());
  EXPECT_LT(honest.momentum, 1e-12);
  EXPECT_LT(honest.energy, 1e-9);
  EngineState state = engine->save();
  std::size_t floe = state.bodies.count() - 1;
  while (!state.bodies.active[floe]) --floe;
  state.bodies.velocity[floe].x += 1e-3;
  state.bodies.spin[floe] += 1e-3;
  engine->restore(state);
  engine->advance(200, log);
  const LedgerResidual forged = residual(engine->ledger());
  EXPECT_GT(forged.momentum, 1e-8);
  EXPECT_GT(forged.angular_momentum, 1e-8);
  EXPECT_GT(forged.energy, 1e-8);
}

TEST(Ledger, AnHonestRestartKeepsTheBooksClosed) {
  const SceneDef scene = test::busy_scene(11);
  for (const std::string& name : engine_names()) {
    const auto engine = test::busy_engine(scene, name);
    StepLog log;
    for (int i = 0; i < 10; ++i) {
      engine->advance(20, log);
      engine->restore(engine->save());
    }
    const LedgerResidual left = residual(engine->ledger());
    EXPECT_LT(left.momentum, 1e-12) << name;
    EXPECT_LT(left.angular_momentum, 1e-12) << name;
    EXPECT_LT(left.energy, 1e-9) << name;
    EXPECT_GT(test::contacts_in(log), 500) << name;
  }
}

TEST(NumericalStop, NamesTheBodyWhoseStateIsNoNumber) {
  const SceneDef scene = test::busy_scene(12);
  for (const std::string& name : engine_names()) {
    const auto engine = test::busy_engine(scene, name);
    StepLog log;
    engine->advance(3, log);
    EngineState state = engine->save();
    // the last floe upstream stands alone, so no neighbour passes NaN on before the floe is named
    std::size_t alone = 3;
    for (std::size_t i = 3; i < state.bodies.count(); ++i)
      if (state.bodies.position[i].x < state.bodies.position[alone].x) alone = i;
    state.bodies.position[alone].x -= 100.0;
    state.bodies.velocity[alone].x = std::numeric_limits<double>::quiet_NaN();
    engine->restore(state);
    try {
      engine->advance(10, log);
      ADD_FAILURE() << name << " went on";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::numerical_stop) << name;
      const std::string text = error.what();
      EXPECT_NE(text.find("body " + std::to_string(alone) + " "), std::string::npos) << name << ": " << text;
      EXPECT_NE(text.find("time step 3 (t = 0.15 s)"), std::string::npos) << name << ": " << text;
    }
  }
}

// The platform has the lower id, so the fixed body is body B of the contact.
TEST(Ledger, ClosesWhereThePlatformMeetsAFixedBody) {
  for (const std::string& name : engine_names())
    for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled}) {
      SceneDef scene;
      scene.floes.source = FloeSource::listed;
      scene.boundary.present = false;
      scene.mooring.stiffness_N_per_m = 0.0;
      scene.platform.start_velocity_m_per_s = {0.2, 0.0};
      scene.contact.solver = solver;
      scene.fixed.push_back({{{51.0, -20.0}, {70.0, -20.0}, {70.0, 30.0}, {51.0, 30.0}}});
      const auto engine = make_engine(scene, make_field(scene), {.name = name, .threads = 1});
      StepLog log;
      engine->advance(300, log);
      const Ledger ledger = engine->ledger();
      EXPECT_LT(length(engine->bodies().velocity[0]), 0.01) << name;
      EXPECT_LT(ledger[Channel::impact].momentum.x, -1.9e7) << name;
      const LedgerResidual left = residual(ledger);
      EXPECT_LT(left.momentum, 1e-12) << name;
      EXPECT_LT(left.angular_momentum, 1e-12) << name;
      EXPECT_LT(left.energy, 1e-9) << name;
      for (const PlatformStep& step : log.platform) EXPECT_EQ(step.ice_impulse.x, 0.0);
    }
}

}  // namespace
}  // namespace gem
