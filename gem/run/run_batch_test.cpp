// Scenes that run together compared with single runs.
#include "gem/run/run_batch.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <new>

#include "gem/engine/testing/test_scenes.h"
#include "gem/record/fake_engine.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_writer.h"

namespace gem {
namespace {

/// Tests run at the same time, so the name of the file holds the name of the test.
RunOptions options_for(const std::string& name) {
  RunOptions options;
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  options.output = testing::TempDir() + "gem_run_batch_" + test + "_" + name + ".h5";
  options.overwrite = true;
  options.log.progress = ProgressMode::none;
  return options;
}

TEST(RunBatch, EachSceneHasTheBitsAndTheRecordThatItHasAlone) {
  std::vector<SceneDef> scenes;
  std::vector<BatchScene> starts;
  std::vector<RunOptions> options;
  for (const std::uint64_t seed : {1, 2, 3}) {
    SceneDef scene = test::busy_scene(seed);
    scene.run.duration_s = 14.0 + 2.0 * static_cast<double>(seed);    // the first ends while others go on
    scene.output.floes_interval_s = 1.0 + static_cast<double>(seed);  // frames at different times
    starts.push_back({scene, test::busy_field(scene)});
    options.push_back(options_for(std::to_string(seed)));
    scenes.push_back(scene);
  }
  EngineOptions engine;
  engine.threads = 1;
  const auto batch = make_engine_batch(starts, engine);
  const std::vector<BatchEnd> ends = run_batch(scenes, *batch, options, 3);
  ASSERT_EQ(ends.size(), 3u);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    EXPECT_EQ(ends[k].fault, "");
    EXPECT_GT(ends[k].summary.worst.contacts, 0) << "nothing touched";
    const RunOptions alone = options_for("alone");
    const RunSummary summary = run_scene(scenes[k], *test::busy_engine(scenes[k], "cpu"), alone);
    EXPECT_EQ(ends[k].summary.state_hash, summary.state_hash) << k;
    const RunFile together(options[k].output), single(alone.output);
    EXPECT_EQ(together.attribute("gem_state_hash"), hash_text(summary.state_hash));
    for (const char* dataset :
         {"platform/x", "platform/ice_impulse_x", "floes/time", "events/impulse", "stats/contacts"})
      EXPECT_EQ(together.column(dataset), single.column(dataset)) << dataset;
    EXPECT_EQ(ends[k].summary.at_limit, summary.at_limit) << k;
  }
  SceneDef hurried = scenes[0];
  hurried.contact.solver = ContactSolver::coupled;
  hurried.numerics.iterations_maximum = 1;
  const RunSummary summary = run_scene(hurried, *test::busy_engine(hurried, "cpu"), options_for("hurried"));
  EXPECT_GT(summary.at_limit, 0);
  EXPECT_LE(summary.at_limit, summary.steps);
  hurried.contact.solver = ContactSolver::independent;
  EXPECT_EQ(run_scene(hurried, *test::busy_engine(hurried, "cpu"), options_for("alone_each")).at_limit, 0);
}

/// Fake engines; the second stops at a given time step.
class FakeBatch : public EngineBatch {
 public:
  FakeBatch(const SceneDef& scene, std::size_t count, std::int64_t stop_at) {
    for (std::size_t k = 0; k < count; ++k) engines_.push_back(std::make_unique<FakeEngine>(scene, fake_field(3)));
    engines_[1]->stop_at = stop_at;
  }
  std::size_t size() const override { return engines_.size(); }
  Engine& engine(std::size_t k) override { return *engines_[k]; }
  std::vector<std::exception_ptr> advance(const std::vector<StepsAhead>& ahead, std::vector<StepLog>& logs) override {
    std::vector<std::exception_ptr> faults(engines_.size());
    for (std::size_t k = 0; k < engines_.size(); ++k) {
      try {
        // each scene at its own pace, and not in every call
        const auto some = std::min<std::int64_t>(ahead[k].most, 5 * static_cast<std::int64_t>((calls_ + k) % 4));
        if (some > 0) engines_[k]->advance(some, logs[k]);
      } catch (const Error&) {
        faults[k] = std::current_exception();
      }
    }
    ++calls_;
    return faults;
  }

 private:
  std::vector<std::unique_ptr<FakeEngine>> engines_;
  std::size_t calls_ = 0;
};

TEST(RunBatch, ASceneThatFailsStopsNoOther) {
  SceneDef scene;
  scene.run.duration_s = 30.0;
  const std::vector<SceneDef> scenes(3, scene);
  const std::vector<RunOptions> options = {options_for("a"), options_for("b"), options_for("c")};
  FakeBatch batch(scene, 3, 300);
  const std::vector<BatchEnd> ends = run_batch(scenes, batch, options, 2);
  EXPECT_EQ(ends[1].code, ExitCode::numerical_stop);
  EXPECT_NE(ends[1].fault.find("not finite"), std::string::npos);
  EXPECT_NE(RunFile(options[1].output, true).status().find("stopped:numerical"), std::string::npos);
  for (const std::size_t k : {std::size_t{0}, std::size_t{2}}) {
    EXPECT_EQ(ends[k].summary.status, "complete") << ends[k].fault;
    EXPECT_EQ(ends[k].summary.steps, steps_of(scene));
    EXPECT_EQ(RunFile(options[k].output).status(), "complete");
  }
}

/// A fake engine that has no memory for its first call if the seed is 2.
class ForgetfulEngine : public FakeEngine {
 public:
  ForgetfulEngine(const SceneDef& scene, Bodies bodies)
      : FakeEngine(scene, std::move(bodies)), fails_(scene.run.seed == 2) {}
  void advance(std::int64_t steps, StepLog& log) override {
    if (fails_) throw std::bad_alloc();
    FakeEngine::advance(steps, log);
  }

 private:
  bool fails_;
};

void expect_closed_without_memory(const BatchEnd& end, const RunOptions& options) {
  EXPECT_EQ(end.code, ExitCode::resource_limit);
  EXPECT_NE(end.fault.find("bad_alloc"), std::string::npos) << end.fault;
  EXPECT_NE(RunFile(options.output, true).status().find("stopped:failure"), std::string::npos);
}

TEST(RunBatch, ASceneWithoutMemoryStopsNoOther) {
  register_baseline("forgetful", [](const SceneDef& scene, Bodies bodies, const EngineOptions&) {
    return std::make_unique<ForgetfulEngine>(scene, std::move(bodies));
  });
  std::vector<SceneDef> scenes(3);
  std::vector<BatchScene> starts;
  std::vector<RunOptions> options;
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    scenes[k].run.duration_s = 30.0;
    scenes[k].run.seed = k + 1;
    starts.push_back({scenes[k], fake_field(3)});
    options.push_back(options_for("memory_" + std::to_string(k)));
  }
  const auto batch = make_engine_batch(starts, {"forgetful"});
  const std::vector<BatchEnd> ends = run_batch(scenes, *batch, options, 2);
  expect_closed_without_memory(ends[1], options[1]);
  for (const std::size_t k : {std::size_t{0}, std::size_t{2}})
    EXPECT_EQ(ends[k].summary.status, "complete") << ends[k].fault;
}

TEST(RunBatch, ACallWithoutMemoryClosesEveryFile) {
  struct Forgetful : FakeBatch {
    using FakeBatch::FakeBatch;
    std::vector<std::exception_ptr> advance(const std::vector<StepsAhead>&, std::vector<StepLog>&) override {
      throw std::bad_alloc();
    }
  };
  SceneDef scene;
  scene.run.duration_s = 30.0;
  const std::vector<RunOptions> options = {options_for("a"), options_for("b")};
  Forgetful batch(scene, 2, -1);
  const std::vector<BatchEnd> ends = run_batch({scene, scene}, batch, options);
  for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) expect_closed_without_memory(ends[k], options[k]);
}

TEST(RunBatch, AStopEndsAllInOrder) {
  SceneDef scene;
  scene.run.duration_s = 30.0;
  const std::atomic<int> stop = 15;
  std::vector<RunOptions> options = {options_for("a"), options_for("b")};
  for (RunOptions& one : options) one.stop = &stop;
  FakeBatch batch(scene, 2, -1);
  for (const BatchEnd& end : run_batch({scene, scene}, batch, options))
    EXPECT_EQ(end.summary.status, "stopped:SIGTERM");
}

}  // namespace
}  // namespace gem
