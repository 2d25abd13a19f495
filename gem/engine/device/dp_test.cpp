// Dynamic positioning gives the bits, the books and the log of the cpu engine, whole and after a restart.
#include "gem/engine/testing/device_and_cpu.h"

namespace gem {
namespace {

TEST(DeviceDp, GivesTheBitsOfTheCpuEngineOnBothRoutes) {
  for (const bool phases : {false, true})
    for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled}) {
      const StepLog log = test::expect_bits_of_cpu(test::dp_scene(7), phases, solver);
      ASSERT_EQ(log.dp.size(), 60U);
      std::uint64_t limited = 0;
      for (const DpState& dp : log.dp) limited |= dp.at_limit;
      EXPECT_NE(limited, 0U) << "some thruster meets its limit";
      EXPECT_GT(length(log.dp.back().integral), 0.0);
    }
}

}  // namespace
}  // namespace gem
