// A run file is written and read back; every refusal of writer and reader.
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <mutex>

#include "gem/base/error.h"
#include "gem/record/fake_engine.h"
#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/output/output_path.h"
#include "gem/record/recorder.h"
#include "gem/report/run/load_run.h"
#include "gem/run/run_file_fixture.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

TEST_F(RunFileTest, EverythingComesBack) {
  const RunSummary summary = run();
  EXPECT_EQ(summary.status, "complete");
  EXPECT_EQ(summary.steps, 200);
  const RunFile file(options_.output);
  EXPECT_EQ(file.status(), "complete");
  EXPECT_EQ(file.attribute("gem_state_hash"), hash_text(summary.state_hash));
  EXPECT_NE(file.attribute("gem_case_toml").find("[run]"), std::string::npos);
  EXPECT_EQ(file.number_attribute("gem_first_floe_body"), 2.0);
  EXPECT_EQ(file.floe_count(), 3U);
  EXPECT_EQ(file.frame_count(), 6U);
  EXPECT_EQ(file.column("platform/time").size(), 101U);
  EXPECT_DOUBLE_EQ(file.column("platform/ice_impulse_x").back(), 399.0);
  EXPECT_EQ(file.column("events/impulse").size(), 20U);
  EXPECT_DOUBLE_EQ(file.column("events/impulse").front(), 4.5);
  EXPECT_EQ(file.column("events/body_b").front(), 2.0);
  EXPECT_EQ(file.column("stats/contacts").back(), 7.0);
  EXPECT_EQ(file.units("platform/ice_force_x"), "N");
  const FrameView last = file.frame(5);
  EXPECT_DOUBLE_EQ(last.time, 10.0);
  ASSERT_EQ(last.x.size(), 3U);
  EXPECT_NEAR(last.x[1], 23.0, 1e-5);
  EXPECT_EQ(last.active[2], 1.0F);
  EXPECT_EQ(file.platform_outline().size(), 4U);
  ASSERT_EQ(file.boundary_outlines().size(), 1U);
  EXPECT_DOUBLE_EQ(file.boundary_outlines()[0][0].y, -51.0);
}

TEST_F(RunFileTest, TheVerdictComesBack) {
  const RunVerdict verdict = run().verdict;
  const RunVerdict read = verdict_of(RunFile(options_.output));
  EXPECT_NE(verdict.grade, Grade::not_judged);
  EXPECT_EQ(read.grade, verdict.grade);
  ASSERT_EQ(read.judgements.size(), verdict.judgements.size());
  for (std::size_t i = 0; i < read.judgements.size(); ++i) {
    const Judgement &one = read.judgements[i], &other = verdict.judgements[i];
    EXPECT_EQ(one.criterion, other.criterion);
    EXPECT_EQ(one.grade, other.grade);
    EXPECT_EQ(one.text, other.text);
    EXPECT_TRUE(one.value == other.value || (std::isnan(one.value) && std::isnan(other.value)));
    EXPECT_EQ(one.doubtful_above, other.doubtful_above);
    EXPECT_EQ(one.bad_above, other.bad_above);
    EXPECT_TRUE(one.time_s == other.time_s || (std::isnan(one.time_s) && std::isnan(other.time_s)));
  }
}

TEST_F(RunFileTest, AFileWithoutAVerdictIsNotJudged) {
  FakeEngine engine(scene_, fake_field(3));
  {
    RunWriter writer(options_.output, false, scene_, engine.bodies(), {});
    writer.write(Recorder(scene_, engine).take());
    writer.finish("complete", 0);
  }
  const RunVerdict verdict = verdict_of(RunFile(options_.output));
  EXPECT_EQ(verdict.grade, Grade::not_judged);
  EXPECT_TRUE(verdict.judgements.empty());
}

TEST_F(RunFileTest, ADamagedVerdictIsRefused) {
  run();
  {
    const std::lock_guard library(hdf5::library_mutex());
    const hdf5::Handle file =
        hdf5::checked(H5Fopen(options_.output.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), H5Fclose, "open");
    hdf5::write_text(file, "gem_verdict_grades", "good");  // one word for six criteria
  }
  const RunFile file(options_.output);
  expect_error(ExitCode::file_system, "its verdict is damaged", [&] { verdict_of(file); });
}

TEST_F(RunFileTest, ARunThatStopsByItselfIsBad) {
  FakeEngine engine(scene_, fake_field(3));
  engine.stop_at = 100;
  EXPECT_THROW(run_scene(scene_, engine, options_), Error);
  const RunVerdict verdict = verdict_of(RunFile(options_.output, true));
  EXPECT_EQ(verdict.grade, Grade::bad);
  ASSERT_FALSE(verdict.judgements.empty());
  EXPECT_EQ(verdict.judgements.back().criterion, "stopped");
  EXPECT_EQ(verdict.judgements.back().text, "floe 3 has a speed that is not finite");
}

TEST_F(RunFileTest, SchemaMatchesTheFile) {
  run();
  const RunFile file(options_.output);
  const std::vector<Column> columns = schema(scene_);
  EXPECT_GT(columns.size(), 60U);
  for (const Column& column : columns) {
    const std::string path = column.group + "/" + column.name;
    ASSERT_TRUE(file.has(path)) << path;
    EXPECT_EQ(file.units(path), column.units) << path;
    EXPECT_EQ(file.long_name(path), column.long_name) << path;
    EXPECT_FALSE(column.long_name.empty()) << path;
  }
}

TEST_F(RunFileTest, ManySlabsGiveTheSameAsOne) {
  run();
  const auto whole = RunFile(options_.output).column("floes/x");
  options_.flush_interval_s = 0.0;
  options_.overwrite = true;
  run();
  EXPECT_EQ(RunFile(options_.output).column("floes/x"), whole);
}

TEST_F(RunFileTest, RunsWithoutFloesPlatformOrTime) {
  options_.overwrite = true;
  run(0);
  EXPECT_EQ(RunFile(options_.output).floe_count(), 0U);
  EXPECT_EQ(RunFile(options_.output).frame_count(), 6U);
  EXPECT_TRUE(floes_of_run_file(options_.output).floes.empty());
  run(2, false);
  EXPECT_TRUE(RunFile(options_.output).column("platform/time").empty());
  EXPECT_TRUE(RunFile(options_.output).platform_outline().empty());
  scene_.run.duration_s = 0.0;
  const RunSummary summary = run();
  EXPECT_EQ(summary.steps, 0);
  EXPECT_EQ(RunFile(options_.output).frame_count(), 1U);
  EXPECT_EQ(load_run(options_.output, false).frames.size(), 1U);
}

TEST_F(RunFileTest, FloesComeBackAsListedFloes) {
  run();
  const std::vector<FloeDef> floes = floes_of_run_file(options_.output).floes;
  ASSERT_EQ(floes.size(), 3U);
  EXPECT_EQ(floes[2].position_m.x, 16.0);
  EXPECT_EQ(floes[2].outline_m.size(), 4U);
  EXPECT_EQ(floes[2].thickness_m, 0.5);
}

TEST_F(RunFileTest, FastFloesCloseFarInATimeStepAndStillComeBack) {
  Bodies field = fake_field(3);
  field.velocity[2] = {10.0, 0.0};  // twice its way in a time step, and the recorded overlap, are more than a metre
  FakeEngine engine(scene_, field);
  run_scene(scene_, engine, options_);
  ASSERT_GE(2.0 * 10.0 * scene_.numerics.time_step_s, 1.0);
  const FloesStart start = floes_of_run_file(options_.output, last_frame);
  EXPECT_EQ(start.floes.size(), 3U);
  EXPECT_EQ(start.overlap, 1.0);
}

TEST_F(RunFileTest, NumericalStopIsInTheFile) {
  FakeEngine engine(scene_, fake_field(3));
  engine.stop_at = 150;
  expect_error(ExitCode::numerical_stop, "floe 3", [&] { run_scene(scene_, engine, options_); });
  expect_error(ExitCode::file_system, "stopped:numerical", [&] { RunFile file(options_.output); });
  const RunFile file(options_.output, true);
  EXPECT_EQ(file.frame_count(), 4U);
}

TEST_F(RunFileTest, BooksThatDoNotCloseStopTheRun) {
  FakeEngine engine(scene_, fake_field(3));
  engine.lose_energy_at = 80;
  expect_error(ExitCode::numerical_stop, "energy books do not close at 4",
               [&] { run_scene(scene_, engine, options_); });
}

TEST_F(RunFileTest, TimeStepLimitStopsInOrder) {
  options_.step_limit = 50;
  EXPECT_EQ(run().status, "stopped:until");
  EXPECT_EQ(RunFile(options_.output, true).column("floes/time").back(), 2.5);
}

TEST_F(RunFileTest, RefusesPathsBeforeTheRun) {
  run();
  const auto size = fs::file_size(options_.output);
  expect_error(ExitCode::file_system, "the file exists", [&] { run(); });
  EXPECT_EQ(fs::file_size(options_.output), size);
  options_.output = folder_.string();
  expect_error(ExitCode::file_system, "it is a directory", [&] { run(); });
  options_.output = (folder_ / "missing" / "run.h5").string();
  expect_error(ExitCode::file_system, "No such file", [&] { run(); });
  options_.output = (folder_ / "a run.h5" / "run.h5").string();
  expect_error(ExitCode::file_system, "Not a directory", [&] { run(); });
  options_.output = "/proc/run.h5";
  expect_error(ExitCode::file_system, "/proc", [&] { run(); });
  EXPECT_EQ(files(), 1U);
}

TEST_F(RunFileTest, LongCasesAreKeptWhole) {
  scene_.floes.source = FloeSource::listed;
  scene_.floe.assign(2000, FloeDef{});
  for (FloeDef& floe : scene_.floe) floe.outline_m = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
  run();
  EXPECT_GT(RunFile(options_.output).attribute("gem_case_toml").size(), 65536U);
}

TEST(OutputPath, ShowsControlCharacters) { EXPECT_EQ(shown("a\nb\x1b"), "a\\x0ab\\x1b"); }

}  // namespace
}  // namespace gem
