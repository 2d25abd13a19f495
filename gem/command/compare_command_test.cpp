// gem compare, and the chosen time of gem report.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "gem/base/error.h"
#include "gem/command/command_fixture.h"
#include "gem/command/time_option.h"

namespace gem {
namespace {

TEST(TimeOption, ReadsUnits) {
  EXPECT_DOUBLE_EQ(time_of_option("--at", "1.3h"), 4680.0);
  EXPECT_DOUBLE_EQ(time_of_option("--at", "78min"), 4680.0);
  EXPECT_DOUBLE_EQ(time_of_option("--at", "4680s"), 4680.0);
  EXPECT_DOUBLE_EQ(time_of_option("--at", "4680"), 4680.0);
  EXPECT_DOUBLE_EQ(time_of_option("--at", "0"), 0.0);
  for (const char* wrong : {"", "h", "-1", "1.3 h", "1d", "nan", "inf", "1e999"})
    EXPECT_THROW(time_of_option("--at", wrong), Error) << wrong;
}

class CompareCommand : public CommandTest {
 protected:
  /// Free swings of 200 s from 1 m and from 0.5 m on a softer mooring.
  void make_runs() {
    ASSERT_EQ(shell("gem run swing.toml -q --threads 1 --until 200 --out a.h5 && gem run swing.toml -q --threads 1 "
                    "--until 200 --out b.h5 --set run.name=soft --set platform.start_offset_m=[0.5,0] --set "
                    "mooring.stiffness_N_per_m=2.5e5"),
              0)
        << text_of("err");
  }
};

TEST_F(CompareCommand, SetsNumbersSideBySide) {
  make_runs();
  ASSERT_EQ(shell("gem compare a.h5 b.h5 --json"), 0) << text_of("err");
  const auto object = nlohmann::json::parse(text_of("out"));
  const auto& differences = object.at("differences");
  EXPECT_EQ(differences.size(), 2u) << differences;
  EXPECT_EQ(differences.at("mooring.stiffness_N_per_m").at(1), "250000.0");
  EXPECT_EQ(differences.at("platform.start_offset_m").at(1), "[0.5, 0.0]");
  const auto& largest = object.at("numbers").at("x_largest_m").at("values");
  EXPECT_NEAR(largest.at(0).at("value").get<double>(), 1.0, 1e-12);
  EXPECT_NEAR(largest.at(1).at("value").get<double>(), 0.5, 1e-12);
  EXPECT_EQ(object.at("runs").at(1).at("label"), "soft");
  // cos(2 pi 190 / 88.86) = 0.64, then it falls: only the record from 190 s on counts
  ASSERT_EQ(shell("gem compare a.h5 b.h5 --json --from 190s"), 0) << text_of("err");
  const auto late = nlohmann::json::parse(text_of("out"));
  EXPECT_LT(late.at("numbers").at("orbit_largest_m").at("values").at(0).at("value").get<double>(), 0.65);
  ASSERT_EQ(shell("gem compare a.h5 b.h5"), 0);
  EXPECT_NE(text_of("out").find("mooring.stiffness_N_per_m"), std::string::npos) << text_of("out");
  EXPECT_NE(text_of("out").find("1000 mm"), std::string::npos) << text_of("out");
}

TEST_F(CompareCommand, ComparesARunWithItself) {
  make_runs();
  ASSERT_EQ(shell("cp a.h5 c.h5 && gem compare a.h5 c.h5"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("the same keys and values"), std::string::npos);
  EXPECT_NE(text_of("out").find("c.h5"), std::string::npos) << "runs of one name are called by their files";
}

TEST_F(CompareCommand, SaysWhyThereAreNoIntervals) {
  make_runs();
  ASSERT_EQ(shell("gem compare a.h5 b.h5 --from 15s"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("natural periods), it has "), std::string::npos) << text_of("out");
  ASSERT_EQ(shell("gem compare a.h5 b.h5 --from 15s --json"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("\"no_intervals\""), std::string::npos) << text_of("out");
}

TEST_F(CompareCommand, SaysWhichRunHasNotConverged) {
  const std::string run = "gem run " GEM_SOURCE_DIR "/cases/small_sweep.toml --index 1 -q --threads 1 ";
  ASSERT_EQ(shell(run + "--out fine.h5 && " + run +
                  "--set contact.solver=coupled --set numerics.iteration=gradient --set numerics.iterations_maximum=1 "
                  "--out rough.h5"),
            0)
      << text_of("err");
  ASSERT_EQ(shell("gem compare fine.h5 rough.h5"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("verdict_reasons"), std::string::npos) << text_of("out");
  ASSERT_EQ(shell("gem compare fine.h5 rough.h5 --json"), 0) << text_of("err");
  const auto object = nlohmann::json::parse(text_of("out"));
  const auto& numbers = object.at("numbers");
  EXPECT_EQ(object.at("runs").at(0).at("verdict"), "good");
  EXPECT_EQ(object.at("runs").at(1).at("verdict"), "bad");
  EXPECT_EQ(object.at("runs").at(1).at("verdict_criteria").size(), 6u);
  EXPECT_EQ(numbers.at("verdict_reasons").at("values").at(0), "-");
  for (const char* load : {"ice_force_window_largest_N", "event_impulse_largest_N_s", "crushing_peak_largest_N"}) {
    const auto& values = numbers.at(load).at("values");
    EXPECT_FALSE(values.at(0).contains("not_converged")) << load;
    EXPECT_EQ(values.at(1).at("not_converged"), true) << load;
  }
  EXPECT_FALSE(numbers.at("mooring_force_largest_N").at("values").at(1).contains("not_converged"));
  if (shell("command -v gnuplot") != 0) return;
  ASSERT_EQ(shell("gem compare fine.h5 rough.h5 --out page"), 0) << text_of("err");
  const std::string html = text_of("page/index.html");
  EXPECT_NE(html.find("its verdict is bad: "), std::string::npos);
  EXPECT_NE(html.find("N (not converged)</td>"), std::string::npos);
}

TEST_F(CompareCommand, WritesAPage) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  make_runs();
  ASSERT_EQ(shell("gem compare a.h5 b.h5 --out page && gem compare a.h5 b.h5 --out page"), 0) << text_of("err");
  EXPECT_EQ(text_of("out"), "page/index.html\npage/index.html\n");
  const std::string html = text_of("page/index.html");
  for (const char* figure : {"force", "exceedance", "motion_x", "motion_y", "spectrum_x"})
    EXPECT_TRUE(exists(std::string("page/figures/") + figure + "_2.csv")) << figure;
  EXPECT_NE(html.find("<code>mooring.stiffness_N_per_m</code>"), std::string::npos);
  EXPECT_EQ(shell("gem compare b.h5 a.h5 --out page"), 2) << "another page is kept";
  EXPECT_EQ(text_of("page/index.html"), html);
}

TEST_F(CompareCommand, EscapesTheNamesOfRuns) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(shell("for i in 1 2; do gem run swing.toml -q --threads 1 --out $i.h5 --set "
                  "\"run.name=\\\"<b>'$i\\\"\" --set run.seed=$i; done; gem compare 1.h5 2.h5 --out page"),
            0)
      << text_of("err");
  EXPECT_EQ(text_of("page/index.html").find("<b>"), std::string::npos);
  EXPECT_NE(text_of("page/index.html").find("&lt;b&gt;&#39;1"), std::string::npos);
}

TEST_F(CompareCommand, RefusesWhatItCannotCompare) {
  make_runs();
  EXPECT_EQ(shell("gem compare a.h5"), 2);
  EXPECT_NE(text_of("err").find("takes 2 to 12"), std::string::npos) << text_of("err");
  EXPECT_EQ(shell("gem compare a.h5 missing.h5 --out page"), 4);
  EXPECT_EQ(shell("gem compare a.h5 b.h5 --from 1h --out page"), 2);
  EXPECT_NE(text_of("err").find("a.h5: nothing to compare"), std::string::npos) << text_of("err");
  EXPECT_EQ(shell("gem compare a.h5 b.h5 --from soon"), 2);
  EXPECT_FALSE(exists("page"));
}

TEST_F(CompareCommand, AReportShowsTheChosenTime) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(shell("gem run " GEM_SOURCE_DIR "/cases/small_sweep.toml --index 1 -q --threads 1 --out r.h5 && gem "
                  "report r.h5 --at 1.4s --out page"),
            0)
      << text_of("err");
  EXPECT_TRUE(exists("page/figures/field_at.svg"));
  // frames are 0.5 s apart: the nearest to 1.4 s is that at 1.5 s
  EXPECT_NE(text_of("page/figures/field_at.gp").find("'t = 1.5 s'"), std::string::npos);
  EXPECT_NE(text_of("page/index.html").find("around 1.4 s (marked above)"), std::string::npos);
  EXPECT_EQ(shell("gem report r.h5 --at 3s --out other"), 2);
  EXPECT_NE(text_of("err").find("it lasts 2 s"), std::string::npos) << text_of("err");
  EXPECT_FALSE(exists("other"));
}

TEST_F(CompareCommand, AReportOfASweepSaysWhichRunsHaveNotConverged) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(shell("gem sweep run " GEM_SOURCE_DIR "/cases/small_sweep.toml --index 1 -q --out runs --set "
                  "contact.solver=coupled --set numerics.iteration=gradient --set numerics.iterations_maximum=1 && gem "
                  "report runs"),
            0)
      << text_of("err");
  const std::string html = text_of("runs_report/index.html");
  EXPECT_NE(html.find("<strong>bad</strong><br><small>"), std::string::npos);
  EXPECT_NE(html.find("N (not converged)</span>"), std::string::npos);
  EXPECT_NE(html.find("<em>Not converged</em> are runs"), std::string::npos);
}

TEST_F(CompareCommand, AReportOfASweepShowsItsRuns) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_EQ(shell("mkdir empty; gem report empty"), 4);
  EXPECT_NE(text_of("err").find("has no manifest.json"), std::string::npos) << text_of("err");
  ASSERT_EQ(
      shell("gem sweep run " GEM_SOURCE_DIR "/cases/small_sweep.toml --index 2-6 -q --out runs && gem report runs/"), 0)
      << text_of("err");
  EXPECT_EQ(text_of("out"), "runs_report/index.html\n");
  const std::string html = text_of("runs_report/index.html");
  EXPECT_NE(html.find("5 of 6 runs of a sweep"), std::string::npos);
  EXPECT_NE(html.find("<th scope=\"row\">slow</th><td><b>slow_4000000</b><p>missing</p></td><td><svg"),
            std::string::npos)
      << "the first run is missing, beside it is a picture";
  EXPECT_TRUE(exists("runs_report/figures/run_6.svg"));
  EXPECT_FALSE(exists("runs_report/figures/run_1.svg"));
  EXPECT_EQ(shell("gem report runs --at 1s --out runs_report"), 0) << text_of("err");
  EXPECT_NE(text_of("runs_report/index.html").find("around the platform at 1 s"), std::string::npos);
  EXPECT_EQ(shell("gem report runs --at 1h --out other"), 2) << "no run has this time";
  EXPECT_FALSE(exists("other/index.html"));
  ASSERT_EQ(
      shell("gem run " GEM_SOURCE_DIR
            "/cases/small_sweep.toml --index 2 --until 1 -q --threads 1 --overwrite --out runs/slow_5000000.h5 && "
            "gem report runs --allow-incomplete --at 1.5s --out runs_report"),
      0)
      << "one run that stopped before: " << text_of("err");
  EXPECT_NE(text_of("runs_report/index.html").find("ends at 1 s"), std::string::npos);
}

TEST_F(CompareCommand, ASweepOfShipsInTransitHasNoMooring) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(shell("gem sweep run " GEM_SOURCE_DIR "/cases/pack_ice_resistance.toml --index 1 -q --out ships "
                  "--set run.duration_s=1 --threads 1 && gem report ships"),
            0)
      << text_of("err");
  const std::string page = text_of("ships_report/index.html");
  EXPECT_NE(page.find("largest ice force"), std::string::npos);
  EXPECT_EQ(page.find("mooring"), std::string::npos);
}

/// Numbers that only some runs have: each that `gem analyse` knows stands in the comparison, with the same value.
class CompareSpecial : public CommandTest {
 protected:
  static bool is_common(const std::string& name) {
    for (const char* start : {"x_", "y_", "orbit_", "contact_", "ice_force_", "mooring_"})
      if (name.starts_with(start)) return true;
    return false;
  }

  /// Returns the numbers of the comparison. `first` is analysed; `count` numbers of it are special.
  nlohmann::json compared(const std::string& first, const std::string& second, std::size_t count) {
    const std::string from = " --json --from 10";
    EXPECT_EQ(shell("gem analyse " + first + from), 0) << text_of("err");
    const auto findings = nlohmann::json::parse(text_of("out")).at("findings");
    EXPECT_EQ(shell("gem compare " + first + " " + second + from), 0) << text_of("err");
    const auto numbers = nlohmann::json::parse(text_of("out")).at("numbers");
    std::size_t special = 0;
    for (const auto& [name, finding] : findings.items()) {
      if (is_common(name)) continue;
      ++special;
      EXPECT_TRUE(numbers.contains(name)) << name;
      if (!numbers.contains(name) || finding.at("value").is_null()) continue;
      const double value = finding.at("value").get<double>();
      // the mean of `gem analyse` and that of its interval add up to 300 samples in two ways: half a unit each
      const double rounding = 300.0 * 0x1p-53 * std::abs(value);
      EXPECT_NEAR(numbers.at(name).at("values").at(0).at("value").get<double>(), value, rounding) << name;
    }
    EXPECT_EQ(special, count);
    return numbers;
  }
};

TEST_F(CompareSpecial, ShipsInTransit) {
  const std::string ship =
      "gem run swing.toml -q --threads 1 --set platform.start_offset_m=[0,0] --set mooring.stiffness_N_per_m=0 ";
  ASSERT_EQ(
      shell(ship + "--set transit.bollard_thrust_N=1e5 --set transit.open_water_speed_m_per_s=2 --out way.h5 && " +
            ship + "--set transit.speed_m_per_s=1 --out tow.h5"),
      0)
      << text_of("err");
  const auto numbers = compared("way.h5", "tow.h5", 11);
  EXPECT_NEAR(numbers.at("transit_distance_m").at("values").at(1).at("value").get<double>(), 10.0, 1e-9);
  EXPECT_TRUE(numbers.at("thrust_mean_N").at("values").at(1).is_null()) << "a towed ship has no thrust of its own";
  EXPECT_TRUE(numbers.at("tow_mean_N").at("values").at(0).is_null());
  EXPECT_FALSE(numbers.contains("x_offset_m")) << "they have no rest";
  EXPECT_EQ(shell("gem compare way.h5 tow.h5"), 0);
  EXPECT_EQ(text_of("out").find("not resolved"), std::string::npos) << text_of("out");
}

TEST_F(CompareSpecial, ThrustersAndDrag) {
  std::ofstream(path("dp.toml")) << R"([run]
name = "dp"
duration_s = 30.0
[floes]
source = "listed"
[boundary]
present = false
[platform]
start_offset_m = [9.0, -4.0]
[wind]
velocity_m_per_s = [10.0, 5.0]
platform_area_m2 = 2000.0
[mooring]
stiffness_N_per_m = 0.0
[dp]
filter_time_s = 1.0
[[dp.thruster]]
position_m = [40.0, 0.0]
maximum_N = 8e5
[[dp.thruster]]
kind = "tunnel"
position_m = [-40.0, 0.0]
maximum_N = 8e5
[numerics]
time_step_s = 0.1
)";
  ASSERT_EQ(shell("gem run dp.toml -q --threads 1 && gem run swing.toml -q --threads 1"), 0) << text_of("err");
  const auto numbers = compared("dp.h5", "swing.h5", 11);  // two of them are the drag of the wind
  EXPECT_EQ(numbers.at("mooring_force_largest_N").at("meaning"), "mooring or thruster force, largest");
  EXPECT_TRUE(numbers.at("dp_yaw_largest_rad").at("values").at(1).is_null());
}

TEST_F(CompareSpecial, DragFromATimeOn) {
  ASSERT_EQ(shell("gem run swing.toml -q --threads 1 --set platform_drag.present=true --set platform_drag.draft_m=10 "
                  "--set water.density_kg_per_m3=1025 && cp swing.h5 same.h5"),
            0)
      << text_of("err");
  compared("swing.h5", "same.h5", 2);
}

TEST_F(CompareSpecial, FixedBodies) {
  std::ofstream(path("post.toml")) << R"([run]
name = "post"
duration_s = 20.0
[current]
velocity_m_per_s = [0.5, 0.0]
[boundary]
present = false
[platform]
fixed = true
anchor_m = [0.0, 500.0]
[mooring]
stiffness_N_per_m = 0.0
[output]
contact_forces = true
floes_interval_s = 0.5
[floes]
source = "listed"
[[fixed]]
outline_m = [[0.0, -10.0], [10.0, -10.0], [10.0, 10.0], [0.0, 10.0]]
[[floe]]
outline_m = [[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0]]
position_m = [-5.01, 0.0]
thickness_m = 1.0
)";
  ASSERT_EQ(shell("gem run post.toml -q --threads 1 && gem run post.toml -q --threads 1 --out same.h5"), 0)
      << text_of("err");
  const auto numbers = compared("post.h5", "same.h5", 6);
  EXPECT_GT(numbers.at("fixed_0_force_largest_N").at("values").at(1).at("value").get<double>(), 0.0);
}

}  // namespace
}  // namespace gem
