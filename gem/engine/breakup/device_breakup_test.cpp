// Floes split on a device scene, run by host threads, as on the cpu engine: the same bits, pieces, loads and forces.
#include <gtest/gtest.h>

#include <tuple>

#include "gem/engine/breakup/breakup_engine.h"
#include "gem/engine/testing/host_engine.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

struct DeviceRun {
  std::unique_ptr<Engine> engine;
  test::HostScene* scene;

  DeviceRun(const SceneDef& def, bool phases, int blocks = 1) {
    auto host = std::make_unique<test::HostEngine>(def, test::busy_field(def), blocks,
                                                   phases || blocks > 1 ? test::team_warp : 1);
    scene = &host->scene();
    if (phases) scene->use_phases();
    engine = std::move(host);
    if (def.breakup.maximum_pieces > 0) engine = std::make_unique<BreakupEngine>(def, std::move(engine));
  }
};

SceneDef breaking_scene(ContactSolver solver, Iteration iteration = Iteration::gradient) {
  SceneDef scene = test::breaking_scene(5);
  scene.contact.solver = solver;
  return test::iterated_by(std::move(scene), iteration);
}

void expect_same_state(DeviceRun& device, Engine& cpu, const StepLog& log, const StepLog& expected) {
  test::expect_same_bodies(device.engine->bodies(), cpu.bodies());
  test::expect_same_log(log, expected);
  test::expect_same_splits(log, expected);
  test::expect_same_forces(device.engine->contact_forces(), cpu.contact_forces());
  const EngineState state = device.engine->save(), wanted = cpu.save();
  test::expect_same_memory(state, wanted);
  test::expect_same_loads(state.loads, wanted.loads);
  test::expect_same_books(device.engine->ledger(), cpu.ledger());
}

struct BreakupRoute {
  const char* name;
  ContactSolver solver;
  Iteration iteration;
  bool phases;
};

class DeviceBreakup : public testing::TestWithParam<BreakupRoute> {
 protected:
  SceneDef scene_ = breaking_scene(GetParam().solver, GetParam().iteration);
  std::unique_ptr<Engine> cpu_ = test::busy_engine(scene_, "cpu");
  StepLog expected_, log_;

  /// Calls end within halves of the load time and at their ends.
  void expect_same_run(DeviceRun& device, const std::vector<std::int64_t>& calls) {
    for (const std::int64_t steps : calls) {
      cpu_->advance(steps, expected_);
      device.engine->advance(steps, log_);
      expect_same_state(device, *cpu_, log_, expected_);
      if (HasFailure()) return;
    }
  }
};

TEST_P(DeviceBreakup, MakesThePiecesOfTheCpuEngine) {
  DeviceRun device(scene_, GetParam().phases);
  expect_same_run(device, {1, 6, 15});
  const std::int64_t early = test::splits_in(expected_);
  EXPECT_GT(early, 3);
  const EngineState state = device.engine->save();
  device.engine->restore(state);
  cpu_->restore(state);
  expect_same_run(device, {20});
  EXPECT_GT(test::splits_in(expected_), early + 1) << "pieces go on, and others split";
  EXPECT_EQ(device.scene->short_calls(), 0);
}

TEST_P(DeviceBreakup, AFullRingOfForcesEndsACallButLosesNone) {
  DeviceRun device(scene_, GetParam().phases);
  device.scene->shorten_forces();
  expect_same_run(device, {30});
  EXPECT_GT(device.scene->short_calls(), 3);
  EXPECT_GT(test::splits_in(expected_), 3);
}

constexpr BreakupRoute breakup_routes[] = {
    {"independent", ContactSolver::independent, Iteration::gradient, false},
    {"coupled", ContactSolver::coupled, Iteration::gradient, false},
    {"independent_phases", ContactSolver::independent, Iteration::gradient, true},
    {"coupled_phases", ContactSolver::coupled, Iteration::gradient, true},
    {"splitting_phases", ContactSolver::coupled, Iteration::splitting, true}};

std::string route_name(const testing::TestParamInfo<BreakupRoute>& route) { return route.param.name; }

INSTANTIATE_TEST_SUITE_P(Routes, DeviceBreakup, testing::ValuesIn(breakup_routes), route_name);

TEST(DeviceForces, OfSeveralBlocksAreThoseOfTheCpuEngine) {
  const SceneDef scene = breaking_scene(ContactSolver::coupled);
  const auto cpu = test::busy_engine(scene, "cpu");
  DeviceRun device(scene, false, 3);
  StepLog expected, log;
  cpu->advance(21, expected);
  device.engine->advance(21, log);
  expect_same_state(device, *cpu, log, expected);
  EXPECT_GT(test::splits_in(expected), 0);
}

/// Without floes that split only the last time step of a call is recorded.
TEST(DeviceForces, AreThoseOfTheLastTimeStep) {
  for (const bool phases : {false, true}) {
    SceneDef scene = test::busy_scene(5);
    scene.output.contact_forces = true;
    const auto cpu = test::busy_engine(scene, "cpu");
    DeviceRun device(scene, phases);
    StepLog expected, log;
    EXPECT_TRUE(device.engine->contact_forces().empty());
    for (const std::int64_t steps : {1, 39, 20}) {
      cpu->advance(steps, expected);
      device.engine->advance(steps, log);
      test::expect_same_forces(device.engine->contact_forces(), cpu->contact_forces());
    }
    EXPECT_GT(cpu->contact_forces().size(), 10U);
    EXPECT_TRUE(log.forces.empty());
    device.engine->restore(device.engine->save());
    EXPECT_TRUE(device.engine->contact_forces().empty());
  }
}

}  // namespace
}  // namespace gem
