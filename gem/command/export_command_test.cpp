// gem export as its users call it. What VTK reads from it is tested by scripts/check_export.py.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gem/base/number_text.h"
#include "gem/command/command_fixture.h"
#include "gem/field/files/floe_file.h"
#include "gem/record/run_file/run_file.h"

namespace gem {
namespace {

class ExportTest : public CommandTest {
 protected:
  /// A jam of 60 floes at the platform, where floes overlap.
  void run_jam() {
    ASSERT_EQ(shell("gem run " GEM_SOURCE_DIR
                    "/cases/first.toml --threads 1 -q --out jam.h5 --set run.duration_s=60 --set floes.count=60 "
                    "--set floes.length_m=100.0 --set floes.width_m=60.0 --set floes.start_x_m=-135.0 "
                    "--set 'current.velocity_m_per_s=[1.0, 0.0]' --set numerics.time_step_s=0.05"),
              0)
        << text_of("err");
  }
};

TEST_F(ExportTest, AFrameIsAFloeFileThatRuns) {
  run_jam();
  ASSERT_EQ(shell("gem export jam.h5 at.geojson --at 0.7min"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("60 floes at 40 s"), std::string::npos) << text_of("out");
  EXPECT_NE(text_of("out").find("of them overlap"), std::string::npos) << "the jam must be one: " << text_of("out");
  const std::vector<FloeDef> floes = read_floe_file(path("at.geojson")).floes;
  const RunFile run(path("jam.h5"));
  ASSERT_EQ(floes.size(), 60u);
  const auto thickness = run.column("shape/thickness");
  for (std::size_t i = 0; i < floes.size(); ++i) EXPECT_EQ(floes[i].thickness_m, thickness[i]);
  // In a case of its own the frame is a valid field, with the platform where it was.
  const auto platform = nlohmann::json::parse(text_of("at.geojson")).at("platform");
  std::ofstream(path("again.toml")) << "include = [\"" GEM_SOURCE_DIR "/cases/first.toml\"]\n[floes]\nsource = "
                                    << "\"file\"\npath = \"at.geojson\"\n[platform]\nstart_offset_m = "
                                    << platform.at("start_offset_m").dump() << '\n';
  EXPECT_EQ(shell("gem run again.toml --until 1 -q --threads 1"), 0) << text_of("err");
}

TEST_F(ExportTest, AFrameOfATurnedShipInTransitRuns) {
  ASSERT_EQ(shell("gem run " GEM_SOURCE_DIR "/cases/ship_transit.toml --threads 1 -q --out way.h5 --until 300"), 0)
      << text_of("err");
  ASSERT_EQ(shell("gem export way.h5 way.geojson --at 300"), 0) << text_of("err");
  const auto platform = nlohmann::json::parse(text_of("way.geojson")).at("platform");
  ASSERT_GT(std::abs(platform.at("yaw_rad").get<double>()), 0.1) << "the ship must have turned";
  for (const FloeDef& floe : read_floe_file(path("way.geojson")).floes) ASSERT_GE(floe.outline_m.size(), 3u);
  const double yaw = platform.at("yaw_rad").get<double>();
  std::ofstream(path("on.toml")) << "[run]\nduration_s = 10.0\n[current]\nvelocity_m_per_s = [0.0, 0.0]\n"
                                 << "[floes]\nsource = \"file\"\npath = \"way.geojson\"\n"
                                 << "[boundary]\npresent = false\n[platform]\noutline = \"ship\"\nlength_m = 110.0\n"
                                 << "beam_m = 22.0\nbow_length_m = 30.0\nstern_length_m = 20.0\nmass_kg = 1.5e7\n"
                                 << "start_offset_m = " << platform.at("start_offset_m").dump()
                                 << "\nstart_yaw_rad = " << platform.at("yaw_rad").dump()
                                 << "\n[mooring]\nstiffness_N_per_m = 0.0\n"
                                 << "[transit]\nspeed_m_per_s = 2.0\ncourse_rad = "
                                 << number_text(3.141592653589793 + yaw) << "\n[numerics]\ntime_step_s = 0.05\n";
  EXPECT_EQ(shell("gem run on.toml --until 1 -q --threads 1"), 0) << text_of("err");
}

TEST_F(ExportTest, ThrustersHaveColumnsOfTheirOwn) {
  ASSERT_EQ(shell("gem run " GEM_SOURCE_DIR "/cases/dp_drillship.toml --threads 1 -q --out dp.h5 --until 5"), 0)
      << text_of("err");
  ASSERT_EQ(shell("gem export dp.h5 dp.csv"), 0) << text_of("err");
  const RunFile run(path("dp.h5"));
  const std::vector<double> thrust = run.column("platform/thruster_force_x");
  std::istringstream lines(text_of("dp.csv"));
  std::string line, cell;
  std::getline(lines, line);
  std::vector<std::string> header;
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) header.push_back(cell);
  const auto place = [&](const std::string& name) {
    return std::size_t(std::find(header.begin(), header.end(), name) - header.begin());
  };
  ASSERT_LT(place("dp_offset_yaw_rad"), header.size());
  const std::size_t second = place("thruster_force_x_1_N");
  ASSERT_LT(second, header.size()) << line;
  const std::size_t rows = run.column("platform/time").size(), thrusters = thrust.size() / rows;
  for (std::size_t row = 0; row < rows; ++row) {
    ASSERT_TRUE(std::getline(lines, line));
    std::istringstream cells(line);
    for (std::size_t c = 0; c <= second; ++c) std::getline(cells, cell, ',');
    EXPECT_EQ(parse_number(cell).value(), thrust[row * thrusters + 1]);
  }
}

TEST_F(ExportTest, ATableReadsBackExactly) {
  run_jam();
  ASSERT_EQ(shell("gem export jam.h5 platform.csv && gem export jam.h5 hits.csv --table events"), 0) << text_of("err");
  const RunFile run(path("jam.h5"));
  const struct {
    const char* file;
    const char* dataset;
    const char* header;
  } rows[] = {{"platform.csv", "platform/mooring_force_x", "mooring_force_x_N"},
              {"hits.csv", "events/impulse", "impulse_N_s"},
              {"hits.csv", "events/closing_speed", "closing_speed_m_per_s"}};
  for (const auto& row : rows) {
    const std::vector<double> wanted = run.column(row.dataset);
    ASSERT_FALSE(wanted.empty()) << row.dataset;
    std::istringstream lines(text_of(row.file));
    std::string line, cell;
    std::getline(lines, line);
    std::istringstream header(line);
    std::size_t column = 0;
    while (std::getline(header, cell, ',') && cell != row.header) ++column;
    ASSERT_EQ(cell, row.header);
    std::size_t read = 0;
    for (; std::getline(lines, line); ++read) {
      std::istringstream cells(line);
      for (std::size_t c = 0; c <= column; ++c) std::getline(cells, cell, ',');
      const auto value = parse_number(cell);
      ASSERT_TRUE(value) << cell;
      const bool single = std::string(row.dataset).starts_with("events");
      EXPECT_EQ(single ? double(float(*value)) : *value, wanted.at(read));
    }
    EXPECT_EQ(read, wanted.size());
  }
  // floes have the numbers that the page of gem view shows
  const std::string header = text_of("hits.csv").substr(0, text_of("hits.csv").find('\n'));
  EXPECT_TRUE(header.starts_with("time_s,floe,x_m,")) << header;
  std::istringstream first(text_of("hits.csv").substr(header.size() + 1));
  std::string cell;
  std::getline(first, cell, ',');
  std::getline(first, cell, ',');
  EXPECT_EQ(parse_number(cell), run.column("events/body_b").at(0) - run.number_attribute("gem_first_floe_body"));
}

TEST_F(ExportTest, NothingIsReplacedUnasked) {
  ASSERT_EQ(shell("gem run swing.toml -q"), 0) << text_of("err");
  std::ofstream(path("a.csv")) << "mine";
  EXPECT_EQ(shell("gem export swing.h5 a.csv"), 4);
  EXPECT_EQ(text_of("a.csv"), "mine");
  EXPECT_EQ(shell("gem export swing.h5 a.csv --overwrite"), 0) << text_of("err");
  EXPECT_NE(text_of("a.csv"), "mine");
  // A folder of that name with something else in it stays, even with --overwrite.
  std::filesystem::create_directory(path("b_vtp"));
  std::ofstream(path("b_vtp/notes.txt")) << "mine";
  EXPECT_EQ(shell("gem export swing.h5 b.pvd"), 4);
  EXPECT_EQ(shell("gem export swing.h5 b.pvd --overwrite"), 4);
  EXPECT_NE(text_of("err").find("notes.txt"), std::string::npos) << text_of("err");
  EXPECT_EQ(text_of("b_vtp/notes.txt"), "mine");
  EXPECT_FALSE(exists("b.pvd"));
  ASSERT_EQ(shell("gem export swing.h5 '<c>&.pvd' && gem export swing.h5 '<c>&.pvd' --overwrite"), 0) << text_of("err");
  EXPECT_NE(text_of("<c>&.pvd").find("&lt;c>&amp;_vtp/platform_000000.vtp"), std::string::npos);
  const std::string platform = text_of("<c>&_vtp/platform_000000.vtp");
  EXPECT_NE(platform.find("NumberOfComponents=\"1\" format=\"binary\">"), std::string::npos);
  EXPECT_EQ(platform.find("AppendedData"), std::string::npos) << "some versions of ParaView cannot read it";
  EXPECT_FALSE(exists(".<c>&_vtp.new"));
}

TEST_F(ExportTest, MistakesAreNamed) {
  ASSERT_EQ(shell("gem run swing.toml -q"), 0) << text_of("err");
  const struct {
    const char* call;
    int code;
    const char* reason;
  } rows[] = {
      {"gem export swing.h5 a.vtk", 2, "allowed are .pvd, .geojson and .csv"},
      {"gem export swing.h5 a.csv --at 3", 2, "--at has no effect on .csv"},
      {"gem export swing.h5 a.geojson --table stats", 2, "--table has no effect on .geojson"},
      {"gem export swing.h5 a.pvd --every soon", 2, "--every soon is not a time"},
      {"gem export swing.h5 a.geojson", 2, "no floe takes part"},
      {"gem export swing.h5 a.geojson --at 1h", 2, "the record ends at 20 s"},
      {"gem export swing.toml a.csv", 4, "swing.toml"},
      {"gem export swing.h5 nowhere/a.csv", 4, "nowhere"},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(shell(row.call), row.code) << row.call;
    EXPECT_NE(text_of("err").find(row.reason), std::string::npos) << text_of("err");
  }
  EXPECT_FALSE(exists("a.csv") || exists("a.pvd") || exists("a_vtp") || exists("a.geojson"));
}

}  // namespace
}  // namespace gem
