// The forces between bodies add up to what the platform feels, on every engine that tells them.
#include "gem/engine/step/contact_forces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

/// Force of the floes on the platform [N].
Vec2 force_on_platform(Engine& engine) {
  Vec2 sum;
  for (const ContactForce& c : engine.contact_forces())
    if (c.a == 0 && engine.bodies().kind[c.b] == BodyKind::floe) sum -= c.force;
  return sum;
}

class ContactForcesTest : public testing::TestWithParam<std::tuple<const char*, ContactSolver>> {
 protected:
  SceneDef scene_ = [] {
    SceneDef scene = test::busy_scene(3);
    scene.contact.solver = std::get<1>(GetParam());
    scene.output.retire_x_m = 1e4;  // a retired floe has no forces
    return scene;
  }();
  std::unique_ptr<Engine> engine_ = test::busy_engine(scene_, std::get<0>(GetParam()), 2);
};

TEST_P(ContactForcesTest, AddUpToTheIceForceOnThePlatform) {
  ASSERT_TRUE(engine_->has_contact_forces());
  EXPECT_TRUE(engine_->contact_forces().empty()) << "before the first time step";
  int loaded = 0;
  for (int step = 0; step < 600 && loaded < 8; ++step) {
    StepLog log;
    engine_->advance(1, log);
    const Vec2 felt = (1.0 / scene_.numerics.time_step_s) * log.platform[0].ice_impulse;
    // the same impulses, turned and added in another order
    EXPECT_LE(length(force_on_platform(*engine_) - felt), 1e-9 * (1.0 + length(felt))) << "time step " << step;
    loaded += length(felt) > 0.0;
  }
  EXPECT_GT(loaded, 3) << "the platform must be touched";
}

TEST_P(ContactForcesTest, StandAtTheBodiesInOrder) {
  StepLog log;
  engine_->advance(100, log);
  const std::vector<ContactForce> forces = engine_->contact_forces();
  ASSERT_GT(forces.size(), 10U);
  const Bodies& b = engine_->bodies();
  for (std::size_t i = 0; i < forces.size(); ++i) {
    const ContactForce& c = forces[i];
    EXPECT_LT(c.a, c.b);
    if (i > 0) {
      EXPECT_LT(std::tie(forces[i - 1].a, forces[i - 1].b), std::tie(c.a, c.b));
    }
    EXPECT_LE(length(c.point - b.position[c.b]), b.radius[c.b] + 0.1);
  }
}

TEST_P(ContactForcesTest, AreUnknownAfterARestore) {
  StepLog log;
  engine_->advance(100, log);
  engine_->restore(engine_->save());
  EXPECT_TRUE(engine_->contact_forces().empty());
}

std::string case_name(const testing::TestParamInfo<ContactForcesTest::ParamType>& info) {
  return std::string(std::get<0>(info.param)) + "_" + solver_name(std::get<1>(info.param));
}

INSTANTIATE_TEST_SUITE_P(Engines, ContactForcesTest,
                         testing::Combine(testing::Values("cpu", "reference"),
                                          testing::Values(ContactSolver::independent, ContactSolver::coupled)),
                         case_name);

TEST(ContactForces, HaveTheSameBitsForEveryNumberOfThreads) {
  const SceneDef scene = test::busy_scene(5);
  std::vector<std::vector<ContactForce>> all;
  for (const int threads : {1, 3}) {
    const auto engine = test::busy_engine(scene, "cpu", threads);
    StepLog log;
    engine->advance(120, log);
    all.push_back(engine->contact_forces());
  }
  ASSERT_EQ(all[0].size(), all[1].size());
  ASSERT_GT(all[0].size(), 10U);
  for (std::size_t i = 0; i < all[0].size(); ++i) {
    const ContactForce &p = all[0][i], &q = all[1][i];
    EXPECT_EQ(std::tie(p.a, p.b, p.point.x, p.point.y, p.force.x, p.force.y),
              std::tie(q.a, q.b, q.point.x, q.point.y, q.force.x, q.force.y));
  }
}

}  // namespace
}  // namespace gem
