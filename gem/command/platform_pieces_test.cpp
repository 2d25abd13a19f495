// A platform of several pieces from the case to the file, the page, the film and exports.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "gem/command/command_fixture.h"
#include "gem/record/run_file/contact_record.h"
#include "gem/record/run_file/run_file.h"

namespace gem {
namespace {

class PlatformPieces : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::ofstream(path("columns.toml")) << R"([run]
name = "columns"
duration_s = 80.0
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
outline = "pieces"
mass_kg = 1e7
[output]
event_speed_m_per_s = 0.0
floes_interval_s = 5.0
contact_forces = true
side_loads = true
[[platform.piece]]
outline_m = [[-20, -20], [-10, -20], [-10, -10], [-20, -10]]
[[platform.piece]]
outline_m = [[-20, 10], [-10, 10], [-10, 20], [-15, 22], [-20, 20]]
[[platform.piece]]
outline_m = [[10, -20], [20, -20], [20, 20], [10, 20]]
[[fixed]]
outline_m = [[60, -60], [70, -60], [70, -50], [60, -50]]
)";
  }

  static std::string columns(const std::string& more) { return "gem run columns.toml --threads 1 -q " + more; }
};

TEST_F(PlatformPieces, AreOneBodyInTheFile) {
  ASSERT_EQ(shell(columns("--engine cpu")), 0) << text_of("err");
  const RunFile run(path("columns.h5"));
  EXPECT_EQ(run.column("shape/platform_first"), (std::vector<double>{0.0, 4.0, 9.0}));
  ASSERT_EQ(run.platform_pieces().size(), 3U);
  EXPECT_EQ(run.platform_pieces()[1].size(), 5U);
  EXPECT_EQ(run.platform_outline().size(), 13U);
  EXPECT_EQ(run.number_attribute("gem_first_floe_body"), 2.0) << "the platform is body 0, the fixed body 1";
  ASSERT_GT(run.rows("events/time"), 5U);
  for (const double body : run.column("events/body_a")) EXPECT_EQ(body, 0.0);
  for (const double body : run.column("events/body_b")) EXPECT_TRUE(body >= 2.0 && body < 62.0) << body;
  const ContactRecord record(run);  // throws if the numbers do not fit
  EXPECT_FALSE(record.at(70.0).empty());
  // every impulse is on a side of the piece that has it, and all sides have what the ice gives
  const std::vector<double> sides = run.column("platform/side_impulse"), hits = run.column("events/impulse");
  ASSERT_EQ(sides.size(), 13 * run.rows("platform/time"));
  const double all = std::accumulate(hits.begin(), hits.end(), 0.0);
  EXPECT_NEAR(std::accumulate(sides.begin(), sides.end(), 0.0), all, 1e-5 * all);
  double front = 0.0;
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (i % 13 == 3 || i % 13 == 8) front += sides[i];  // the left sides of the two small pieces
  EXPECT_GT(front, 0.2 * all);
}

TEST_F(PlatformPieces, ARunThatGoesOnIsTheOneThatNeverStopped) {
  ASSERT_EQ(
      shell(columns("--engine cpu --out whole.h5") + " && " + columns("--engine cpu --out parts.h5 --until 71.3") +
            " && gem run --continue parts.h5 -q --threads 1"),
      0)
      << text_of("err");
  const RunFile whole(path("whole.h5")), parts(path("parts.h5"));
  EXPECT_EQ(whole.attribute("gem_state_hash"), parts.attribute("gem_state_hash"));
  for (const char* name : {"platform/side_impulse", "platform/x", "events/body_b", "contacts/body_a"})
    EXPECT_EQ(whole.column(name), parts.column(name)) << name;
}

TEST_F(PlatformPieces, TheChoiceOfTheEngineTakesOneThatHasThem) {
  ASSERT_EQ(shell(columns("--until 1 --engine auto")), 0) << text_of("err");
  EXPECT_EQ(RunFile(path("columns.h5"), true).attribute("gem_engine"), "cpu");
}

TEST_F(PlatformPieces, StandOnThePageAndInExports) {
  ASSERT_EQ(shell(columns("") + " && gem view columns.h5 --out page.html && gem export columns.h5 vtk.pvd"), 0)
      << text_of("err");
  EXPECT_NE(text_of("page.html").find("\"pieces\":[[["), std::string::npos);
  const std::string cells = text_of("vtk_vtp/platform_000000.vtp");
  EXPECT_NE(cells.find("NumberOfPolys=\"3\""), std::string::npos) << cells.substr(0, 500);
}

TEST_F(PlatformPieces, StandInTheReport) {
  if (shell("command -v gnuplot") != 0) GTEST_SKIP() << "gnuplot is not installed";
  ASSERT_EQ(shell(columns("") + " && gem report columns.h5 --out report"), 0) << text_of("err");
  EXPECT_NE(text_of("report/index.html").find("piece 2, side 5"), std::string::npos);
}

TEST_F(PlatformPieces, TheNextRunBeginsWithThem) {
  ASSERT_EQ(
      shell(columns("") +
            " && gem run columns.toml --from columns.h5 --until 1 -q --threads 1 --out next.h5 --set run.name=next"),
      0)
      << text_of("err");
  EXPECT_EQ(RunFile(path("next.h5"), true).platform_pieces().size(), 3U);
}

}  // namespace
}  // namespace gem
