// What is gathered from synthetic time steps and frames.
#include "gem/run/run_watch.h"

#include <gtest/gtest.h>

#include "gem/engine/step/step_constants.h"
#include "gem/field/field.h"
#include "gem/record/fake_engine.h"

namespace gem {
namespace {

class RunWatchTest : public testing::Test {
 protected:
  RunWatchTest() {
    scene_.current.velocity_m_per_s = {0.5, 0.0};
    scene_.numerics.time_step_s = 0.1;
    engine_.asked = 1e-3 * 0.5;
  }

  /// A time step with these numbers; the others are those of a quiet step.
  static StepQuality quality(int contacts, double residual, double share = 0.0, double energy = 0.0) {
    StepQuality q;
    q.contacts = contacts;
    q.residual = residual;
    q.maximum_share = share;
    q.energy_created = energy;
    return q;
  }

  RunWatch watch() { return {scene_, engine_}; }
  static void add(RunWatch& watch, const StepQuality& quality, Vec2 ice_impulse = {}) {
    StepLog log;
    log.quality.push_back(quality);
    log.platform.emplace_back().ice_impulse = ice_impulse;
    watch.add(log);
  }

  SceneDef scene_ = [] {
    SceneDef scene;
    scene.contact.solver = ContactSolver::coupled;
    return scene;
  }();
  FakeEngine engine_{scene_, fake_field(3)};
};

TEST_F(RunWatchTest, StepsAboveTheToleranceAreCountedAmongThoseWithContacts) {
  RunWatch watch = this->watch();
  for (int i = 0; i < 5; ++i) add(watch, quality(0, 0.4));  // without contacts: not counted
  for (int i = 0; i < 12; ++i) add(watch, quality(3, 0.0004));
  for (int i = 0; i < 6; ++i) add(watch, quality(3, 0.02));
  add(watch, quality(3, 0.3));
  add(watch, quality(3, 0.2));
  const RunMeasures m = watch.measures();
  EXPECT_DOUBLE_EQ(m.speed_scale, 0.5);
  EXPECT_DOUBLE_EQ(m.unfinished_share, 8.0 / 20.0);
  EXPECT_DOUBLE_EQ(m.residual.value, 0.3);
  EXPECT_DOUBLE_EQ(m.residual.time_s, 2.4);
  // a class of the histogram is up to an eighth wide
  EXPECT_GE(m.residual_median, 0.0004);
  EXPECT_LE(m.residual_median, 0.0004 * 1.125);
  EXPECT_GE(m.residual_most, 0.02);
  EXPECT_LE(m.residual_most, 0.02 * 1.125);
}

/// As after --from: the scene of the run names a file, and only the field has the floes.
TEST_F(RunWatchTest, TheToleranceIsThatOfTheEngineForFloesFasterThanTheCurrent) {
  SceneDef listed = scene_;
  listed.floes.source = FloeSource::listed;
  FloeDef& floe = listed.floe.emplace_back();
  floe.outline_m = {{0.0, 0.0}, {5.0, 0.0}, {2.0, 4.0}};
  floe.position_m = {-200.0, 0.0};
  floe.velocity_m_per_s = {0.3, -1.1};
  floe.spin_rad_per_s = 0.2;
  const std::unique_ptr<Engine> engine = make_engine(listed, make_field(listed), {"cpu", 1});
  const double asked = step_constants(listed, engine->bodies()).residual_speed;
  EXPECT_GT(asked, 1.2 * step_constants(scene_, engine->bodies()).residual_speed);
  EXPECT_DOUBLE_EQ(RunWatch(scene_, *engine).asked_residual(), asked);
}

TEST_F(RunWatchTest, ARunWithoutContactsLeavesNothing) {
  RunWatch watch = this->watch();
  EXPECT_TRUE(std::isnan(watch.measures().unfinished_share)) << "no time step, nothing measured";
  add(watch, quality(0, 0.0));
  EXPECT_EQ(watch.measures().unfinished_share, 0.0);
  EXPECT_EQ(watch.measures().residual_most, 0.0);
  EXPECT_EQ(watch.measures().overlap_share.value, 0.0);
}

TEST_F(RunWatchTest, ASolverWithoutIterationsHasNoResidual) {
  engine_.asked = std::nan("");
  RunWatch watch = this->watch();
  add(watch, quality(3, 0.0, 0.2));
  EXPECT_TRUE(std::isnan(watch.measures().unfinished_share));
  EXPECT_TRUE(std::isnan(watch.measures().residual_most));
  EXPECT_DOUBLE_EQ(watch.measures().overlap_share.value, 0.2);
}

TEST_F(RunWatchTest, TheDeepestOverlapHasItsTime) {
  RunWatch watch = this->watch();
  for (const double share : {0.0, 0.1, 0.3, 0.2}) add(watch, quality(1, 0.0, share));
  EXPECT_DOUBLE_EQ(watch.measures().overlap_share.value, 0.3);
  EXPECT_NEAR(watch.measures().overlap_share.time_s, 0.3, 1e-12);
}

TEST_F(RunWatchTest, EnergiesAreSumsBySign) {
  RunWatch watch = this->watch();
  for (const double energy : {0.0, 3.0, 0.0, 2.0}) add(watch, quality(1, 0.0, 0.0, energy));
  StatsRow books;
  books.kinetic_energy = 40.0;
  books.ledger[Channel::impact].energy = -20.0;
  books.ledger[Channel::friction].energy = -4.0;
  books.ledger[Channel::elastic].energy = 1.0;
  books.ledger[Channel::drag].energy = 900.0;  // not of contacts
  watch.look_at(engine_.bodies(), books);
  EXPECT_DOUBLE_EQ(watch.measures().energy_created, 5.0);
  EXPECT_DOUBLE_EQ(watch.measures().energy_lost, 28.0);  // net -23
  EXPECT_DOUBLE_EQ(watch.measures().energy_largest, 40.0);
}

TEST_F(RunWatchTest, EnergyThatOneStepDoesNotMeasureIsUnknown) {
  RunWatch watch = this->watch();
  for (const double energy : {0.0, std::nan(""), 2.0}) add(watch, quality(1, 0.0, 0.0, energy));
  watch.look_at(engine_.bodies(), {});
  EXPECT_TRUE(std::isnan(watch.measures().energy_created));
  EXPECT_TRUE(std::isnan(watch.measures().energy_lost));
}

TEST_F(RunWatchTest, TheFastestFloeIsLookedForInFrames) {
  RunWatch watch = this->watch();
  Bodies bodies = engine_.bodies();
  bodies.velocity[0] = {50.0, 0.0};  // the platform is no floe
  bodies.velocity[2] = {3.0, 4.0};
  bodies.velocity[3] = {7.0, 0.0};
  bodies.active[3] = 0;
  StatsRow books;
  books.time = 10.0;
  watch.look_at(bodies, books);
  EXPECT_DOUBLE_EQ(watch.measures().floe_speed.value, 5.0);
  EXPECT_DOUBLE_EQ(watch.measures().floe_speed.time_s, 10.0);
}

TEST_F(RunWatchTest, TheDrivingSpeedHoldsTheStartAndTheSwing) {
  scene_.platform.start_velocity_m_per_s = {0.7, 0.0};
  EXPECT_DOUBLE_EQ(watch().measures().speed_scale, 0.7);
  Bodies bodies = fake_field(3);
  bodies.velocity[3] = {2.0, 0.0};
  bodies.spin[3] = 0.5;
  FakeEngine fast(scene_, bodies);
  EXPECT_DOUBLE_EQ(RunWatch(scene_, fast).measures().speed_scale, 2.0 + 0.5 * bodies.radius[3]);
}

TEST_F(RunWatchTest, TheForceOfEveryTimeStepCounts) {
  RunWatch watch = this->watch();
  for (int i = 0; i < 1000; ++i) add(watch, quality(1, 0.0), {i % 2 == 0 ? 1e4 : 0.0, 0.0});
  EXPECT_EQ(watch.measures().loaded_steps, 500);
  EXPECT_NEAR(watch.measures().nyquist_share, 1.0, 2e-3);
}

}  // namespace
}  // namespace gem
