// Floes split on the GPU as on the cpu engine: the same bits, pieces, loads, forces and books, by both routes, in a
// batch beside a scene without splitting.
#include <gtest/gtest.h>

#include <memory>
#include <ostream>
#include <vector>

#include "gem/engine/engine_batch.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"
#include "validation/agreement/on_gpu.h"

namespace gem {
namespace {

struct Kind {
  ContactSolver solver;
  Iteration iteration;
};

void PrintTo(const Kind& kind, std::ostream* out) {
  const bool splitting = kind.iteration == Iteration::splitting;
  *out << (kind.solver == ContactSolver::independent ? "independent" : splitting ? "splitting" : "gradient");
}

SceneDef of_kind(SceneDef scene, const Kind& kind) {
  scene.contact.solver = kind.solver;
  return test::iterated_by(std::move(scene), kind.iteration);
}

void expect_same_engine(Engine& cuda, const StepLog& log, Engine& cpu, const StepLog& expected) {
  EXPECT_EQ(cuda.state_hash(), cpu.state_hash());
  test::expect_same_bodies(cuda.bodies(), cpu.bodies());
  test::expect_same_log(log, expected);
  test::expect_same_splits(log, expected);
  test::expect_same_books(cuda.ledger(), cpu.ledger());
  test::expect_same_forces(cuda.contact_forces(), cpu.contact_forces());
  const EngineState state = cuda.save(), wanted = cpu.save();
  test::expect_same_memory(state, wanted);
  test::expect_same_loads(state.loads, wanted.loads);
}

class CudaBreakup : public OnGpu, public testing::WithParamInterface<Kind> {
 protected:
  SceneDef breaking_ = of_kind(test::breaking_scene(5), GetParam());
};

/// One scene: the resident route, but for operator splitting. Then both engines go on from the same checkpoint, within
/// a half of the load time.
TEST_P(CudaBreakup, GivesTheBitsOfTheCpuAndGoesOnFromACheckpoint) {
  const auto cpu = test::busy_engine(breaking_, "cpu"), cuda = test::busy_engine(breaking_, "cuda");
  StepLog expected, log;
  for (const std::int64_t steps : {1, 6, 35}) {
    cpu->advance(steps, expected);
    cuda->advance(steps, log);
    expect_same_engine(*cuda, log, *cpu, expected);
    if (HasFailure()) return;
  }
  const std::int64_t early = test::splits_in(expected);
  EXPECT_GT(early, 3);
  const EngineState half = cpu->save();
  const auto again = make_engine(breaking_, half.bodies, {"cuda"});
  again->restore(half);
  cpu->restore(half);
  cpu->advance(101, expected);
  again->advance(101, log);
  expect_same_engine(*again, log, *cpu, expected);
  EXPECT_GT(test::splits_in(expected), early + 3) << "pieces go on, and others split";
}

/// Scenes in turn: their floes split, or not at all. Each is as on the cpu engine.
TEST_P(CudaBreakup, GivesTheBitsOfTheCpuInABatch) {
  for (const std::size_t count : {2, 40}) {
    const SceneDef whole = of_kind(test::busy_scene(5), GetParam());
    std::vector<BatchScene> scenes;
    for (std::size_t k = 0; k < count; ++k) {
      const SceneDef& scene = k % 2 == 0 ? breaking_ : whole;
      scenes.push_back({scene, test::busy_field(scene)});
    }
    const auto batch = make_engine_batch(scenes, {"cuda"});
    std::vector<StepLog> logs(count);
    std::vector<StepsAhead> ahead(count, {60, 60});
    for (bool all = false; !all;) {
      for (const std::exception_ptr& fault : batch->advance(ahead, logs)) ASSERT_FALSE(fault);
      all = true;
      for (std::size_t k = 0; k < count; ++k) {
        ahead[k].most = ahead[k].all = 60 - batch->engine(k).step();
        all = all && ahead[k].most == 0;
      }
    }
    const auto split = test::busy_engine(breaking_, "cpu"), not_split = test::busy_engine(whole, "cpu");
    StepLog expected, expected_whole;
    split->advance(60, expected);
    not_split->advance(60, expected_whole);
    EXPECT_GT(test::splits_in(expected), 10);
    for (std::size_t k = 0; k < count; ++k) {
      Engine& made = batch->engine(k);
      if (k % 2 == 0) {
        expect_same_engine(made, logs[k], *split, expected);
      } else {
        EXPECT_EQ(made.state_hash(), not_split->state_hash()) << "place " << k;
        test::expect_same_log(logs[k], expected_whole);
        EXPECT_TRUE(logs[k].splits.empty() && logs[k].forces.empty());
      }
      if (HasFailure()) return;
    }
  }
}

/// Calls of any length record the forces of their last time step; the scene runs on both routes.
TEST_P(CudaBreakup, ForcesOfTheLastTimeStepAreThoseOfTheCpu) {
  SceneDef scene = of_kind(test::busy_scene(5), GetParam());
  scene.output.contact_forces = true;
  for (const Route route : {Route::resident, Route::phases}) {
    if (route == Route::resident && scene.numerics.iteration == Iteration::splitting) continue;
    const auto cpu = test::busy_engine(scene, "cpu");
    CudaBatch batch({{scene, test::busy_field(scene)}}, {.route = route});
    StepLog expected;
    std::vector<StepLog> logs(1);
    for (const std::int64_t steps : {1, 39, 20}) {
      cpu->advance(steps, expected);
      batch.advance(steps, &logs);
      test::expect_same_forces(batch.contact_forces(0), cpu->contact_forces());
    }
    EXPECT_GT(cpu->contact_forces().size(), 10U);
    EXPECT_EQ(batch.state_hash(0), cpu->state_hash());
  }
}

/// Every force of every time step, by both routes, in calls that a short ring of samples ends early.
TEST_P(CudaBreakup, ForcesOfAllTimeStepsAreThoseOfTheCpu) {
  const SceneDef& scene = breaking_;
  for (const Route route : {Route::resident, Route::phases}) {
    if (route == Route::resident && scene.numerics.iteration == Iteration::splitting) continue;
    SceneDef whole = scene;
    whole.breakup.maximum_pieces = 0;
    const Bodies field = test::busy_field(scene);
    const auto cpu = make_engine(whole, field, {"cpu", 1});
    CudaBatch batch({{scene, field}}, {.ring_steps = 7, .route = route});
    StepLog expected;
    std::vector<StepLog> logs(1);
    expected.wants_forces = logs[0].wants_forces = true;
    cpu->advance(40, expected);
    batch.advance(40, &logs);
    ASSERT_EQ(logs[0].forces.size(), expected.forces.size());
    EXPECT_GT(expected.forces.size(), 100U);
    for (std::size_t k = 0; k < expected.forces.size(); ++k) {
      const StepForce &p = logs[0].forces[k], &q = expected.forces[k];
      ASSERT_EQ(p.step, q.step);
      test::expect_same_forces({p.force}, {q.force});
      ASSERT_TRUE(test::same(p.arm_a, q.arm_a) && test::same(p.arm_b, q.arm_b)) << "force " << k;
      if (HasFailure()) return;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, CudaBreakup,
                         testing::Values(Kind{ContactSolver::independent, Iteration::gradient},
                                         Kind{ContactSolver::coupled, Iteration::gradient},
                                         Kind{ContactSolver::coupled, Iteration::splitting}),
                         testing::PrintToStringParamName());

}  // namespace
}  // namespace gem
