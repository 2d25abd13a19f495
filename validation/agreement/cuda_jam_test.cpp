// The cuda engine gives the bits of the cpu engine in a jam: any layout on the GPU, any batch.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"
#include "validation/agreement/jam.h"
#include "validation/agreement/on_gpu.h"

namespace gem {
namespace {

/// The jam of 1,234 floes, and the cpu engine's result from it.
class CudaJam : public OnGpu, public testing::WithParamInterface<SolverAndManifold> {
 protected:
  static constexpr std::int64_t steps = 60;

  void SetUp() override {
    OnGpu::SetUp();
    if (IsSkipped()) return;
    const auto [solver, manifold] = GetParam();
    scene_ = resolved(agreement::jam_scene(solver), solver, manifold);
    field_ = agreement::drifting_field(scene_);
    start_ = agreement::jam(scene_, field_);
    const auto cpu = make_engine(scene_, field_, agreement::on("cpu"));
    cpu->restore(start_);
    cpu->advance(steps, expected_);
    hash_ = cpu->state_hash();
    ledger_ = cpu->ledger();
    end_ = cpu->save();
    for (const StepQuality& quality : expected_.quality) ASSERT_GT(quality.contacts, agreement::contacts_wanted);
  }

  std::vector<BatchScene> copies(std::size_t count) const { return std::vector<BatchScene>(count, {scene_, field_}); }

  SceneDef scene_;
  Bodies field_;
  EngineState start_;
  StepLog expected_;
  std::uint64_t hash_ = 0;
  Ledger ledger_;
  EngineState end_;
};

TEST_P(CudaJam, NoLayoutOnTheGpuMatters) {
  const int most = CudaBatch(copies(1), {}).device().multiprocessors;
  for (const int blocks : {1, 2, 5, 16, 36, 80, 132})
    for (const int threads : {32, 128, 256}) {
      if (blocks > most) continue;
      CudaBatch batch(copies(1), {.blocks = blocks, .threads = threads, .ring_steps = 23});
      batch.restore(0, start_);
      std::vector<StepLog> logs(1);
      batch.advance(steps, &logs);
      EXPECT_EQ(batch.state_hash(0), hash_) << blocks << " blocks of " << threads << " threads";
      test::expect_same_log(logs[0], expected_);
      if (scene_.contact.solver == ContactSolver::coupled) test::expect_same_judgement(logs[0], expected_);
      test::expect_same_books(batch.ledger(0), ledger_);
      test::expect_same_memory(batch.save(0), end_);
    }
}

/// Few time steps, so that compute-sanitizer can run them: several blocks meet at a grid barrier and, where contacts
/// are coupled, exchange halos.
TEST_P(CudaJam, ManyBlocksBrieflyGiveTheBitsOfTheCpu) {
  constexpr std::int64_t few = 3;
  const auto cpu = make_engine(scene_, field_, agreement::on("cpu"));
  cpu->restore(start_);
  StepLog expected;
  cpu->advance(few, expected);
  CudaBatch batch(copies(1), {.blocks = 36, .threads = 64});
  batch.restore(0, start_);
  std::vector<StepLog> logs(1);
  batch.advance(few, &logs);
  EXPECT_EQ(batch.state_hash(0), cpu->state_hash());
  test::expect_same_log(logs[0], expected);
  test::expect_same_books(batch.ledger(0), cpu->ledger());
  if (scene_.contact.solver != ContactSolver::coupled) return;
  double iterations = 0.0;
  for (const StepQuality& quality : expected.quality) iterations += static_cast<double>(quality.iterations) / few;
  EXPECT_LT(batch.barriers(), 0.5 * iterations + 16.0) << "without halos there are two in an iteration";
}

TEST_P(CudaJam, ThreadsThatNoBlockCanHaveAreRefused) {
  for (const int threads : {-32, 16, 48, 512})
    EXPECT_THROW(CudaBatch(copies(1), {.threads = threads}), Error) << threads << " threads";
}

TEST_P(CudaJam, AListTooSmallGrowsAndLosesNothing) {
  for (const Route route : {Route::resident, Route::phases}) {
    CudaBatch batch(copies(1), {.list_rows = 100, .route = route});
    batch.restore(0, start_);
    std::vector<StepLog> logs(1);
    batch.advance(steps, &logs);
    EXPECT_EQ(batch.state_hash(0), hash_);
    test::expect_same_log(logs[0], expected_);
    if (scene_.contact.solver == ContactSolver::coupled) test::expect_same_judgement(logs[0], expected_);
  }
}

/// Enough scenes to be distributed over several streams, and a ring buffer that holds few time steps.
TEST_P(CudaJam, ManyScenesKeepTheirBitsPhaseByPhase) {
  constexpr std::size_t count = 120;
  CudaBatch batch(copies(count), {.ring_steps = 23});
  for (std::size_t k = 0; k < count; ++k) batch.restore(k, start_);
  std::vector<StepLog> logs(count);
  std::vector<std::int64_t> some(count, steps);
  for (std::size_t k = 0; k < count; k += 15) some[k] = 7;
  batch.advance(some, &logs);
  EXPECT_EQ(batch.route(), Route::phases);
  for (std::int64_t& more : some) more = steps - more;
  batch.advance(some, &logs);
  EXPECT_EQ(batch.route(), Route::resident) << "those that are left in the end are few";
  for (std::size_t k = 0; k < count; ++k) {
    EXPECT_EQ(batch.state_hash(k), hash_) << "place " << k;
    test::expect_same_log(logs[k], expected_);
  }
  test::expect_same_books(batch.ledger(count - 1), ledger_);
}

TEST_P(CudaJam, WholeTimeStepsAndPhasesTakeTurns) {
  constexpr std::size_t count = 90;
  CudaBatch batch(copies(count), {});
  for (std::size_t k = 0; k < count; ++k) batch.restore(k, start_);
  std::vector<std::int64_t> alone(count, 0), all(count, 5);
  for (const std::size_t k : {0, 50}) alone[k] = 5;
  bool resident = false, phases = false;
  for (std::int64_t left = steps; left > 0; left -= 10) {
    batch.advance(alone, nullptr);
    resident |= batch.route() == Route::resident;
    batch.advance(all, nullptr);
    phases |= batch.route() == Route::phases;
  }
  EXPECT_TRUE(resident && phases);
  for (const std::size_t k : {0, 50}) EXPECT_EQ(batch.state_hash(k), hash_) << "place " << k;
}

TEST_P(CudaJam, ARestartChangesNothing) {
  for (const Route route : {Route::resident, Route::phases}) {
    const CudaOptions options{.route = route};
    auto engine = make_cuda_engine(scene_, field_, options);
    engine->restore(start_);
    StepLog log;
    engine->advance(steps / 2, log);
    const EngineState half_way = engine->save();
    engine = make_cuda_engine(scene_, field_, options);
    engine->restore(half_way);
    engine->advance(steps - steps / 2, log);
    EXPECT_EQ(engine->state_hash(), hash_);
  }
}

TEST_P(CudaJam, ScenesOfABatchGoOnWithoutTheOthers) {
  CudaBatch batch(copies(3), {.ring_steps = 7});
  for (const std::size_t k : {0, 1, 2}) batch.restore(k, start_);
  batch.advance({steps / 2, steps, 0}, nullptr);
  EXPECT_EQ(batch.step(2), start_.step);
  EXPECT_EQ(batch.state_hash(1), hash_);
  batch.advance({steps - steps / 2, 0, steps}, nullptr);
  for (const std::size_t k : {0, 1, 2}) EXPECT_EQ(batch.state_hash(k), hash_) << "place " << k;
}

TEST_P(CudaJam, PlaceAndSizeOfABatchChangeNothing) {
  std::vector<BatchScene> scenes = copies(5);
  for (const std::size_t other : {0, 1, 3}) {
    scenes[other].scene = resolved(test::busy_scene(20 + other), std::get<0>(GetParam()), std::get<1>(GetParam()));
    scenes[other].bodies = test::busy_field(scenes[other].scene);
  }
  CudaBatch batch(scenes, {});
  for (const std::size_t jam : {2, 4}) batch.restore(jam, start_);
  batch.advance(steps, nullptr);
  for (const std::size_t jam : {2, 4}) EXPECT_EQ(batch.state_hash(jam), hash_) << "place " << jam;
  for (const std::size_t other : {0, 1, 3}) {
    const auto cpu = make_engine(scenes[other].scene, scenes[other].bodies, agreement::on("cpu"));
    StepLog log;
    cpu->advance(steps, log);
    EXPECT_EQ(batch.state_hash(other), cpu->state_hash()) << "place " << other;
    EXPECT_GT(test::contacts_in(log), 100);
  }
}

/// More scenes than multiprocessors: each scene has one block, and the blocks take turns.
TEST_P(CudaJam, MoreScenesThanBlocksStayWithTheirBlocks) {
  const std::size_t count = static_cast<std::size_t>(CudaBatch(copies(1), {}).device().multiprocessors) + 9;
  constexpr std::int64_t few = 4;
  const auto cpu = make_engine(scene_, field_, agreement::on("cpu"));
  cpu->restore(start_);
  StepLog expected;
  cpu->advance(few, expected);
  CudaBatch batch(copies(count), {.route = Route::resident});
  for (std::size_t k = 0; k < count; ++k) batch.restore(k, start_);
  batch.advance(few, nullptr);
  EXPECT_EQ(batch.route(), Route::resident);
  EXPECT_EQ(batch.blocks(), 1);
  for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(batch.state_hash(k), cpu->state_hash()) << "place " << k;
}

TEST_P(CudaJam, ScenesThatShareTheDeviceUnequallyKeepTheirBits) {
  std::vector<BatchScene> scenes = copies(26);
  CudaBatch batch(scenes, {.ring_steps = 32, .route = Route::resident});
  std::vector<StepsAhead> ahead;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    batch.restore(k, start_);
    // Some scenes have ten times as many steps left as others; later some stop at a frame of their own.
    ahead.push_back({0, k % 3 == 0 ? 10 * steps : steps});
  }
  std::vector<StepLog> logs(scenes.size());
  std::vector<std::size_t> places(scenes.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  const auto left = [&](std::size_t k) { return start_.step + steps - batch.step(k); };
  std::set<std::int64_t> first_steps;
  for (int calls = 0; std::any_of(places.begin(), places.end(), [&](std::size_t k) { return left(k) > 0; }); ++calls) {
    ASSERT_LT(calls, 1000);
    for (const std::size_t k : places)
      ahead[k].most = std::min<std::int64_t>(left(k), calls > 0 && k % 5 == 0 ? 3 : steps);
    for (const std::exception_ptr& fault : batch.advance_some(ahead, logs)) EXPECT_EQ(fault, nullptr);
    if (calls == 0)
      for (const std::size_t k : places) first_steps.insert(batch.step(k));
  }
  EXPECT_GT(first_steps.size(), 1u) << "all went at one pace";
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    EXPECT_EQ(batch.state_hash(k), hash_) << "place " << k;
    test::expect_same_log(logs[k], expected_);
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, CudaJam,
                         testing::Combine(testing::Values(ContactSolver::independent, ContactSolver::coupled),
                                          testing::Values(Manifold::chord_middle, Manifold::chord_ends)),
                         test::LawNames());

}  // namespace
}  // namespace gem
