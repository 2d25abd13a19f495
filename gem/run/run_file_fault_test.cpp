// What goes wrong while a run file is written or read: other runs, full disks, files that leave their place or are
// damaged.
#include "gem/record/run_file/run_file.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>

#include "gem/base/error.h"
#include "gem/record/fake_engine.h"
#include "gem/record/run_file/run_layout.h"
#include "gem/record/run_file/run_writer.h"
#include "gem/run/run_file_fixture.h"

namespace gem {
namespace {

namespace fs = std::filesystem;

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

}  // namespace
}  // namespace gem
