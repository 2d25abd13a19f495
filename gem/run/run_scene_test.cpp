// A run file is written and read back; every refusal of writer and reader.
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/run_start.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <mutex>

#include "gem/base/error.h"
#include "gem/base/scratch_folder.h"
#include "gem/record/fake_engine.h"
#include "gem/record/hdf5/hdf5_handle.h"
#include "gem/record/output/output_path.h"
#include "gem/record/recorder.h"
#include "gem/record/run_file/run_layout.h"
#include "gem/report/run/load_run.h"
#include "gem/run/run_scene.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

class RunFileTest : public testing::Test {
 protected:
  void SetUp() override {
    scene_.run.duration_s = 10.0;
    scene_.output.floes_interval_s = 2.0;
    scene_.output.hit_release_s = 0.0;
    options_.output = (folder_ / "a run.h5").string();
    options_.log.quiet = true;
  }

  RunSummary run(int floes = 3, bool platform = true) {
    scene_.platform.present = platform;
    FakeEngine engine(scene_, fake_field(floes, platform));
    return run_scene(scene_, engine, options_);
  }
  std::size_t files() const { return std::size_t(std::distance(fs::directory_iterator(folder_), {})); }

  /// Runs `body`, which must throw Error with this code and with this text in its message.
  template <class Body>
  void expect_error(ExitCode code, const std::string& text, Body body) {
    try {
      body();
      ADD_FAILURE() << "no error, expected: " << text;
    } catch (const Error& error) {
      EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }

  ScratchFolder scratch_{"gem run file \xc3\xa9"};
  const fs::path& folder_ = scratch_.path();
  SceneDef scene_;
  RunOptions options_;
};

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

TEST_F(RunFileTest, NothingStaysBehindWithoutATimeStep) {
  {
    FakeEngine engine(scene_, fake_field(3));
    const RunWriter writer(options_.output, false, scene_, engine.bodies(), {});
    EXPECT_EQ(files(), 1U);
  }
  EXPECT_EQ(files(), 0U);
}

/// Rows of the platform and frames of two floes up to `time` [s].
Slab two_floes(std::size_t rows, double time) {
  Slab slab;
  slab.time = time;
  slab.platform.resize(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    slab.platform[i].position.x = std::sin(double(i));
    slab.platform[i].time = time * double(i + 1) / double(rows);
  }
  slab.floes.time.assign(1, time);
  for (auto* values : {&slab.floes.x, &slab.floes.y, &slab.floes.theta, &slab.floes.vx, &slab.floes.vy,
                       &slab.floes.omega, &slab.floes.active}) {
    values->assign(2, 0.0F);
  }
  return slab;
}

TEST_F(RunFileTest, AFileThatAnotherRunWritesIsLeftToIt) {
  const auto refused = [&](bool overwrite, const std::string& why) {
    expect_error(ExitCode::file_system, why, [&] { RunWriter(options_.output, overwrite, scene_, fake_field(2), {}); });
  };
  RunWriter first(options_.output, false, scene_, fake_field(2), {});
  refused(true, "another process writes or reads it");
  refused(false, "another process writes or reads it");  // a draft
  first.write(two_floes(7, 5.0));
  EXPECT_EQ(first.flush().platform, 7U);
  const auto size = fs::file_size(options_.output);
  refused(true, "another process writes or reads it");
  refused(false, "the file exists");
  EXPECT_EQ(fs::file_size(options_.output), size);
  first.finish("complete", 0);
  EXPECT_EQ(RunFile(options_.output).column("platform/x").size(), 7U);
}

TEST_F(RunFileTest, FullDiskIsOneClearErrorAndLeavesAReadableFile) {
  scene_.run.duration_s = 20000.0;
  scene_.output.floes_interval_s = 1.0;
  scene_.output.platform_interval_s = 0.05;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{4 << 20, before.rlim_max};
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &small);
  expect_error(ExitCode::file_system, "saved up to", [&] { run(50); });
  setrlimit(RLIMIT_FSIZE, &before);
  const RunFile file(options_.output, true);
  EXPECT_EQ(file.status(), "stopped:no room left on the disk");
  EXPECT_GE(file.frame_count(), 16U);
  EXPECT_EQ(file.column("floes/x").size(), file.frame_count() * 50);
}

TEST_F(RunFileTest, AFullFileKeepsWhatWasFlushedAndGetsItsStatus) {
  RunWriter writer(options_.output, false, scene_, fake_field(2), {});
  writer.write(two_floes(20480, 5.0));
  EXPECT_EQ(writer.flush().platform, 20480U);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, SIG_IGN);
  const rlimit small{fs::file_size(options_.output) + 1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  testing::internal::CaptureStderr();
  writer.write(two_floes(20480, 6.0));
  expect_error(ExitCode::file_system, "no room left on the disk; saved up to 5 s",
               [&] { writer.finish("complete", 0); });
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << "HDF5 told its own story";
  setrlimit(RLIMIT_FSIZE, &before);
  const RunFile file(options_.output, true);
  EXPECT_EQ(file.status(), "stopped:no room left on the disk");
  EXPECT_EQ(file.column("platform/x").size(), 20480U);
  EXPECT_EQ(file.column("platform/x")[7], std::sin(7.0));
}

TEST_F(RunFileTest, AFileThatLeavesItsPlaceIsAnError) {
  const auto refused = [&](const std::string& why, const std::function<void()>& harm) {
    RunWriter writer(options_.output, true, scene_, fake_field(2), {});
    writer.write(two_floes(100, 5.0));
    writer.flush();
    harm();
    expect_error(ExitCode::file_system, why, [&] {
      writer.write(two_floes(100, 6.0));
      writer.finish("complete", 0);
    });
  };
  const std::string other = (folder_ / "moved.h5").string();
  refused("deleted, moved", [&] { fs::remove(options_.output); });
  EXPECT_EQ(files(), 0U);
  refused("deleted, moved", [&] { fs::rename(options_.output, other); });
  EXPECT_EQ(RunFile(other, true).column("platform/x").size(), 100U);
  EXPECT_NE(RunFile(other, true).status().find("moved"), std::string::npos);
  refused("or replaced", [&] {
    fs::rename(options_.output, other);
    std::ofstream(options_.output) << "mine";
  });
  EXPECT_EQ(fs::file_size(options_.output), 4U);
  fs::remove(options_.output);
  refused("truncated", [&] { fs::resize_file(options_.output, 1000); });
}

TEST_F(RunFileTest, NoRoomForTheFirstSlabLeavesNothing) {
  RunWriter writer(options_.output, false, scene_, fake_field(2), {});
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  signal(SIGXFSZ, SIG_IGN);
  Slab slab;
  slab.platform.resize(20000);
  const rlimit small{1 << 20, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  expect_error(ExitCode::file_system, "nothing was saved", [&] {
    writer.write(slab);
    writer.finish("complete", 0);
  });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(files(), 0U);
}

TEST_F(RunFileTest, RefusesForeignAndTruncatedFiles) {
  expect_error(ExitCode::file_system, "no such file", [&] { RunFile file(options_.output); });
  expect_error(ExitCode::file_system, "it is a directory", [&] { RunFile file(folder_.string()); });
  const std::string text = (folder_ / "text.h5").string();
  std::ofstream(text) << "this is no run file";
  expect_error(ExitCode::file_system, "not an HDF5 file", [&] { RunFile file(text); });
  run();
  const auto size = fs::file_size(options_.output);
  for (const auto part : {size / 2, size / 10, std::uintmax_t{600}, std::uintmax_t{8}}) {
    fs::resize_file(options_.output, part);
    expect_error(ExitCode::file_system, "cannot read", [&] { RunFile file(options_.output); });
  }
}

TEST_F(RunFileTest, RefusesUnknownColumnsAndFrames) {
  run();
  const RunFile file(options_.output);
  expect_error(ExitCode::file_system, "platform/none", [&] { file.column("platform/none"); });
  expect_error(ExitCode::file_system, "no frame 6 of 6", [&] { file.frame(6); });
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
