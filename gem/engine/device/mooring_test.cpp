// Moorings beyond the linear one give the bits, the books and the log of the cpu engine, whole and after a restart.
#include <gtest/gtest.h>

#include "gem/engine/device/phases.h"
#include "gem/engine/testing/host_scene.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

using test::HostScene;

void expect_bits_of_cpu(SceneDef scene, bool phases, ContactSolver solver) {
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
  EXPECT_EQ(cpu->broken_lines() != 0, scene.mooring.law == MooringLaw::catenary);
  EXPECT_EQ(cpu->broken_lines(), expected.platform.back().broken);
}

TEST(DeviceMooring, TablesGiveTheBitsOfTheCpuEngineOnBothRoutes) {
  for (const bool phases : {false, true})
    for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled})
      expect_bits_of_cpu(test::moored_scene(7), phases, solver);
}

TEST(DeviceMooring, LinesThatBreakGiveTheBitsOfTheCpuEngineOnBothRoutes) {
  expect_bits_of_cpu(test::lines_scene(7), false, ContactSolver::independent);
  expect_bits_of_cpu(test::lines_scene(7), true, ContactSolver::coupled);
}

}  // namespace
}  // namespace gem
