// The cuda engine gives the bits of the cpu engine over 600 s of the paper's densest run.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "gem/engine/testing/law_names.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/scene/sweep/sweep.h"
#include "validation/agreement/jam.h"
#include "validation/agreement/on_gpu.h"

namespace gem {
namespace {

/// The run with this name in a sweep.
SceneDef member(const std::string& path, const std::string& name) {
  for (const SweepMember& run : expand_sweep(path))
    if (run.name == name) return run.scene;
  throw Error(ExitCode::usage, "no run " + name + " in " + path);
}

class LongCuda : public OnGpu, public testing::WithParamInterface<SolverAndManifold> {};

/// One time step from each of 100 states along a run of the paper, and its whole first 600 s.
TEST_P(LongCuda, SixHundredSecondsOfTheDensestRun) {
  const auto [solver, manifold] = GetParam();
  const SceneDef scene = resolved(member(GEM_SOURCE_DIR "/cases/table1.toml", "400_200_100"), solver, manifold);
  const Bodies field = make_field(scene);
  const auto cpu = make_engine(scene, field, {"cpu", 0}), cuda = make_engine(scene, field, agreement::on("cuda"));
  const auto probe = make_engine(scene, field, agreement::on("cuda"));
  const std::int64_t stretch = std::llround(6.0 / scene.numerics.time_step_s);
  std::int64_t contacts = 0;
  for (int block = 0; block < 100; ++block) {
    StepLog expected, log;
    const EngineState state = cpu->save();
    cpu->advance(1, expected);
    probe->restore(state);
    probe->advance(1, log);
    ASSERT_EQ(probe->state_hash(), cpu->state_hash()) << "time step " << cpu->step();
    cpu->advance(stretch - 1, expected);
    log.clear();
    cuda->advance(stretch, log);
    ASSERT_EQ(cuda->state_hash(), cpu->state_hash()) << "time step " << cpu->step();
    test::expect_same_log(log, expected);
    if (solver == ContactSolver::coupled) test::expect_same_judgement(log, expected);
    if (HasFailure()) return;
    contacts += test::contacts_in(expected);
  }
  test::expect_same_books(cuda->ledger(), cpu->ledger());
  EXPECT_GT(contacts, 1000000);
}

INSTANTIATE_TEST_SUITE_P(Ways, LongCuda,
                         testing::Values(SolverAndManifold{ContactSolver::independent, Manifold::chord_middle},
                                         SolverAndManifold{ContactSolver::coupled, Manifold::chord_ends}),
                         test::LawNames());

}  // namespace
}  // namespace gem
