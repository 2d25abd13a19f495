// gem run --from: cases that begin with a recorded frame of another run.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "gem/command/command_fixture.h"
#include "gem/record/run_file/run_file.h"

namespace gem {
namespace {

/// Close ice drifts onto a platform and past it; some floes leave before the end.
class BranchTest : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::ofstream(folder_ / "ice.toml") << "[run]\nname = \"ice\"\nduration_s = 60.0\n[floes]\ncount = 70\n"
                                           "length_m = 60.0\nwidth_m = 40.0\nstart_x_m = -70.0\nsize_mean_m = 5.0\n"
                                           "size_deviation_m = 1.0\n[boundary]\ninlet_x_m = -80.0\n"
                                           "inlet_width_m = 40.0\ntaper_start_x_m = -80.0\ngap_m = 40.0\n"
                                           "[platform]\ndiameter_m = 15.0\nmass_kg = 1e6\n"
                                           "[output]\nretire_x_m = 20.0\n[mooring]\nstiffness_N_per_m = 2e4\n"
                                           "[current]\nvelocity_m_per_s = [1.0, 0.0]\n";
    ASSERT_EQ(shell("gem run ice.toml -q --out ice.h5"), 0) << text_of("err");
  }
};

TEST_F(BranchTest, AFrameComesBackToItsRounding) {
  ASSERT_EQ(shell("gem run ice.toml -q --from ice.h5@30 --out branch.h5"), 0) << text_of("err");
  const RunFile ice(path("ice.h5")), branch(path("branch.h5"));
  const FrameView frame = ice.frame(3), first = branch.frame(0);
  ASSERT_EQ(frame.time, 30.0);
  double deepest = 0.0;
  for (const double overlap : ice.column("stats/maximum_overlap")) deepest = std::max(deepest, overlap);
  EXPECT_GT(deepest, 1e-5) << "the frame is no test of floes in contact";
  EXPECT_EQ(first.x, frame.x);
  EXPECT_EQ(first.y, frame.y);
  EXPECT_EQ(first.vx, frame.vx);
  EXPECT_EQ(first.vy, frame.vy);
  EXPECT_EQ(first.omega, frame.omega);
  for (std::size_t i = 0; i < frame.theta.size(); ++i) EXPECT_NEAR(first.theta[i], frame.theta[i], 1e-6) << i;
  EXPECT_EQ(branch.column("shape/thickness"), ice.column("shape/thickness"));
  for (const char* name : {"platform/x", "platform/y", "platform/psi", "platform/vx", "platform/vy", "platform/r"}) {
    const double there = ice.column(name).at(300);  // one sample each 0.1 s
    EXPECT_NEAR(branch.column(name).front(), there, 1e-12) << name;
    EXPECT_NE(there, 0.0) << name;
  }
}

TEST_F(BranchTest, FloesThatLeftStayAway) {
  ASSERT_EQ(shell("gem run ice.toml -q --from ice.h5 --out end.h5 --until 5"), 0) << text_of("err");
  const RunFile ice(path("ice.h5")), end(path("end.h5"));
  const FrameView last = ice.frame(ice.frame_count() - 1);
  const auto there = static_cast<std::size_t>(std::count(last.active.begin(), last.active.end(), 1.0f));
  EXPECT_LT(there, ice.floe_count());
  EXPECT_EQ(end.floe_count(), there);
  EXPECT_NE(end.attribute("gem_case_toml").find("time_s = 60.0\n"), std::string::npos);
}

TEST_F(BranchTest, TheCaseSaysWhereItBegan) {
  ASSERT_EQ(shell("gem run ice.toml -q --from ice.h5@30 --out a.h5 --until 20 && gem info a.h5 --case > a.toml && "
                  "gem run a.toml -q --out b.h5 --until 20"),
            0)
      << text_of("err");
  const auto text = [this](const char* file, const char* name) { return RunFile(path(file)).attribute(name); };
  EXPECT_EQ(text("a.h5", "gem_case_sha256"), text("b.h5", "gem_case_sha256"));
  EXPECT_EQ(text("a.h5", "gem_state_hash"), text("b.h5", "gem_state_hash"));
  ASSERT_EQ(shell("gem run ice.toml -q --from ice.h5@20 --out c.h5 --until 1"), 0) << text_of("err");
  EXPECT_NE(text("a.h5", "gem_case_sha256"), text("c.h5", "gem_case_sha256"));
  ASSERT_EQ(shell("gem run --continue a.h5 -q && gem run ice.toml -q --from ice.h5@30 --out whole.h5"), 0)
      << text_of("err");
  EXPECT_EQ(text("a.h5", "gem_state_hash"), text("whole.h5", "gem_state_hash"));
}

TEST_F(BranchTest, ASweepBeginsWithAFrame) {
  ASSERT_EQ(shell("gem run ice.toml --from ice.h5@30 --set run.duration_s=5 --dry-run"), 0) << text_of("err");
  std::filesystem::rename(folder_ / "out", folder_ / "begun.toml");
  std::ofstream(folder_ / "sweep.toml") << "include = [\"begun.toml\"]\n[sweep]\nmode = \"product\"\n"
                                           "name = \"k{stiffness}\"\nstiffness = [1e4, 1e5]\n"
                                           "map = { stiffness = \"mooring.stiffness_N_per_m\" }\n";
  ASSERT_EQ(shell("gem sweep run sweep.toml --out folder -q"), 0) << text_of("err");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "folder")) {
    if (entry.path().extension() != ".h5") continue;
    ++files;
    EXPECT_EQ(RunFile(entry.path().string()).frame(0).x, RunFile(path("ice.h5")).frame(3).x);
  }
  EXPECT_EQ(files, 2u);
}

TEST_F(BranchTest, WhatCannotBeginSaysWhy) {
  ASSERT_EQ(shell("gem run swing.toml -q"), 0);
  const struct {
    const char* line;
    int code;
    const char* message;
  } rows[] = {
      {"--from ice.h5@31", 4, "no frame at 31 s; its 7 frames are from 0 s to 60 s) the nearest is at 30 s"},
      {"--from ice.h5@7200", 4, "the nearest is at 60 s"},
      {"--from ice.h5@noon", 2, "after @ come seconds"},
      {"--from ice.h5@-1", 2, "after @ come seconds"},
      {"--from missing.h5", 4, "no such file"},
      {"--from ice.toml@30", 4, "not an HDF5 file"},
      {"--from swing.h5", 2, "no floes (the run had none)"},
      {"--from ''", 2, "it is empty"},
      {"--from ice.h5 --set floes.source=file --set 'floes.path=\"ice.h5\"'", 2, "both choose floes"},
      {"--from ice.h5 --continue ice.h5", 2, "excludes"},
      {"--from ice.h5@30 --set platform.diameter_m=20", 3, "overlap at the start (platform and floe"},
      {"--from ice.h5@30 --set boundary.gap_m=20", 3, "lies outside the channel"},
      {"--set floes.time_s=10", 3, "allowed only with floes.source = "},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(shell("gem run ice.toml -q --out no.h5 " + std::string(row.line)), row.code)
        << row.line << text_of("err");
    EXPECT_NE(text_of("err").find(row.message), std::string::npos) << row.line << "\n" << text_of("err");
    EXPECT_FALSE(exists("no.h5")) << row.line;
  }
}

}  // namespace
}  // namespace gem
