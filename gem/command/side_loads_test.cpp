// Loads by side from the case to the file, the page and the report.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "gem/command/command_fixture.h"
#include "gem/record/run_file/run_file.h"

namespace gem {
namespace {

class SideLoadsCommandTest : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::ofstream(path("ship.toml")) << R"([run]
name = "ship"
duration_s = 60.0
[current]
velocity_m_per_s = [1.0, 0.0]
[boundary]
present = false
[floes]
count = 60
length_m = 100.0
width_m = 60.0
start_x_m = -150.0
[platform]
outline = "ship"
length_m = 90.0
beam_m = 20.0
bow_length_m = 25.0
stern_length_m = 15.0
mass_kg = 1e7
[output]
event_speed_m_per_s = 0.0
floes_interval_s = 5.0
)";
  }

  static std::string ship(const std::string& more) { return "gem run ship.toml --threads 1 -q " + more; }

  static double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }
};

TEST_F(SideLoadsCommandTest, AreAllThatTheIceGivesAndChangeNoRun) {
  ASSERT_EQ(shell(ship("--out plain.h5") + " && " + ship("--out sides.h5 --set output.side_loads=true")), 0)
      << text_of("err");
  const RunFile plain(path("plain.h5")), run(path("sides.h5"));
  EXPECT_FALSE(plain.has("platform/side_impulse"));
  EXPECT_EQ(run.attribute("gem_state_hash"), plain.attribute("gem_state_hash"));
  const std::vector<double> rows = run.column("platform/side_impulse");
  ASSERT_EQ(rows.size(), 11 * run.rows("platform/time"));
  const double all = sum(run.column("events/impulse"));
  ASSERT_GT(all, 1e5);
  EXPECT_NEAR(sum(rows), all, 1e-5 * all) << "single precision, and every hit counts";
  const std::vector<double> friction = run.column("platform/side_friction_impulse");
  EXPECT_NEAR(sum(friction), -sum(run.column("events/impulse_t")), 1e-5 * all);
  double bow = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (i % 11 < 3 || i % 11 > 7) bow += rows[i];
  EXPECT_GT(bow, 0.8 * all) << "the ice comes from ahead";
}

TEST_F(SideLoadsCommandTest, AreRecordedWithoutEvents) {
  ASSERT_EQ(shell(ship("--out sides.h5 --set output.side_loads=true --set output.platform_events=false")), 0);
  const RunFile run(path("sides.h5"));
  EXPECT_EQ(run.rows("events/time"), 0U);
  EXPECT_GT(sum(run.column("platform/side_impulse")), 1e5);
}

TEST_F(SideLoadsCommandTest, ARunThatGoesOnHasTheRowsOfOneThatNeverStopped) {
  ASSERT_EQ(shell(ship("--out whole.h5 --set output.side_loads=true") + " && " +
                  ship("--out parts.h5 --set output.side_loads=true --until 31.02") +
                  " && gem run --continue parts.h5 -q --threads 1"),
            0)
      << text_of("err");
  const RunFile whole(path("whole.h5")), parts(path("parts.h5"));
  for (const char* name : {"platform/side_impulse", "platform/side_friction_impulse"})
    EXPECT_EQ(whole.column(name), parts.column(name)) << name;
}

TEST_F(SideLoadsCommandTest, StandOnThePage) {
  ASSERT_EQ(shell(ship("--out sides.h5 --set output.side_loads=true") + " && gem view sides.h5 --out page.html"), 0)
      << text_of("err");
  const std::string page = text_of("page.html");
  EXPECT_NE(page.find("port bow, at the shoulder"), std::string::npos);
  EXPECT_NE(page.find("\"side_impulse\":["), std::string::npos);
}

TEST_F(SideLoadsCommandTest, StandInTheReport) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(shell(ship("--out sides.h5 --set output.side_loads=true") + " && gem report sides.h5 --out report"), 0)
      << text_of("err");
  const std::string page = text_of("report/index.html");
  EXPECT_NE(page.find("Loads by side of the platform"), std::string::npos);
  EXPECT_NE(page.find("starboard quarter"), std::string::npos);
}

TEST_F(SideLoadsCommandTest, AFixedShipFeelsWhatItHandsOn) {
  ASSERT_EQ(shell(ship("--out fixed.h5 --set platform.fixed=true")), 0) << text_of("err");
  const RunFile run(path("fixed.h5"));
  const std::vector<double> ice = run.column("platform/ice_force_x"), ground = run.column("platform/mooring_force_x");
  double largest = 0.0;
  for (std::size_t i = 0; i < ice.size(); ++i) {
    // both are sums of impulses over the sample, in another order
    EXPECT_NEAR(ice[i], -ground[i], 1e-9 * (1.0 + std::abs(ice[i])));
    largest = std::max(largest, std::abs(ice[i]));
  }
  EXPECT_GT(largest, 1e3);
  for (const char* name : {"vx", "vy", "r"})
    for (const double value : run.column(std::string("platform/") + name)) EXPECT_EQ(value, 0.0) << name;
}

}  // namespace
}  // namespace gem
