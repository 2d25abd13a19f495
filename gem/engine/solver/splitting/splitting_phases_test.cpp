// Operator splitting on a device gives the bits of the cpu engine: state, log, books, warm start.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "gem/engine/device/phases.h"
#include "gem/engine/solver/splitting/round_control.h"
#include "gem/engine/testing/host_scene.h"
#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/field/field.h"
#include "gem/scene/sweep/sweep.h"

namespace gem {
namespace {

using test::HostScene;
using Choice = std::tuple<Manifold, FrictionLaw, double, int>;

class DeviceSplitting : public testing::TestWithParam<Choice> {};

TEST_P(DeviceSplitting, GivesTheBitsOfTheCpuEngine) {
  SceneDef scene = test::busy_scene(7);
  scene.contact.solver = ContactSolver::coupled;
  scene.numerics.iteration = Iteration::splitting;
  scene.numerics.iterations_maximum = 60;  // a round, and a rest that is too short for another
  scene.numerics.time_step_s = 0.2;
  int threads = 0;
  std::tie(scene.contact.manifold, scene.contact.friction_law, scene.numerics.residual_tolerance, threads) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device(scene, test::busy_field(scene), 2, threads, 0, bodies_shared_bytes);
  device.use_phases();
  device.divide_islands(16, 128);
  StepLog expected, log;
  for (int call = 0; call < 2; ++call) {
    cpu->advance(2, expected);
    device.advance(2, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    if (HasFailure()) return;
  }
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  test::expect_same_coupled(device, log, *cpu, expected);
  EXPECT_GT(test::contacts_in(expected), 40);
}

INSTANTIATE_TEST_SUITE_P(Laws, DeviceSplitting,
                         testing::Combine(testing::Values(Manifold::chord_ends, Manifold::chord_middle),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          // where no island keeps its impulses, and where some do
                                          testing::Values(1e-5, 1e-2), testing::Values(test::team_warp)));

/// Floes that are jammed at the platform, in islands that gradient iterations begin, and in which they end rounds.
TEST(DeviceIslands, GiveTheBitsOfTheCpuEngineInAJam) {
  SceneDef scene = test::busy_scene(7);
  scene.numerics.iteration = Iteration::splitting;
  scene.contact.solver = ContactSolver::coupled;
  scene.numerics.residual_tolerance = 2e-6;
  scene.numerics.iterations_maximum = 192;
  scene.numerics.time_step_s = 0.2;
  scene.boundary.gap_m = 24.0;
  scene.output.retire_x_m = 60.0;
  const auto cpu = test::busy_engine(scene, "cpu");
  StepLog expected, log;
  cpu->advance(500, expected);
  HostScene device(scene, test::busy_field(scene), 2, test::team_warp, 0, bodies_shared_bytes);
  device.use_phases();
  device.divide_islands(16, 128);
  device.restore(cpu->save());
  expected.clear();
  cpu->advance(2, expected);
  device.advance(2, log);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  for (const StepQuality& quality : expected.quality) {
    EXPECT_GT(quality.contacts, 200);
    EXPECT_GE(quality.iterations, RoundControl::short_round);
  }
}

/// A barge runs into a box of ice at 1 m/s, and is 3 cm farther on when the islands are cut than at the start of the
/// time step. From a state in which the cuts show the difference.
TEST(DeviceIslands, CutsAnIslandWhereThePlatformIsInTheMiddleOfTheTimeStep) {
  const std::vector<SweepMember> members = expand_sweep(GEM_SOURCE_DIR "/cases/hard/H16_squeeze.toml", {});
  const auto barge = std::find_if(members.begin(), members.end(), [](const auto& m) { return m.name == "H16_100"; });
  ASSERT_NE(barge, members.end());
  SceneDef scene = barge->scene;
  scene.contact.solver = ContactSolver::coupled;
  const Bodies field = make_field(scene);
  const auto cpu = make_engine(scene, field, {"cpu", 1});
  StepLog expected, log;
  cpu->advance(367, expected);
  HostScene device(scene, field, 2, test::team_warp, 0, bodies_shared_bytes);
  device.use_phases();
  device.restore(cpu->save());
  expected.clear();
  cpu->advance(1, expected);
  device.advance(1, log);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  EXPECT_GT(expected.quality.back().iterations, 0);
}

}  // namespace
}  // namespace gem
