// Operator splitting on the GPU gives the bits of the cpu engine: in a jam, in any batch, beside scenes with the other
// iteration.
#include <gtest/gtest.h>

#include <vector>

#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"
#include "validation/agreement/jam.h"
#include "validation/agreement/on_gpu.h"

namespace gem {
namespace {

SceneDef with_splitting(SceneDef scene, double time_step) {
  scene.numerics.iteration = Iteration::splitting;
  scene.numerics.iterations_maximum = 96;
  scene.numerics.time_step_s = time_step;
  return scene;
}

/// A scene, its state at the start, and what the cpu engine makes of it.
struct Expected {
  SceneDef scene;
  Bodies field;
  EngineState start;
  StepLog log;
  std::uint64_t hash = 0;
  Ledger ledger;
  EngineState end;

  Expected(const SceneDef& def, Bodies bodies, EngineState state, std::int64_t steps)
      : scene(def), field(std::move(bodies)), start(std::move(state)) {
    const auto cpu = make_engine(scene, field, agreement::on("cpu"));
    cpu->restore(start);
    cpu->advance(steps, log);
    hash = cpu->state_hash();
    ledger = cpu->ledger();
    end = cpu->save();
  }

  void expect_same(CudaBatch& batch, std::size_t k, const StepLog& made) const {
    EXPECT_EQ(batch.state_hash(k), hash) << "place " << k;
    test::expect_same_log(made, log);
    test::expect_same_judgement(made, log);
    test::expect_same_books(batch.ledger(k), ledger);
    test::expect_same_memory(batch.save(k), end);
  }
};

/// The jam of 1,234 floes, most of them in one island.
Expected jam_with_splitting(double time_step, std::int64_t steps) {
  const SceneDef before = agreement::jam_scene(ContactSolver::coupled);
  const Bodies field = agreement::drifting_field(before);
  return {with_splitting(before, time_step), field, agreement::jam(before, field), steps};
}

/// 150 floes: small islands, fixed walls, friction, a retire line.
Expected busy_with_splitting(std::int64_t steps) {
  const SceneDef scene = with_splitting(test::busy_scene(7), 0.2);
  const Bodies field = test::busy_field(scene);
  return {scene, field, make_engine(scene, field, agreement::on("cpu"))->save(), steps};
}

class CudaSplitting : public OnGpu {};

TEST_F(CudaSplitting, GivesTheBitsOfTheCpuInAJam) {
  for (const double time_step : {0.05, 0.2}) {
    const Expected jam = jam_with_splitting(time_step, 20);
    for (const StepQuality& quality : jam.log.quality) ASSERT_GT(quality.contacts, agreement::contacts_wanted);
    CudaBatch batch({{jam.scene, jam.field}}, {.ring_steps = 7});
    batch.restore(0, jam.start);
    std::vector<StepLog> logs(1);
    batch.advance(20, &logs);
    EXPECT_EQ(batch.route(), Route::phases);
    jam.expect_same(batch, 0, logs[0]);
  }
}

TEST_F(CudaSplitting, GivesTheBitsOfTheCpuInAnyBatch) {
  constexpr std::int64_t steps = 12;
  const Expected jam = jam_with_splitting(0.2, steps), busy = busy_with_splitting(steps);
  const SceneDef other = agreement::jam_scene(ContactSolver::coupled);
  std::vector<BatchScene> scenes;
  for (int k = 0; k < 40; ++k) {
    const Expected& one = k % 2 == 0 ? busy : jam;
    scenes.push_back({one.scene, one.field});
  }
  scenes.push_back({other, jam.field});
  CudaBatch batch(scenes, {});
  for (std::size_t k = 0; k < 40; ++k) batch.restore(k, (k % 2 == 0 ? busy : jam).start);
  batch.restore(40, jam.start);
  std::vector<StepLog> logs(scenes.size());
  batch.advance(steps, &logs);
  for (std::size_t k = 0; k < 40; ++k) (k % 2 == 0 ? busy : jam).expect_same(batch, k, logs[k]);
  const Expected gradient(other, jam.field, jam.start, steps);
  gradient.expect_same(batch, 40, logs[40]);
}

/// Few time steps, so that compute-sanitizer can run it.
TEST_F(CudaSplitting, BrieflyGivesTheBitsOfTheCpu) {
  const Expected busy = busy_with_splitting(3);
  CudaBatch batch({{busy.scene, busy.field}}, {});
  batch.restore(0, busy.start);
  std::vector<StepLog> logs(1);
  batch.advance(3, &logs);
  busy.expect_same(batch, 0, logs[0]);
}

TEST_F(CudaSplitting, NothingAtAllTouchesInAnEmptySea) {
  SceneDef scene = with_splitting(agreement::jam_scene(ContactSolver::coupled), 0.2);
  scene.floes.count = 30;
  const Bodies field = agreement::drifting_field(scene);
  const Expected empty(scene, field, make_engine(scene, field, agreement::on("cpu"))->save(), 10);
  CudaBatch batch({{scene, field}}, {});
  std::vector<StepLog> logs(1);
  batch.advance(10, &logs);
  empty.expect_same(batch, 0, logs[0]);
}

}  // namespace
}  // namespace gem
