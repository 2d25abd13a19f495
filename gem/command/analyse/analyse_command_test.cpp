// gem analyse: one run, several runs, and what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "gem/command/command_fixture.h"

namespace gem {
namespace {

TEST_F(CommandTest, AnalyseSaysPeriodsThreeWays) {
  // Released 1 m off centre, at rest. 25 cycles of 2 pi sqrt(1e8 / 5e5) = 88.858 s, without damping or ice.
  ASSERT_EQ(shell("gem run swing.toml -q --until 2200 --threads 1"), 0) << text_of("err");
  ASSERT_EQ(shell("gem analyse swing.h5 --json"), 0) << text_of("err");
  const auto findings = nlohmann::json::parse(text_of("out")).at("findings");
  for (const char* way : {"spectrum", "crossings", "maxima"}) {
    const auto period = findings.at(std::string("x_period_by_") + way + "_s");
    // Samples are 0.1 s apart. Crossings are found to (omega dt)^2 of a sample; maxima to one sample at either end.
    EXPECT_NEAR(period.at("value").get<double>(), 88.8577, way == std::string("spectrum") ? 0.5 : 0.01) << way;
    EXPECT_LE(period.at("low").get<double>(), period.at("value").get<double>());
  }
  EXPECT_LT(findings.at("x_period_by_spectrum_s").at("low").get<double>(), 88.8577);
  EXPECT_GT(findings.at("x_period_by_spectrum_s").at("high").get<double>(), 88.8577);
  EXPECT_NEAR(findings.at("x_largest_m").at("value").get<double>(), 1.0, 1e-12);
  EXPECT_TRUE(findings.at("contact_gap_mean_s").is_null());
  EXPECT_EQ(findings.at("contact_fraction").at("value").get<double>(), 0.0);
  ASSERT_EQ(shell("gem analyse swing.h5 --from 500"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("x_period_by_crossings_s"), std::string::npos);
  EXPECT_NE(text_of("out").find("not resolved: the record has too few cycles"), std::string::npos) << text_of("out");
  EXPECT_NE(text_of("out").find("Kaplan-Meier"), std::string::npos);
}

/// The line of an output that begins with a name.
std::string line_of(const std::string& text, const std::string& name) {
  const std::size_t at = text.find("\n  " + name + " ");
  return at == std::string::npos ? "" : text.substr(at + 3, text.find('\n', at + 1) - at - 3);
}

TEST_F(CommandTest, AnalyseSaysWhatAShipDoesThatMeetsNoIce) {
  const std::string unmoored =
      "gem run swing.toml -q --threads 1 --set platform.start_offset_m=[0,0] --set mooring.stiffness_N_per_m=0";
  const std::string thrust = " --set transit.bollard_thrust_N=1e5 --set transit.open_water_speed_m_per_s=2";
  ASSERT_EQ(shell(unmoored + thrust + " --out way.h5 && gem analyse way.h5"), 0) << text_of("err");
  for (const char* name : {"transit_distance_m", "thrust_mean_N", "thrust_largest_N", "hold_across_largest_N"}) {
    const std::string line = line_of(text_of("out"), name);
    EXPECT_NE(line.find_first_of("0123456789"), std::string::npos) << name << ": " << line;
    EXPECT_EQ(line.find("no contact"), std::string::npos) << line;
  }
  EXPECT_NE(line_of(text_of("out"), "ice_force_window_largest_N").find("no contact"), std::string::npos);
  EXPECT_EQ(text_of("out").find("mooring_"), std::string::npos) << text_of("out");
  ASSERT_EQ(shell(unmoored + " --set transit.speed_m_per_s=1 --out tow.h5 && gem analyse tow.h5"), 0) << text_of("err");
  EXPECT_NE(line_of(text_of("out"), "tow_mean_N"), "") << text_of("out");
  ASSERT_EQ(shell(unmoored + " --out adrift.h5 && gem analyse adrift.h5"), 0) << text_of("err");
  EXPECT_EQ(text_of("out").find("mooring_"), std::string::npos) << text_of("out");
}

/// A barge of 200 m by 40 m that lies where mooring and drag of the water balance, in a current askew.
constexpr const char* dragged =
    "gem run swing.toml -q --threads 1 --overwrite --set platform.outline=listed "
    "--set platform.outline_m=[[-100,-20],[100,-20],[100,20],[-100,20]] --set platform.yaw=locked "
    "--set platform_drag.present=true --set platform_drag.draft_m=10 --set platform_drag.water=current "
    "--set water.density_kg_per_m3=1025 --set mooring.stiffness_N_per_m=5e5 --set current.velocity_m_per_s=[1.0,0.5] ";

TEST_F(CommandTest, AnalyseSaysTheDragOfWaterAndWindOnThePlatform) {
  const auto mean = [this](const std::string& name) {
    return nlohmann::json::parse(text_of("out")).at("findings").at(name).at("value").get<double>();
  };
  // The two halves of a time step find slips that differ by F dt / (2 M U), 1.8e-4 of them at most. That cancels but
  // for its square. The start, between two halves, leaves a swing of F dt / (2 M).
  const double left = 1e-4;
  // by axis: 1025 x 0.1 x 40 x 10 x 1^2 / 2 and 1025 x 0.7 x 200 x 10 x 0.5^2 / 2
  ASSERT_EQ(
      shell(std::string(dragged) + "--set platform_drag.law=by_axis --set platform.start_offset_m=[0.041,0.35875] "
                                   "--out axis.h5 && gem analyse axis.h5 --from 1 --json"),
      0)
      << text_of("err");
  EXPECT_NEAR(mean("drag_force_x_mean_N"), 20500.0, left * 20500.0);
  EXPECT_NEAR(mean("drag_force_y_mean_N"), 179375.0, left * 179375.0);
  EXPECT_NEAR(mean("mooring_force_y_mean_N"), -179375.0, left * 179375.0);
  // round: 1025 x 0.8 x 40 x 10 / 2 times |U| U, |U|^2 = 1.25
  const double round = 164000.0 * std::sqrt(1.25);
  ASSERT_EQ(shell(std::string(dragged) + "--set platform.start_offset_m=[" + std::to_string(round / 5e5) + "," +
                  std::to_string(0.5 * round / 5e5) + "] --out round.h5 && gem analyse round.h5 --from 1 --json"),
            0)
      << text_of("err");
  EXPECT_NEAR(mean("drag_force_x_mean_N"), round, left * round);
  EXPECT_NEAR(mean("drag_force_y_mean_N"), 0.5 * round, left * round);
  ASSERT_EQ(shell("gem analyse round.h5 --from 1"), 0) << text_of("err");
  EXPECT_NE(line_of(text_of("out"), "drag_force_x_mean_N").find("1.8336e+05"), std::string::npos) << text_of("out");
  ASSERT_EQ(shell("gem run swing.toml -q --threads 1 && gem analyse swing.h5"), 0) << text_of("err");
  EXPECT_EQ(text_of("out").find("drag_force"), std::string::npos) << text_of("out");
}

TEST_F(CommandTest, AReportNamesWhatDragsThePlatform) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(shell(std::string(dragged) + "--out round.h5 && gem report round.h5 --out page"), 0) << text_of("err");
  EXPECT_NE(text_of("page/index.html").find("<th scope=\"row\">water drag averaged over the run, x</th>"),
            std::string::npos);
  EXPECT_NE(text_of("page/index.html").find("<th scope=\"row\">mooring force averaged over the run, y</th>"),
            std::string::npos);
  ASSERT_EQ(shell(std::string(dragged) +
                  "--set wind.velocity_m_per_s=[5.0,0.0] --set wind.platform_area_m2=100 --out windy.h5 && gem report "
                  "windy.h5 --out windy"),
            0)
      << text_of("err");
  EXPECT_NE(text_of("windy/index.html").find("water drag and wind averaged over the run, y</th>"), std::string::npos);
}

TEST_F(CommandTest, AnalyseCombinesRunsOfOneLength) {
  std::string files;
  for (const char* start : {"0.5", "0.8", "1.1", "1.4", "2.2"}) {
    const std::string file = std::string("run_") + start + ".h5";
    files += " " + file;
    ASSERT_EQ(shell("gem run swing.toml -q --until 200 --threads 1 --out " + file + " --set platform.start_offset_m=[" +
                    start + ",0]"),
              0)
        << text_of("err");
  }
  ASSERT_EQ(shell("gem analyse --json" + files), 0) << text_of("err");
  const auto object = nlohmann::json::parse(text_of("out"));
  EXPECT_EQ(object.at("runs").size(), 5u);
  const auto largest = object.at("over_runs").at("x_largest_m");
  EXPECT_EQ(largest.at("runs"), 5);
  EXPECT_NEAR(largest.at("mean").at("value").get<double>(), 1.2, 1e-12);
  EXPECT_LT(largest.at("mean").at("low").get<double>(), 1.2);
  const auto extreme = object.at("extremes").at("x_largest_m");
  EXPECT_GT(extreme.at("p90").at("value").get<double>(), extreme.at("most_probable").at("value").get<double>());
  ASSERT_EQ(shell("gem analyse" + files), 0);
  EXPECT_NE(text_of("out").find("most probable"), std::string::npos) << text_of("out");
}

TEST_F(CommandTest, AnalyseRefusesWhatItCannotJudge) {
  ASSERT_EQ(shell("gem run swing.toml -q --threads 1 && gem run swing.toml -q --threads 1 --until 40 --out long.h5"),
            0);
  EXPECT_EQ(shell("gem analyse swing.h5 --from 19"), 2);
  EXPECT_NE(text_of("err").find("too short"), std::string::npos) << text_of("err");
  EXPECT_EQ(shell("gem analyse swing.h5 --from nan"), 2);
  EXPECT_EQ(shell("gem analyse swing.h5 --from -1"), 2);
  EXPECT_EQ(shell("gem analyse swing.h5 long.h5"), 2);
  EXPECT_NE(text_of("err").find("one length"), std::string::npos) << text_of("err");
  EXPECT_EQ(shell("gem analyse missing.h5"), 4);
  ASSERT_EQ(shell("gem run swing.toml -q --threads 1 --out soft.h5 --set mooring.stiffness_N_per_m=5e4"), 0);
  EXPECT_EQ(shell("gem analyse swing.h5 soft.h5"), 2);
  EXPECT_NE(text_of("err").find("not the same condition as swing.h5 (stiffness_N_per_m"), std::string::npos)
      << text_of("err");
  EXPECT_EQ(shell("gem analyse swing.h5 swing.h5"), 2);
  EXPECT_NE(text_of("err").find("the same run as swing.h5"), std::string::npos) << text_of("err");
  EXPECT_EQ(shell("gem run swing.toml -q --threads 1 --out copy.h5 && gem analyse swing.h5 copy.h5"), 2);
  EXPECT_NE(text_of("err").find("copy.h5: the same run as swing.h5"), std::string::npos) << text_of("err");
}

TEST_F(CommandTest, AnalyseSaysWhichRunsAreNotToBeBelieved) {
  const std::string run = "gem run " GEM_SOURCE_DIR "/cases/small_sweep.toml --index 1 -q --threads 1 ";
  ASSERT_EQ(shell(run + "--out fine.h5; for seed in 1 2; do " + run +
                  "--set contact.solver=coupled --set numerics.iteration=gradient --set numerics.iterations_maximum=1 "
                  "--set run.seed=$seed --set "
                  "platform.start_offset_m=[0.$seed,0] --out bad$seed.h5; done"),
            0)
      << text_of("err");
  ASSERT_EQ(shell("gem analyse fine.h5"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("verdict                         good\n"), std::string::npos) << text_of("out");
  ASSERT_EQ(shell("gem analyse bad1.h5"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("verdict                         bad\n"), std::string::npos) << text_of("out");
  EXPECT_NE(text_of("out").find("    bad         residual: "), std::string::npos) << text_of("out");
  ASSERT_EQ(shell("gem analyse bad1.h5 --json"), 0) << text_of("err");
  const auto object = nlohmann::json::parse(text_of("out"));
  EXPECT_EQ(object.at("verdict"), "bad");
  EXPECT_EQ(object.at("verdict_criteria").size(), 6u);
  ASSERT_EQ(shell("gem analyse bad1.h5 bad2.h5"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("verdict                         2 bad\n    bad1.h5: bad: "), std::string::npos)
      << text_of("out");
}

}  // namespace
}  // namespace gem
