// For tests: a device scene in host memory beside the cpu engine, whole and after restarts.
#pragma once

#include <gtest/gtest.h>

#include "gem/engine/device/phases.h"
#include "gem/engine/testing/host_scene.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem::test {

/// Expects the bits, the books and the log of the cpu engine over 60 time steps with many contacts. Returns the log of
/// the cpu engine.
inline StepLog expect_bits_of_cpu(SceneDef scene, bool phases, ContactSolver solver) {
  scene.contact.solver = solver;
  const auto cpu = busy_engine(scene, "cpu", 2);
  HostScene device(scene, busy_field(scene), 1, phases ? team_warp : 1, 0, bodies_shared_bytes);
  if (phases) device.use_phases();
  StepLog expected, log;
  for (const std::int64_t steps : {1, 39, 20}) {
    cpu->advance(steps, expected);
    device.advance(steps, log);
    expect_same_bodies(device.bodies(), cpu->bodies());
    expect_same_log(log, expected);
    if (testing::Test::HasFailure()) return expected;
    expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
    EXPECT_LT(residual(cpu->ledger()).energy, 1e-12);
    EXPECT_LT(residual(cpu->ledger()).momentum, 1e-12);
    EXPECT_LT(residual(cpu->ledger()).angular_momentum, 1e-12);
    EXPECT_EQ(cpu->broken_lines(), expected.platform.back().broken);
    device.restore(cpu->save());
  }
  EXPECT_GT(contacts_in(expected), 300);
  EXPECT_GT(ice_impulse_in(expected), 0.0) << "ice hits the platform";
  return expected;
}

}  // namespace gem::test
