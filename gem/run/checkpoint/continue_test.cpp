// A run that stops and goes on has the bits and the file of a run that never stopped.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <ostream>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/engine/contact_key.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/record/run_file/run_file.h"
#include "gem/run/checkpoint/check_state.h"
#include "gem/run/checkpoint/checkpoint_file.h"
#include "gem/run/checkpoint/resume.h"
#include "gem/run/run_batch.h"
#include "gem/run/run_scene.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

struct Setting {
  const char* name;
  const char* engine;
  int threads;
  ContactSolver solver;
  Iteration iteration;
};
std::ostream& operator<<(std::ostream& out, const Setting& setting) { return out << setting.name; }

constexpr Setting settings[] = {
    {"reference_independent", "reference", 1, ContactSolver::independent, Iteration::gradient},
    {"reference_coupled", "reference", 1, ContactSolver::coupled, Iteration::gradient},
    {"cpu_1_independent", "cpu", 1, ContactSolver::independent, Iteration::gradient},
    {"cpu_2_independent", "cpu", 2, ContactSolver::independent, Iteration::gradient},
    {"cpu_1_coupled", "cpu", 1, ContactSolver::coupled, Iteration::gradient},
    {"cpu_2_coupled", "cpu", 2, ContactSolver::coupled, Iteration::gradient},
    {"cpu_1_splitting", "cpu", 1, ContactSolver::coupled, Iteration::splitting},
    {"cpu_2_splitting", "cpu", 2, ContactSolver::coupled, Iteration::splitting},
    {"cpu_1_compliant", "cpu", 1, ContactSolver::compliant, Iteration::gradient},
    {"cpu_2_compliant", "cpu", 2, ContactSolver::compliant, Iteration::gradient}};

SceneDef scene_of(const Setting& setting) {
  SceneDef scene = test::busy_scene(5);
  scene.contact.solver = setting.solver;
  scene = test::iterated_by(std::move(scene), setting.iteration);
  scene.run.duration_s = 40.0;
  if (std::string(setting.engine) == "reference") {  // few floes, near the platform
    scene.floes.count = 40;
    scene.floes.length_m = 40.0;
    scene.floes.start_x_m = -55.0;
    scene.run.duration_s = 20.0;
  }
  scene.output.floes_interval_s = 0.7;  // no multiple of the blocks of time steps
  scene.output.event_speed_m_per_s = 0.001;
  scene.output.hit_release_s = 0.2;  // many hits, some of them open when the run stops
  return scene;
}

RunSummary go(const SceneDef& scene, const Setting& setting, RunOptions options) {
  return run_scene(scene, *test::busy_engine(scene, setting.engine, setting.threads), options);
}

/// The engine as another process makes it: from the files alone.
RunSummary go_on_with(const std::string& run_file, const Setting& setting, RunOptions options) {
  const Resumable run = resumable(run_file);
  const auto engine = make_engine(run.engine_scene, run.from->engine.bodies, {setting.engine, setting.threads});
  go_on(options, run);
  return run_scene(run.scene, *engine, options);
}

/// All datasets, but for those of the wall clock.
void expect_same_rows(const std::string& one, const std::string& other, const SceneDef& scene) {
  const RunFile a(one), b(other);
  EXPECT_GT(a.shape("events/time").at(0), 1u) << "no hits to compare";
  for (const Column& column : schema(scene)) {
    if (column.name == "wall_time" || column.name == "sim_rate") continue;
    const std::string path = column.group + "/" + column.name;
    EXPECT_EQ(a.shape(path), b.shape(path)) << path;
    const std::vector<double> of_a = a.column(path), of_b = b.column(path);
    ASSERT_EQ(of_a.size(), of_b.size()) << path;
    std::size_t different = 0;
    for (std::size_t i = 0; i < of_a.size(); ++i)
      different += std::memcmp(&of_a[i], &of_b[i], sizeof of_a[i]) != 0 ? 1 : 0;
    EXPECT_EQ(different, 0u) << path;
  }
  for (const char* name : {"gem_state_hash", "gem_status", "gem_verdict", "gem_case_toml", "gem_case_sha256"})
    EXPECT_EQ(a.attribute(name), b.attribute(name)) << name;
  EXPECT_EQ(a.attribute("gem_status"), "complete");
}

void expect_same_totals(const RunSummary& a, const RunSummary& b) {
  EXPECT_EQ(a.state_hash, b.state_hash);
  EXPECT_EQ(a.frames, b.frames);
  EXPECT_EQ(a.events, b.events);
  EXPECT_EQ(a.steps, b.steps);
  EXPECT_EQ(a.at_limit, b.at_limit);
  EXPECT_EQ(a.overlap.count, b.overlap.count);
  EXPECT_EQ(a.overlap_share.count, b.overlap_share.count);
  EXPECT_EQ(a.residual.energy, b.residual.energy);
  EXPECT_EQ(a.worst.residual, b.worst.residual);
  EXPECT_EQ(a.verdict.grade, b.verdict.grade);
  EXPECT_EQ(std::isnan(a.asked_residual), std::isnan(b.asked_residual));
  if (!std::isnan(a.asked_residual)) {
    EXPECT_EQ(a.asked_residual, b.asked_residual);
  }
}

class ContinueTest : public testing::TestWithParam<Setting> {
 protected:
  std::string path(const std::string& name) const { return (scratch_.path() / name).string(); }
  RunOptions options(const std::string& name) const {
    RunOptions options;
    options.output = path(name);
    options.log.quiet = true;
    options.checkpoint_interval_s = 1e9;
    return options;
  }
  std::size_t files() const { return std::size_t(std::distance(fs::directory_iterator(scratch_.path()), {})); }

  ScratchFolder scratch_{"gem-continue"};
};

INSTANTIATE_TEST_SUITE_P(, ContinueTest, testing::ValuesIn(settings), [](const auto& row) { return row.param.name; });

TEST_P(ContinueTest, AStoppedRunGoesOnToTheSameBits) {
  const SceneDef scene = scene_of(GetParam());
  const RunSummary whole = go(scene, GetParam(), options("whole.h5"));
  EXPECT_GT(whole.worst.contacts, 5) << "nothing touched";
  RunOptions stopped = options("parts.h5");
  stopped.step_limit = 77;
  EXPECT_EQ(go(scene, GetParam(), stopped).status, "stopped:until");
  RunSummary last;
  for (const std::int64_t limit : {78, 200, 0}) {
    stopped.step_limit = limit;
    last = go_on_with(path("parts.h5"), GetParam(), stopped);
  }
  expect_same_rows(path("whole.h5"), path("parts.h5"), scene);
  expect_same_totals(whole, last);
  EXPECT_EQ(files(), 2u) << "checkpoints are left behind";
}

TEST(CheckpointState, CornersMustFitTheBodies) {
  const Setting& setting = settings[8];
  const SceneDef scene = scene_of(setting);
  const auto engine = test::busy_engine(scene, setting.engine, setting.threads);
  StepLog log;
  engine->advance(60, log);
  Checkpoint checkpoint;
  checkpoint.engine = engine->save();
  checkpoint.recorder.now.step = checkpoint.engine.step;
  ASSERT_GT(checkpoint.engine.corner_key.size(), 1u);
  EXPECT_EQ(fault_of(checkpoint), "");
  const auto body = static_cast<std::int32_t>(checkpoint.engine.bodies.count());
  for (const std::uint64_t key : {corner_key(1, body, 0, false), corner_key(5, 5, 0, false),
                                  corner_key(1, body - 1, 1000, true), checkpoint.engine.corner_key[0]}) {
    Checkpoint damaged = checkpoint;
    damaged.engine.corner_key[1] = key;
    EXPECT_EQ(fault_of(damaged), "its corners do not fit");
  }
  checkpoint.engine.corner_value.pop_back();
  EXPECT_EQ(fault_of(checkpoint), "its corners do not fit");
}

TEST_P(ContinueTest, CheckpointsChangeNothing) {
  const SceneDef scene = scene_of(GetParam());
  const RunSummary without = go(scene, GetParam(), options("without.h5"));
  RunOptions often = options("often.h5");
  often.checkpoint_interval_s = 1e-9;
  const RunSummary with = go(scene, GetParam(), often);
  expect_same_rows(path("without.h5"), path("often.h5"), scene);
  expect_same_totals(without, with);
}

constexpr Setting one_thread = settings[4], two_threads = settings[5];

class ContinueOnceTest : public ContinueTest {
 protected:
  SceneDef scene_ = scene_of(one_thread);
  RunOptions options_ = options("run.h5");

  /// Stops the run at two time steps, so that both checkpoint files exist.
  void stop_twice() {
    options_.step_limit = 80;
    go(scene_, one_thread, options_);
    options_.step_limit = 200;
    go_on_with(path("run.h5"), one_thread, options_);
    options_.step_limit = 0;
    ASSERT_TRUE(fs::exists(path("run.h5.checkpoint-a")) && fs::exists(path("run.h5.checkpoint-b")));
  }
  void expect_the_whole_run() {
    go_on_with(path("run.h5"), one_thread, options_);
    go(scene_, one_thread, options("whole.h5"));
    expect_same_rows(path("whole.h5"), path("run.h5"), scene_);
  }
  static std::string bytes_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
  void damage(const std::string& name, std::size_t at) {
    std::string bytes = bytes_of(path(name));
    bytes[at % bytes.size()] = static_cast<char>(bytes[at % bytes.size()] ^ 0x10);
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  void expect_refusal(const std::string& why) {
    const std::string before = bytes_of(path("run.h5"));
    try {
      resumable(path("run.h5"));
      ADD_FAILURE() << "no error, expected: " << why;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::file_system);
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
    EXPECT_EQ(bytes_of(path("run.h5")), before);
  }
};

INSTANTIATE_TEST_SUITE_P(, ContinueOnceTest, testing::Values(one_thread),
                         [](const auto& row) { return row.param.name; });

TEST_P(ContinueOnceTest, AnotherNumberOfThreadsGoesOn) {
  const RunSummary whole = go(scene_, one_thread, options("whole.h5"));
  options_.step_limit = 100;
  go(scene_, one_thread, options_);
  options_.step_limit = 333;
  go_on_with(path("run.h5"), two_threads, options_);
  options_.step_limit = 500;
  go_on_with(path("run.h5"), one_thread, options_);
  options_.step_limit = 0;
  expect_same_totals(go_on_with(path("run.h5"), two_threads, options_), whole);
  expect_same_rows(path("whole.h5"), path("run.h5"), scene_);
}

TEST_P(ContinueOnceTest, TheHistoryTellsOfIt) {
  stop_twice();
  options_.command_line = "gem run --continue run.h5";
  go_on_with(path("run.h5"), one_thread, options_);
  const std::string history = RunFile(path("run.h5")).attribute("history");
  EXPECT_EQ(std::count(history.begin(), history.end(), '\n'), 2) << history;
  EXPECT_NE(history.find("gem run --continue run.h5"), std::string::npos) << history;
}

TEST_P(ContinueOnceTest, ADamagedCheckpointFallsBackToTheOlderOne) {
  stop_twice();
  const std::int64_t newest = resumable(path("run.h5")).from->engine.step;
  EXPECT_EQ(newest, 200);
  damage("run.h5.checkpoint-b", 70000);
  const Resumable older = resumable(path("run.h5"));
  EXPECT_EQ(older.from->engine.step, 80);
  EXPECT_NE(older.note.find("checkpoint-b: a checksum is wrong"), std::string::npos) << older.note;
  expect_the_whole_run();
}

TEST_P(ContinueOnceTest, TwoDamagedCheckpointsAreOneError) {
  stop_twice();
  damage("run.h5.checkpoint-b", 500000);
  fs::resize_file(path("run.h5.checkpoint-a"), 1000);
  expect_refusal("it ends too early");
  expect_refusal("a checksum is wrong");
  for (const char* name : {"run.h5.checkpoint-a", "run.h5.checkpoint-b"}) std::ofstream(path(name)) << "not one";
  expect_refusal("it ends too early");
}

TEST_P(ContinueOnceTest, EveryDamagedByteIsFound) {
  options_.step_limit = 20;
  go(scene_, one_thread, options_);
  const std::string file = path("run.h5.checkpoint-a"), whole = bytes_of(file);
  for (std::size_t at = 0; at < whole.size(); at += whole.size() / 97 + 1) {
    damage("run.h5.checkpoint-a", at);
    expect_refusal("cannot go on");
    std::ofstream(file, std::ios::binary) << whole;
  }
  EXPECT_EQ(resumable(path("run.h5")).from->engine.step, 20);
}

TEST_P(ContinueOnceTest, WhatCannotGoOnSaysWhy) {
  expect_refusal("no such file");
  go(scene_, one_thread, options_);
  expect_refusal("it is complete");
  options_.overwrite = true;
  options_.checkpoint_interval_s = 0.0;
  options_.step_limit = 50;
  go(scene_, one_thread, options_);
  expect_refusal("there is no checkpoint beside it");
}

TEST_P(ContinueOnceTest, ACheckpointOfAnotherCaseOrOfLaterRowsIsRefused) {
  options_.step_limit = 700;
  go(scene_, one_thread, options_);
  const std::string later = bytes_of(path("run.h5.checkpoint-a"));
  options_.overwrite = true;
  options_.step_limit = 20;
  go(scene_, one_thread, options_);
  std::ofstream(path("run.h5.checkpoint-a"), std::ios::binary) << later;
  expect_refusal("its checkpoint is newer than its rows");
  scene_.run.seed = 6;
  go(scene_, one_thread, options_);
  std::ofstream(path("run.h5.checkpoint-a"), std::ios::binary) << later;
  expect_refusal("its checkpoint belongs to another case");
}

TEST_P(ContinueOnceTest, ACheckpointCountsOnSplitsAndContactsToo) {
  scene_.output.contact_forces = true;
  scene_.breakup.maximum_pieces = 60;
  scene_.breakup.minimum_size_m = 1.0;
  scene_.breakup.load_time_s = 0.4;
  scene_.breakup.fracture_toughness_Pa_sqrt_m = 2e3;
  options_.step_limit = 403;
  go(scene_, one_thread, options_);
  const Checkpoint sound = find_checkpoints(path("run.h5")).whole.front();
  for (const char* dataset : {"splits/time", "contacts/time"}) {
    Checkpoint later = sound;
    (dataset[0] == 's' ? later.position.splits : later.position.contacts) += 100000;
    write_checkpoint(path("run.h5"), later, {});
    expect_refusal(std::string("newer than its rows: ") + dataset);
  }
  write_checkpoint(path("run.h5"), sound, {});
  EXPECT_GT(RunFile(path("run.h5")).shape("splits/time").at(0), 4u) << "nothing split";
  options_.step_limit = 0;
  expect_the_whole_run();
}

TEST_P(ContinueOnceTest, ANewRunRemovesOldCheckpoints) {
  stop_twice();
  options_.overwrite = true;
  options_.step_limit = 0;
  go(scene_, one_thread, options_);
  EXPECT_EQ(files(), 1u);
}

TEST_P(ContinueOnceTest, ABatchGoesOn) {
  const RunSummary whole = go(scene_, one_thread, options("whole.h5"));
  SceneDef other = scene_;
  other.run.seed = 9;
  std::vector<RunOptions> all = {options_, options("other.h5")};
  for (RunOptions& one : all) one.step_limit = 130;
  const auto begin = [&](const std::vector<BatchScene>& scenes) { return make_engine_batch(scenes, {"cpu", 1}); };
  run_batch({scene_, other}, *begin({{scene_, test::busy_field(scene_)}, {other, test::busy_field(other)}}), all);
  std::vector<BatchScene> scenes;
  for (RunOptions& one : all) {
    const Resumable run = resumable(one.output);
    scenes.push_back({run.engine_scene, run.from->engine.bodies});
    go_on(one, run);
    one.step_limit = 0;
  }
  const auto ends = run_batch({scene_, other}, *begin(scenes), all);
  EXPECT_EQ(ends[1].fault, "");
  expect_same_totals(ends[0].summary, whole);
  expect_same_rows(path("whole.h5"), path("run.h5"), scene_);
}

}  // namespace
}  // namespace gem
