// Moorings beyond the linear one give the bits, the books and the log of the cpu engine, whole and after a restart.
#include "gem/engine/testing/device_and_cpu.h"

namespace gem {
namespace {

LineSet broken_of(const StepLog& log) { return log.platform.back().broken; }

TEST(DeviceMooring, TablesGiveTheBitsOfTheCpuEngineOnBothRoutes) {
  for (const bool phases : {false, true})
    for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled})
      EXPECT_EQ(broken_of(test::expect_bits_of_cpu(test::moored_scene(7), phases, solver)), 0U);
}

TEST(DeviceMooring, LinesThatBreakGiveTheBitsOfTheCpuEngineOnBothRoutes) {
  EXPECT_NE(broken_of(test::expect_bits_of_cpu(test::lines_scene(7), false, ContactSolver::independent)), 0U);
  EXPECT_NE(broken_of(test::expect_bits_of_cpu(test::lines_scene(7), true, ContactSolver::coupled)), 0U);
}

}  // namespace
}  // namespace gem
