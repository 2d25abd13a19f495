// Dynamic positioning from the case to the file, the analysis and a run that goes on.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gem/command/command_fixture.h"
#include "gem/record/run_file/run_file.h"

namespace gem {
namespace {

/// A barge off its set point in wind, whose thrusters are too weak at first.
class DpCommandTest : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::ofstream(path("dp.toml")) << R"([run]
name = "dp"
duration_s = 60.0
[floes]
count = 0
[boundary]
present = false
[platform]
start_offset_m = [9.0, -4.0]
[wind]
velocity_m_per_s = [10.0, 5.0]
platform_area_m2 = 2000.0
[dp]
yaw_rad = 0.1
integral_time_s = 100.0
filter_time_s = 1.0
[[dp.thruster]]
position_m = [40.0, 0.0]
maximum_N = 8e5
rate_N_per_s = 8e4
[[dp.thruster]]
kind = "tunnel"
position_m = [-40.0, 0.0]
maximum_N = 8e5
[mooring]
stiffness_N_per_m = 0.0
[numerics]
time_step_s = 0.1
[output]
platform_interval_s = 0.3
)";
  }

  static std::string dp(const std::string& more) { return "gem run dp.toml --threads 1 -q " + more; }
};

const std::vector<std::string>& dp_columns() {
  static const std::vector<std::string> names = {
      "platform/thruster_force_x", "platform/thruster_force_y", "platform/thruster_at_limit",
      "platform/dp_demand_surge",  "platform/dp_demand_sway",   "platform/dp_demand_yaw",
      "platform/dp_offset_surge",  "platform/dp_offset_sway",   "platform/dp_offset_yaw"};
  return names;
}

TEST_F(DpCommandTest, ShowsInTheCheckAndInTheReport) {
  ASSERT_EQ(shell("gem case check dp.toml"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("current           0.25 m/s, direction 0 degrees from +x, drift"), std::string::npos)
      << text_of("out");
  EXPECT_NE(text_of("out").find("wind              11.18 m/s, direction 26.57 degrees from +x\n"), std::string::npos)
      << text_of("out");
  ASSERT_EQ(shell(dp("--out dp.h5") + " && gem report dp.h5 --out page"), 0) << text_of("err");
  const std::string page = text_of("page/index.html");
  EXPECT_NE(page.find(">Dynamic positioning<"), std::string::npos);
  EXPECT_NE(page.find(">force of all thrusters together</th><td>1600 kN<"), std::string::npos);
}

TEST_F(DpCommandTest, IsRecordedWithEverySample) {
  ASSERT_EQ(shell(dp("--out dp.h5")), 0) << text_of("err");
  const RunFile run(path("dp.h5"));
  const std::vector<double> time = run.column("platform/time");
  for (const std::string& name : dp_columns())
    EXPECT_EQ(run.column(name).size(), time.size() * (name.find("thruster") != std::string::npos ? 2 : 1)) << name;
  const std::vector<double> x = run.column("platform/thruster_force_x"), y = run.column("platform/thruster_force_y"),
                            limit = run.column("platform/thruster_at_limit"), r = run.column("platform/psi"),
                            surge = run.column("platform/dp_offset_surge"),
                            all = run.column("platform/mooring_force_y");
  EXPECT_NEAR(surge[0], 9.0, 1e-12) << "at t = 0 the yaw is 0";
  EXPECT_EQ(run.column("platform/dp_offset_yaw")[0], -0.1);
  double limited = 0.0;
  for (std::size_t i = 0; i < time.size(); ++i) {
    EXPECT_EQ(x[2 * i + 1], 0.0) << "a tunnel pushes athwart";
    EXPECT_LE(std::hypot(x[2 * i], y[2 * i]), 8e5 * (1 + 1e-12));
    limited += limit[2 * i];
    // the thrust of both is what is recorded as the force of the mooring; the ship turns little in a sample
    const double athwart = y[2 * i] + y[2 * i + 1];
    EXPECT_NEAR(all[i], std::sin(r[i]) * x[2 * i] + std::cos(r[i]) * athwart, 2e3) << time[i];
  }
  EXPECT_GT(limited, 0.0);
}

TEST_F(DpCommandTest, ARunThatGoesOnHasTheRowsOfOneThatNeverStopped) {
  ASSERT_EQ(shell(dp("--out whole.h5") + " && " + dp("--out parts.h5 --until 20.0") +
                  " && gem run --continue parts.h5 -q --threads 1"),
            0)
      << text_of("err");
  const RunFile whole(path("whole.h5")), parts(path("parts.h5"));
  EXPECT_EQ(parts.attribute("gem_state_hash"), whole.attribute("gem_state_hash"));
  for (const std::string& name : dp_columns()) EXPECT_EQ(parts.column(name), whole.column(name)) << name;
}

TEST_F(DpCommandTest, AnalysisSaysOffsetThrustAndTimeAtTheLimit) {
  ASSERT_EQ(shell(dp("--out dp.h5") + " && gem analyse dp.h5 --json"), 0) << text_of("err");
  const nlohmann::json findings = nlohmann::json::parse(text_of("out")).at("findings");
  const auto value = [&](const char* name) { return findings.at(name).at("value").get<double>(); };
  EXPECT_NEAR(value("dp_offset_largest_m"), std::hypot(9.0, 4.0), 0.5);
  EXPECT_LE(value("dp_offset_median_m"), value("dp_offset_p90_m"));
  EXPECT_LE(value("dp_offset_p99_m"), value("dp_offset_largest_m"));
  EXPECT_GT(value("dp_thrust_utilisation"), 0.05);
  EXPECT_LE(value("dp_thrust_utilisation_largest"), 1.0);
  EXPECT_GT(value("dp_time_at_limit_share"), 0.0);
  EXPECT_LT(value("dp_time_at_limit_share"), 1.0);
}

}  // namespace
}  // namespace gem
