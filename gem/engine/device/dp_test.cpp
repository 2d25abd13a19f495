// Dynamic positioning gives the bits, the books and the log of the cpu engine, whole and after a restart.
#include <gtest/gtest.h>

#include "gem/engine/device/phases.h"
#include "gem/engine/testing/host_scene.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

using test::HostScene;

void expect_dp_of_cpu(bool phases, ContactSolver solver) {
  SceneDef scene = test::dp_scene(7);
  scene.contact.solver = solver;
  const auto cpu = test::busy_engine(scene, "cpu", 2);
  HostScene device(scene, test::busy_field(scene), 1, phases ? test::team_warp : 1, 0, bodies_shared_bytes);
  if (phases) device.use_phases();
  StepLog expected, log;
  for (const std::int64_t steps : {1, 39, 20}) {
    cpu->advance(steps, expected);
    device.advance(steps, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    if (testing::Test::HasFailure()) return;
    test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
    EXPECT_LT(residual(cpu->ledger()).energy, 1e-12);
    EXPECT_LT(residual(cpu->ledger()).momentum, 1e-12);
    EXPECT_LT(residual(cpu->ledger()).angular_momentum, 1e-12);
    device.restore(cpu->save());
  }
  EXPECT_GT(test::contacts_in(expected), 300);
  EXPECT_EQ(expected.dp.size(), 60U);
  std::uint64_t limited = 0;
  for (const DpState& dp : expected.dp) limited |= dp.at_limit;
  EXPECT_NE(limited, 0U) << "some thruster meets its limit";
  EXPECT_GT(length(expected.dp.back().integral), 0.0);
}

TEST(DeviceDp, GivesTheBitsOfTheCpuEngineOnBothRoutes) {
  for (const bool phases : {false, true})
    for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled})
      expect_dp_of_cpu(phases, solver);
}

}  // namespace
}  // namespace gem
