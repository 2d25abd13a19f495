// The cuda engine gives the bits of the cpu engine for every law, by both routes. It also reports faults.
#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "gem/engine/device/scene_image.h"
#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"
#include "validation/agreement/on_gpu.h"

namespace gem {
namespace {

using Laws = std::tuple<ContactSolver, Manifold, Yaw, FrictionLaw, DragLaw>;

class CudaLaws : public OnGpu, public testing::WithParamInterface<Laws> {};

TEST_P(CudaLaws, GiveTheBitsOfTheCpu) {
  SceneDef scene = test::busy_scene(8);
  std::tie(scene.contact.solver, scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law,
           scene.water.drag_law) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu"), cuda = test::busy_engine(scene, "cuda");
  StepLog expected, log;
  for (int block = 0; block < 8; ++block) {
    cpu->advance(50, expected);
    cuda->advance(50, log);
    test::expect_same_bodies(cuda->bodies(), cpu->bodies());
    test::expect_same_log(log, expected);
    if (scene.contact.solver == ContactSolver::coupled) test::expect_same_judgement(log, expected);
    if (HasFailure()) return;
  }
  EXPECT_EQ(cuda->state_hash(), cpu->state_hash());
  test::expect_same_books(cuda->ledger(), cpu->ledger());
  EXPECT_GT(test::contacts_in(expected), 5000);
  EXPECT_GT(expected.events.size(), 2u);
}

INSTANTIATE_TEST_SUITE_P(Combinations, CudaLaws,
                         testing::Combine(testing::Values(ContactSolver::independent, ContactSolver::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic, DragLaw::linear, DragLaw::none)),
                         test::LawNames());

/// Scenes that are advanced by one launch per phase.
class CudaPhases : public CudaLaws {};

TEST_P(CudaPhases, GiveTheBitsOfTheCpu) {
  SceneDef scene = test::busy_scene(8);
  std::tie(scene.contact.solver, scene.contact.manifold, scene.platform.yaw, scene.contact.friction_law,
           scene.water.drag_law) = GetParam();
  const auto cpu = test::busy_engine(scene, "cpu");
  CudaBatch batch({{scene, test::busy_field(scene)}, {scene, test::busy_field(scene)}}, {.route = Route::phases});
  StepLog expected;
  std::vector<StepLog> logs(2);
  for (int call = 0; call < 8; ++call) {
    cpu->advance(50, expected);
    batch.advance(50, &logs);
  }
  EXPECT_EQ(batch.route(), Route::phases);
  for (const std::size_t k : {0, 1}) {
    test::expect_same_bodies(batch.bodies(k), cpu->bodies());
    test::expect_same_log(logs[k], expected);
    test::expect_same_books(batch.ledger(k), cpu->ledger());
    EXPECT_EQ(batch.state_hash(k), cpu->state_hash());
  }
  EXPECT_GT(test::contacts_in(expected), 5000);
  EXPECT_GT(expected.events.size(), 2u);
}

/// Current and wind that change in every time step, by both routes, in calls and batches of several lengths.
class CudaDrive : public OnGpu, public testing::WithParamInterface<ContactSolver> {};

TEST_P(CudaDrive, GivesTheBitsOfTheCpu) {
  SceneDef scene = test::driven_scene(8), other = test::busy_scene(9);
  scene.contact.solver = other.contact.solver = GetParam();
  for (const Route route : {Route::resident, Route::phases}) {
    const auto cpu = test::busy_engine(scene, "cpu"), steady = test::busy_engine(other, "cpu");
    CudaBatch batch({{scene, test::busy_field(scene)}, {other, test::busy_field(other)}}, {.route = route});
    StepLog expected, ignored;
    std::vector<StepLog> logs(2);
    for (const std::int64_t steps : {1, 7, 150}) {
      cpu->advance(steps, expected);
      steady->advance(steps, ignored);
      batch.advance(steps, &logs);
    }
    EXPECT_EQ(batch.route(), route);
    EXPECT_EQ(batch.state_hash(0), cpu->state_hash());
    EXPECT_EQ(batch.state_hash(1), steady->state_hash()) << "beside a scene with a steady drive";
    test::expect_same_log(logs[0], expected);
    test::expect_same_books(batch.ledger(0), cpu->ledger());
    EXPECT_GT(test::contacts_in(expected), 1000);

    const EngineState half = batch.save(0);
    cpu->restore(half);
    batch.restore(0, half);
    cpu->advance(40, expected);
    batch.advance(40, &logs);
    EXPECT_EQ(batch.state_hash(0), cpu->state_hash()) << "after a restart";
  }
}

/// A scene on a route of the GPU, and the same on the cpu engine.
struct BesideCpu {
  std::unique_ptr<Engine> cpu;
  CudaBatch cuda;
  StepLog expected;
  std::vector<StepLog> logs{1};

  BesideCpu(const SceneDef& scene, Route route)
      : cpu(test::busy_engine(scene, "cpu")), cuda({{scene, test::busy_field(scene)}}, {.route = route}) {}

  void advance(std::initializer_list<std::int64_t> calls) {
    for (const std::int64_t steps : calls) {
      cpu->advance(steps, expected);
      cuda.advance(steps, &logs);
    }
  }
  void expect_same() {
    EXPECT_EQ(cuda.state_hash(0), cpu->state_hash());
    test::expect_same_log(logs[0], expected);
    test::expect_same_books(cuda.ledger(0), cpu->ledger());
    EXPECT_GT(test::ice_impulse_in(expected), 0.0) << "ice hits the platform";
  }
};

TEST_P(CudaDrive, MooringsOfTablesAndOfLinesThatBreakGiveTheBitsOfTheCpuEngine) {
  for (SceneDef scene : {test::moored_scene(8), test::lines_scene(8)}) {
    scene.contact.solver = GetParam();
    for (const Route route : {Route::resident, Route::phases}) {
      BesideCpu both(scene, route);
      both.advance({150});
      both.expect_same();
      EXPECT_EQ(both.cuda.broken_lines(0), both.cpu->broken_lines());
    }
  }
}

TEST_P(CudaDrive, AShipInTransitHasTheBitsOfTheCpuEngine) {
  for (SceneDef scene : {test::transit_scene(8), test::free_ship_scene(8)}) {
    scene.contact.solver = GetParam();
    for (const Route route : {Route::resident, Route::phases}) {
      BesideCpu both(scene, route);
      both.advance({1, 7, 150});
      both.expect_same();
    }
  }
}

TEST_P(CudaDrive, DynamicPositioningGivesTheBitsOfTheCpuEngine) {
  SceneDef scene = test::dp_scene(8);
  scene.contact.solver = GetParam();
  for (const Route route : {Route::resident, Route::phases}) {
    BesideCpu both(scene, route);
    both.advance({1, 7, 150});
    both.expect_same();
    EXPECT_EQ(both.expected.dp.size(), 158U);

    const EngineState half = both.cuda.save(0);
    both.cpu->restore(half);
    both.cuda.restore(0, half);
    both.advance({40});
    both.expect_same();
  }
}

INSTANTIATE_TEST_SUITE_P(Solvers, CudaDrive, testing::Values(ContactSolver::independent, ContactSolver::coupled),
                         test::LawNames());

/// A ship with heading control, a fixed one, one with water drag by axis, and one with added mass, by both routes.
class CudaShip : public OnGpu, public testing::WithParamInterface<ContactSolver> {};

TEST_P(CudaShip, GivesTheBitsOfTheCpu) {
  for (SceneDef scene : {test::ship_scene(8, false), test::ship_scene(8, true), test::dragged_ship_scene(8),
                         test::ship_scene_with_added_mass(8)})
    for (const Route route : {Route::resident, Route::phases}) {
      scene.contact.solver = GetParam();
      BesideCpu both(scene, route);
      both.advance({1, 7, 292});
      both.expect_same();
    }
}

INSTANTIATE_TEST_SUITE_P(Solvers, CudaShip, testing::Values(ContactSolver::independent, ContactSolver::coupled),
                         test::LawNames());

using CudaPhasesBriefly = OnGpu;

/// Few time steps, with contacts, so that compute-sanitizer's racecheck can run them. Two scenes at different times of
/// their runs share the device.
TEST_F(CudaPhasesBriefly, GiveTheBitsOfTheCpu) {
  for (const ContactSolver solver : {ContactSolver::independent, ContactSolver::coupled}) {
    SceneDef scene = test::busy_scene(8);
    scene.contact.solver = solver;
    CudaBatch batch({{scene, test::busy_field(scene)}, {scene, test::busy_field(scene)}}, {.route = Route::phases});
    const auto cpu = test::busy_engine(scene, "cpu");
    std::vector<StepLog> expected(2), logs(2);
    std::vector<std::uint64_t> hash;
    std::vector<Ledger> books;
    for (const std::size_t k : {0, 1}) {
      StepLog before;
      cpu->advance(80, before);
      const EngineState start = cpu->save();
      batch.restore(k, start);
      cpu->restore(start);  // so that both engines continue with the same sums in the books
      cpu->advance(3, expected[k]);
      hash.push_back(cpu->state_hash());
      books.push_back(cpu->ledger());
      EXPECT_GT(test::contacts_in(expected[k]), 50);
    }
    batch.advance(3, &logs);
    EXPECT_EQ(batch.route(), Route::phases);
    for (const std::size_t k : {0, 1}) {
      EXPECT_EQ(batch.state_hash(k), hash[k]) << "scene " << k;
      test::expect_same_log(logs[k], expected[k]);
      if (solver == ContactSolver::coupled) test::expect_same_judgement(logs[k], expected[k]);
      test::expect_same_books(batch.ledger(k), books[k]);
    }
  }
}

TEST_F(OnGpu, RoundsOfATightResidualAreMadeToTheirEnd) {
  SceneDef scene = test::busy_scene(8);
  scene.numerics.residual_tolerance = 1e-9;
  scene.numerics.iterations_maximum = 200;
  const auto cpu = test::busy_engine(scene, "cpu");
  StepLog expected;
  cpu->advance(40, expected);
  for (const Route route : {Route::resident, Route::phases}) {
    CudaBatch batch({{scene, test::busy_field(scene)}}, {.route = route});
    std::vector<StepLog> logs(1);
    batch.advance(40, &logs);
    EXPECT_EQ(batch.route(), route);
    EXPECT_EQ(batch.state_hash(0), cpu->state_hash());
    test::expect_same_log(logs[0], expected);
    test::expect_same_judgement(logs[0], expected);
  }
  int longest = 0;
  for (const StepQuality& quality : expected.quality) longest = std::max(longest, int(quality.iterations));
  EXPECT_GT(longest, 64) << "no time step took three rounds";
}

INSTANTIATE_TEST_SUITE_P(Combinations, CudaPhases,
                         testing::Combine(testing::Values(ContactSolver::independent, ContactSolver::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends),
                                          testing::Values(Yaw::free, Yaw::locked),
                                          testing::Values(FrictionLaw::one_step, FrictionLaw::fixed_direction),
                                          testing::Values(DragLaw::quadratic, DragLaw::linear, DragLaw::none)),
                         test::LawNames());

TEST_F(OnGpu, AStateThatIsNoNumberStopsTheRun) {
  const SceneDef scene = test::busy_scene(12);
  const auto engine = test::busy_engine(scene, "cuda");
  StepLog log;
  engine->advance(3, log);
  EngineState state = engine->save();
  state.bodies.position[20].x = 1e308;
  state.bodies.velocity[20].x = -1e308;
  engine->restore(state);
  try {
    engine->advance(10, log);
    ADD_FAILURE() << "went on";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::numerical_stop) << error.what();
  }
}

TEST_F(OnGpu, ARunThatItCannotCountIsRefused) {
  const auto expect_refused = [](const auto& run) {
    try {
      run();
      ADD_FAILURE() << "went on";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage) << error.what();
    }
  };
  SceneDef scene = test::busy_scene(12);
  const auto engine = test::busy_engine(scene, "cuda");
  EngineState state = engine->save();
  state.step = device_steps_maximum - 10;
  engine->restore(state);
  StepLog log;
  engine->advance(10, log);
  EXPECT_EQ(engine->step(), device_steps_maximum);
  expect_refused([&] { engine->advance(1, log); });
  EXPECT_EQ(engine->step(), device_steps_maximum);
  scene.run.duration_s = (device_steps_maximum + 1) * scene.numerics.time_step_s;
  expect_refused([&] { test::busy_engine(scene, "cuda"); });
}

class OneOfABatch : public OnGpu, public testing::WithParamInterface<Route> {};

TEST_P(OneOfABatch, ThatFailsOnTheGpuStopsNoOther) {
  SceneDef scene = test::busy_scene(12);
  CudaBatch batch(std::vector<BatchScene>(4, {scene, test::busy_field(scene)}), {.route = GetParam()});
  EngineState overflows = batch.save(0), no_number = overflows;
  overflows.bodies.position[20].x = 1e308;
  overflows.bodies.velocity[20].x = -1e308;
  no_number.bodies.velocity[20].x = std::numeric_limits<double>::quiet_NaN();
  batch.restore(1, overflows);
  batch.restore(2, no_number);
  std::vector<StepLog> logs(4);
  const auto faults = batch.advance_some(std::vector<StepsAhead>(4, {10, 10}), logs);
  EXPECT_TRUE(faults[1] && faults[2]);
  EXPECT_EQ(batch.step(2), 0);
  const auto cpu = test::busy_engine(scene, "cpu");
  StepLog log;
  cpu->advance(10, log);
  for (const std::size_t k : {0, 3}) {
    EXPECT_EQ(faults[k], nullptr) << "place " << k;
    EXPECT_EQ(batch.state_hash(k), cpu->state_hash()) << "place " << k;
    EXPECT_EQ(logs[k].platform.size(), 10u);
  }
}

INSTANTIATE_TEST_SUITE_P(Routes, OneOfABatch, testing::Values(Route::resident, Route::phases),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace gem
