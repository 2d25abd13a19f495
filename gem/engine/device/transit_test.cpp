// A ship in transit has the bits, the books and the log of the cpu engine, whole and after a restart.
#include <algorithm>

#include "gem/engine/testing/device_and_cpu.h"

namespace gem {
namespace {

TEST(DeviceTransit, GivesTheBitsOfTheCpuEngineOnBothRoutes) {
  for (const bool phases : {false, true})
    for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled}) {
      const StepLog log = test::expect_bits_of_cpu(test::transit_scene(7), phases, solver);
      ASSERT_EQ(log.platform.size(), 60U);
      EXPECT_NE(log.platform.back().spin, 0.0) << "it turns at its way point";
      EXPECT_GT(length(log.platform.back().mooring_impulse), 0.0);
      double felt = 0.0;
      for (const PlatformStep& step : log.platform) felt += length(step.ice_impulse);
      EXPECT_GT(felt, 0.0) << "ice hits it";
    }
}

TEST(DeviceTransit, GivesTheBitsOfTheCpuEngineForAShipThatRunsFree) {
  for (const bool phases : {false, true})
    for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled}) {
      const StepLog log = test::expect_bits_of_cpu(test::free_ship_scene(7), phases, solver);
      ASSERT_EQ(log.platform.size(), 60U);
      double slowest = 1.0;
      for (const PlatformStep& step : log.platform) slowest = std::min(slowest, -step.velocity.x);
      EXPECT_LT(slowest, 0.99) << "the ice slows it down";
    }
}

}  // namespace
}  // namespace gem
