// Mooring lines from the case to the file, the summary, the analysis and the report.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "gem/command/command_fixture.h"
#include "gem/record/run_file/run_file.h"
#include "gem/record/run_file/stored_case.h"
#include "gem/record/summary/summary_file.h"
#include "gem/report/run/drawn_lines.h"

namespace gem {
namespace {

/// A barge that drifts off on four chains, of which that at -x breaks within ten seconds.
class MooringLinesCommandTest : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::ofstream(path("lines.toml")) << R"([run]
name = "lines"
duration_s = 20.0
[floes]
count = 0
[boundary]
present = false
[platform]
start_velocity_m_per_s = [0.4, 0.0]
[mooring]
law = "catenary"
line_height_m = 40.0
line_table = [
  [648.2, 0.0, 50.0, 0.0, 600.0, 1400.0, 7e8, 4e6],
  [0.0, 648.2, 0.0, 50.0, 600.0, 1400.0, 7e8, 4e6],
  [-648.2, 0.0, -50.0, 0.0, 600.0, 1400.0, 7e8, 4e6],
  [0.0, -648.2, 0.0, -50.0, 600.0, 1400.0, 7e8, 4e6],
]
[numerics]
time_step_s = 0.05
[output]
platform_interval_s = 0.2
)";
  }

  static std::string lines(const std::string& more) { return "gem run lines.toml --threads 1 -q " + more; }
};

TEST_F(MooringLinesCommandTest, AreRecordedAndChangeNoRun) {
  ASSERT_EQ(shell(lines("--out plain.h5") + " && " + lines("--out lines.h5 --set output.line_tensions=true")), 0)
      << text_of("err");
  const RunFile plain(path("plain.h5")), run(path("lines.h5"));
  EXPECT_FALSE(plain.has("platform/line_tension"));
  EXPECT_EQ(run.attribute("gem_state_hash"), plain.attribute("gem_state_hash"));
  EXPECT_EQ(run.column("platform/line_break_time"), plain.column("platform/line_break_time"));
  const std::vector<double> tension = run.column("platform/line_tension"), time = run.column("platform/time"),
                            broke = run.column("platform/line_break_time");
  ASSERT_EQ(tension.size(), 4 * time.size());
  ASSERT_EQ(broke.size(), tension.size());
  const double at = broke.end()[-2];
  EXPECT_GT(at, 1.0);
  EXPECT_EQ(at, 0.05 * std::round(at / 0.05)) << "the end of a time step";
  EXPECT_EQ(broke.end()[-4] + broke.end()[-3] + broke.end()[-1], 0.0) << "the others hold";
  for (std::size_t i = 0; i < time.size(); ++i) {
    EXPECT_EQ(broke[4 * i + 2], time[i] < at ? 0.0 : at);
    // a slack line still carries the weight of what hangs below its fairlead
    EXPECT_GT(tension[4 * i], 1400.0 * 40.0);
    if (time[i] > at + 0.2) {
      EXPECT_EQ(tension[4 * i + 2], 0.0);
    }
  }
  double largest = 0.0;
  for (std::size_t i = 2; i < tension.size(); i += 4) largest = std::max(largest, tension[i]);
  EXPECT_GT(largest, 4e6);
  EXPECT_LT(largest, 4.2e6) << "it breaks in the first time step above its strength";
}

TEST_F(MooringLinesCommandTest, ARunThatGoesOnHasTheRowsOfOneThatNeverStopped) {
  const std::string with = " --set output.line_tensions=true";
  for (const char* until : {"1.0", "15.0"}) {
    ASSERT_EQ(shell(lines("--out whole.h5 --overwrite" + with) + " && " +
                    lines("--out parts.h5 --overwrite --until " + std::string(until) + with) +
                    " && gem run --continue parts.h5 -q --threads 1"),
              0)
        << text_of("err");
    const RunFile whole(path("whole.h5")), parts(path("parts.h5"));
    EXPECT_EQ(whole.attribute("gem_state_hash"), parts.attribute("gem_state_hash"));
    for (const char* name : {"platform/line_tension", "platform/line_break_time"})
      EXPECT_EQ(whole.column(name), parts.column(name)) << name;
  }
}

TEST_F(MooringLinesCommandTest, StandInSummaryInfoAndAnalysis) {
  ASSERT_EQ(shell("gem run lines.toml --threads 1 --out lines.h5 --set output.line_tensions=true --json"), 0)
      << text_of("err");
  const auto summary = nlohmann::json::parse(text_of("out"));
  const double at = summary.at("line_break_times_s").at(2);
  EXPECT_GT(at, 1.0);
  ASSERT_EQ(shell("gem info lines.h5"), 0);
  EXPECT_NE(text_of("out").find("line 3 at "), std::string::npos) << text_of("out");
  ASSERT_EQ(shell("gem analyse lines.h5 --json"), 0) << text_of("err");
  const auto found = nlohmann::json::parse(text_of("out")).at("mooring_lines");
  ASSERT_EQ(found.size(), 4U);
  EXPECT_EQ(found.at(2).at("break_time_s"), at);
  EXPECT_GT(found.at(2).at("tension_largest_N"), 4e6);
  EXPECT_EQ(found.at(0).at("break_time_s"), 0.0);
  ASSERT_EQ(shell("gem analyse lines.h5"), 0);
  EXPECT_NE(text_of("out").find("line 3"), std::string::npos) << text_of("out");
}

TEST_F(MooringLinesCommandTest, AreShownByTheCheckOfTheCase) {
  ASSERT_EQ(shell("gem case check lines.toml"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("4, at the start with 1830 to 1830 kN"), std::string::npos) << "V70: 1830.47 kN";
}

TEST_F(MooringLinesCommandTest, AreDrawnWhereTheyAreWithWhatTheyHold) {
  ASSERT_EQ(shell(lines("--out lines.h5 --set output.line_tensions=true")), 0) << text_of("err");
  const RunFile run(path("lines.h5"));
  const DrawnLines drawn(run, stored_scene(run));
  EXPECT_NEAR(drawn.usual_tension(), 1830.47e3, 10.0) << "V70";
  const double broke = drawn.break_times()[2];
  ASSERT_GT(broke, 1.0);
  // Turned by a quarter: the fairlead of line 1 stands at +y of the platform.
  const std::vector<DrawnLine> turned = drawn.at({3.0, 1.0}, 1.5707963267948966, 0.0);
  EXPECT_NEAR(turned[0].fairlead.x, 3.0, 1e-12);
  EXPECT_NEAR(turned[0].fairlead.y, 51.0, 1e-12);
  EXPECT_EQ(turned[0].anchor.x, 648.2);
  const std::vector<DrawnLine> before = drawn.at({0.0, 0.0}, 0.0, broke - 0.1),
                               after = drawn.at({0.0, 0.0}, 0.0, broke);
  EXPECT_EQ(before[2].state, LineState::holds);
  EXPECT_NEAR(before[2].tension, 1830.47e3, 10.0);
  EXPECT_EQ(after[2].state, LineState::broken);
  EXPECT_EQ(after[2].tension, 0.0);
  // 200 m nearer to its anchor than 598 m a line of 600 m hangs and pulls no more. It carries w h, and its stretch
  // w h^2 / (2 EA) lies on the seabed: 56 kN less w h w h / (2 EA) = 2.24 N.
  const DrawnLine slack = drawn.at({200.0, 0.0}, 0.0, 0.0)[0];
  EXPECT_EQ(slack.state, LineState::slack);
  EXPECT_NEAR(slack.tension, 56e3 - 56e3 * 56e3 / (2.0 * 7e8), 1e-2);
}

TEST_F(MooringLinesCommandTest, StandInTheSummaryOfASweep) {
  std::ofstream(path("sweep.toml")) << R"(include = ["lines.toml"]
[output]
line_tensions = true
[sweep]
mode = "product"
name = "{speed}"
speed = [0, 40]
[sweep.set.speed]
0.platform.start_velocity_m_per_s = [0.0, 0.0]
40.platform.start_velocity_m_per_s = [0.4, 0.0]
)";
  ASSERT_EQ(shell("gem sweep run sweep.toml --out runs -q && gem sweep collect runs --out all.h5"), 0)
      << text_of("err");
  const SummaryTable summary = read_summary(path("all.h5"));
  const auto values = [&](const std::string& name) {
    const SummaryColumn* column = summary.column(name);
    return column ? column->numbers : std::vector<double>{};
  };
  EXPECT_EQ(values("lines_broken"), (std::vector<double>{0.0, 1.0}));
  ASSERT_EQ(values("line_tension_largest_N").size(), 2U);
  EXPECT_NEAR(values("line_tension_largest_N")[0], 1830.47e3, 10.0);
  EXPECT_GT(values("line_tension_largest_N")[1], 4e6);
}

TEST_F(MooringLinesCommandTest, StandInTheReport) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(shell(lines("--out lines.h5 --set output.line_tensions=true") + " && gem report lines.h5 --out report"), 0)
      << text_of("err");
  const std::string page = text_of("report/index.html");
  EXPECT_NE(page.find("Mooring lines"), std::string::npos);
  EXPECT_NE(page.find("line 3"), std::string::npos);
}

}  // namespace
}  // namespace gem
