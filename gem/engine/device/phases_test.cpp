// Time steps made phase by phase give the bits, the books and the log of the cpu engine.
#include "gem/engine/device/phases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <tuple>

#include "gem/engine/testing/host_scene.h"
#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

using test::HostScene;
using Choice = std::tuple<ContactSolver, Manifold, Yaw, FrictionLaw, DragLaw>;

SceneDef scene_of(ContactSolver solver) {
  SceneDef scene = test::busy_scene(7);
  scene.contact.solver = solver;
  return scene;
}

HostScene phase_scene(const SceneDef& scene, const Bodies& field, int blocks, int threads, std::int32_t rows = 0,
                      std::size_t solver_shared_memory = 1 << 20) {
  HostScene device(scene, field, blocks, threads, rows, bodies_shared_bytes);
  device.use_phases(solver_shared_memory);
  return device;
}

class DevicePhases : public testing::TestWithParam<Choice> {};

TEST_P(DevicePhases, GiveTheBitsOfTheCpuEngine) {
  SceneDef scene = test::busy_scene(7);
  std::tie(scene.contact.solver, scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law,
           scene.water.drag_law) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device = phase_scene(scene, test::busy_field(scene), 1, test::team_warp);
  StepLog expected, log;
  for (int call = 0; call < 3; ++call) {
    cpu->advance(40, expected);
    device.advance(40, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    if (HasFailure()) return;
  }
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  if (scene.contact.solver == ContactSolver::coupled) {
    test::expect_same_coupled(device, log, *cpu, expected);
  }
  EXPECT_GT(test::contacts_in(expected), 1000);
  EXPECT_GT(device.status().builds, 2);
  EXPECT_GT(device.asleep(), 0) << "no pair ever slept";
}

INSTANTIATE_TEST_SUITE_P(Coupled, DevicePhases,
                         testing::Combine(testing::Values(ContactSolver::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic)),
                         test::LawNames());

INSTANTIATE_TEST_SUITE_P(Independent, DevicePhases,
                         testing::Combine(testing::Values(ContactSolver::independent),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic)),
                         test::LawNames());

TEST(DeviceDrive, GivesTheBitsOfTheCpuEngineOnBothRoutes) {
  for (const bool phases : {false, true})
    for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled}) {
      SceneDef scene = test::driven_scene(7);
      scene.contact.solver = solver;
      const auto cpu = test::busy_engine(scene, "cpu", 2);
      HostScene device(scene, test::busy_field(scene), 1, phases ? test::team_warp : 1, 0, bodies_shared_bytes);
      if (phases) device.use_phases();
      StepLog expected, log;
      for (const std::int64_t steps : {1, 39}) {
        cpu->advance(steps, expected);
        device.advance(steps, log);
        test::expect_same_bodies(device.bodies(), cpu->bodies());
        test::expect_same_log(log, expected);
        if (HasFailure()) return;
      }
      test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
      EXPECT_GT(test::contacts_in(expected), 300);
    }
}

TEST(DeviceShip, GivesTheBitsOfTheCpuEngineOnBothRoutes) {
  for (const bool phases : {false, true})
    for (SceneDef scene : {test::ship_scene(7, false), test::ship_scene(7, true), test::dragged_ship_scene(7),
                           test::ship_scene_with_added_mass(7)})
      for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled}) {
        scene.contact.solver = solver;
        const auto cpu = test::busy_engine(scene, "cpu", 2);
        HostScene device(scene, test::busy_field(scene), 1, phases ? test::team_warp : 1, 0, bodies_shared_bytes);
        if (phases) device.use_phases();
        StepLog expected, log;
        for (const std::int64_t steps : {1, 129}) {
          cpu->advance(steps, expected);
          device.advance(steps, log);
          test::expect_same_bodies(device.bodies(), cpu->bodies());
          test::expect_same_log(log, expected);
          if (HasFailure()) return;
        }
        test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
        double felt = 0.0;
        for (const PlatformStep& step : expected.platform) felt += length(step.ice_impulse);
        EXPECT_GT(felt, 0.0);
      }
}

class DeviceStages : public testing::TestWithParam<ContactSolver> {};

TEST_P(DeviceStages, BlocksAndThreadsChangeNothing) {
  constexpr std::int64_t steps = 30;
  const SceneDef scene = scene_of(GetParam());
  const auto cpu = test::busy_engine(scene, "cpu");
  StepLog expected;
  cpu->advance(steps, expected);
  EXPECT_GT(test::contacts_in(expected), 50);
  for (const auto& [blocks, threads] : {std::pair{1, 8}, {2, 4}, {3, 8}}) {
    HostScene device = phase_scene(scene, test::busy_field(scene), blocks, threads);
    StepLog log;
    device.advance(steps, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
    EXPECT_GT(device.status().builds, 1);
    EXPECT_GT(device.asleep(), 0);
  }
}

TEST_P(DeviceStages, TakesTurnsWithWholeTimeSteps) {
  const SceneDef scene = scene_of(GetParam());
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device = phase_scene(scene, test::busy_field(scene), 1, test::team_warp);
  StepLog expected, log;
  int survived = 0;  // lists with sleeping pairs that outlive the whole time steps of a call
  const int calls = GetParam() == ContactSolver::coupled ? 24 : 60;
  for (int call = 0; call < calls; ++call) {
    const bool phases = call % 2 == 0;
    const std::int64_t steps = phases ? 2 : 8;  // long enough for sleeping pairs to meet
    cpu->advance(steps, expected);
    const auto builds = device.status().builds;
    const bool slept = call > 0 && device.asleep() > 0;
    if (phases)
      device.use_phases();
    else
      device.use_resident();
    device.advance(steps, log);
    if (!phases && slept && device.status().builds == builds) ++survived;
  }
  EXPECT_GT(survived, 0);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  test::expect_same_books(device.ledger(cpu->ledger()), cpu->ledger());
  EXPECT_GT(test::contacts_in(expected), 500);
}

TEST_P(DeviceStages, OfAListTooSmallGrowsItAndLosesNothing) {
  const SceneDef scene = scene_of(GetParam());
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device = phase_scene(scene, test::busy_field(scene), 1, test::team_warp, 40);
  StepLog expected, log;
  cpu->advance(60, expected);
  device.advance(60, log);
  EXPECT_GT(device.growths(), 0);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
}

TEST_P(DeviceStages, StopsAtAStateThatIsNoNumber) {
  const SceneDef scene = scene_of(GetParam());
  Bodies field = test::busy_field(scene);
  field.position[20].x = 1e308;
  field.velocity[20].x = -1e308;
  HostScene device = phase_scene(scene, field, 1, test::team_warp);
  StepLog log;
  device.advance(10, log);
  EXPECT_EQ(device.status().stop, DeviceStop::not_finite);
  EXPECT_LT(device.status().samples, 10);
}

/// Which data of the iterations fit in shared memory.
enum class Fits { all, records, some_records, nothing };

TEST(DevicePhaseSharedMemory, ForLittleThatIteratesChangesNothing) {
  constexpr std::int64_t steps = 60;
  const SceneDef scene = scene_of(ContactSolver::coupled);
  const auto cpu = test::busy_engine(scene, "cpu");
  StepLog expected;
  cpu->advance(steps, expected);
  for (const auto& [shared_memory, fits] : {std::pair<std::size_t, Fits>{1 << 20, Fits::all},
                                            {10 * 1024, Fits::records},
                                            {4 * 1024, Fits::some_records},
                                            {256, Fits::nothing}}) {
    HostScene device = phase_scene(scene, test::busy_field(scene), 2, test::team_warp, 0, shared_memory);
    StepLog log;
    device.advance(steps, log);
    test::expect_same_bodies(device.bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    test::expect_same_judgement(log, expected);
    const SolverWorkspace& workspace = device.solver_workspace(0);
    const std::size_t records = static_cast<std::size_t>(workspace.records) * sizeof(PushRecord) +
                                static_cast<std::size_t>(workspace.own.count()) * sizeof(SolverEntry);
    const std::size_t points = static_cast<std::size_t>(workspace.points.count()) * loaded_bytes;
    const Fits seen = !workspace.fits                    ? Fits::nothing
                      : records > shared_memory          ? Fits::some_records
                      : records + points > shared_memory ? Fits::records
                                                         : Fits::all;
    EXPECT_EQ(seen, fits) << shared_memory << " bytes; " << records << " of records, " << points << " of points";
  }
}

TEST(DevicePhaseRounds, OfATightResidualAreMadeToTheirEnd) {
  SceneDef scene = scene_of(ContactSolver::coupled);
  scene.numerics.residual_tolerance = 1e-9;
  scene.numerics.iterations_maximum = 200;
  const auto cpu = test::busy_engine(scene, "cpu");
  HostScene device = phase_scene(scene, test::busy_field(scene), 1, test::team_warp);
  StepLog expected, log;
  cpu->advance(12, expected);
  device.advance(12, log);
  test::expect_same_bodies(device.bodies(), cpu->bodies());
  test::expect_same_log(log, expected);
  test::expect_same_judgement(log, expected);
  const auto most = std::max_element(log.quality.begin(), log.quality.end(),
                                     [](const auto& a, const auto& b) { return a.iterations < b.iterations; });
  EXPECT_GT(most->iterations, 64) << "no time step took three rounds";
}

INSTANTIATE_TEST_SUITE_P(Solvers, DeviceStages, testing::Values(ContactSolver::independent, ContactSolver::coupled),
                         test::LawNames());

}  // namespace
}  // namespace gem
