// A sweep with draws from its file to its page, as users make it.
#include <nlohmann/json.hpp>

#include "gem/command/command_fixture.h"
#include "gem/record/summary/summary_file.h"

namespace gem {
namespace {

using Json = nlohmann::json;

class SweepDrawCommandTest : public CommandTest {
 protected:
  static std::string run(const std::string& out, const std::string& more = "") {
    return "gem sweep run '" GEM_SOURCE_DIR
           "/cases/small_draws.toml' --set sweep.draw.count=15 --set run.duration_s=25 --out " +
           out + " --threads 1 --quiet " + more;
  }
  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }
  std::string error_of(const std::string& line, int code) {
    EXPECT_EQ(shell(line), code) << text_of("err");
    return text_of("err");
  }
};

TEST_F(SweepDrawCommandTest, AnyNumberOfJobsGivesTheSamePage) {
  ASSERT_EQ(shell("mkdir x y && " + run("x/draws", "--jobs 1") + " && " + run("y/draws", "--jobs 2")), 0)
      << text_of("err");
  ASSERT_EQ(shell("gem sweep sensitivity x/draws && gem sweep sensitivity y/draws && "
                  "diff -r x/draws_sensitivity y/draws_sensitivity"),
            0)
      << text_of("out") << text_of("err");
  const std::string page = text_of("x/draws_sensitivity/index.html");
  for (const char* words : {"30 of 30 runs", "uniform from 0.02 to 0.3", "ice.class.thickness_m", "15 draws, 30 runs",
                            "shares_1.csv", "scatter_1_4.csv"})
    EXPECT_NE(page.find(words), std::string::npos) << words;

  EXPECT_EQ(shell("gem sweep status x/draws"), 0);
  EXPECT_NE(text_of("out").find("friction=0."), std::string::npos) << text_of("out");
  EXPECT_EQ(shell("gem sweep status x/draws --json"), 0);
  const Json row = Json::parse(text_of("out")).at(3);
  EXPECT_EQ(row.at("name"), "d2_r2");
  EXPECT_EQ(row.at("draw").at("repeat"), 2);
  ASSERT_EQ(shell("gem sweep collect x/draws --out table.nc.h5"), 0) << text_of("err");
  const SummaryTable table = read_summary(path("table.nc.h5"));
  EXPECT_EQ(table.column("drawn_friction")->numbers.at(3), row.at("draw").at("values").at(0).at("value").get<double>());
  EXPECT_EQ(table.column("draw")->numbers.at(3), 2.0);

  EXPECT_EQ(shell("rm x/draws/d3_r1.h5"), 0);
  EXPECT_NE(error_of("gem sweep sensitivity x/draws", 4).find("holds 29 done runs of 30"), std::string::npos);
  ASSERT_EQ(shell("gem sweep sensitivity x/draws --partial --json --measure x_offset_m"), 0) << text_of("err");
  const Json effects = Json::parse(text_of("out")).at("conditions").at(0).at("measures").at(0);
  EXPECT_EQ(effects.at("measure"), "x_offset_m");
  EXPECT_EQ(effects.at("draws"), 14);
  EXPECT_EQ(effects.at("draws_left_out"), 1);
  EXPECT_TRUE(effects.at("inputs").at(0).at("linear").at("share").at("value").is_number());
  EXPECT_NE(error_of("gem sweep sensitivity x/draws --partial --measure ice_force_x_maen_N", 2)
                .find("did you mean `ice_force_x_mean_N`"),
            std::string::npos);
}

TEST_F(SweepDrawCommandTest, TextsOfAManifestAreEscaped) {
  ASSERT_EQ(shell(run("draws")), 0) << text_of("err");
  Json manifest = Json::parse(text_of("draws/manifest.json"));
  for (Json& row : manifest.at("runs")) {
    row.at("draw").at("condition") = "<script>alert(1)</script>'`touch taken`\n!touch taken\n";
    row.at("draw").at("values").at(0).at("law") = "<img src=x onerror=alert(1)>";
    row.at("draw").at("values").at(0).at("key") = "\"><b>";
  }
  write("draws/manifest.json", manifest.dump());
  ASSERT_EQ(shell("gem sweep sensitivity draws"), 0) << text_of("err");
  const std::string page = text_of("draws_sensitivity/index.html");
  EXPECT_NE(page.find("&lt;script&gt;alert(1)"), std::string::npos);
  for (const char* bad : {"<script", "<img", "<b>"}) EXPECT_EQ(page.find(bad), std::string::npos) << bad;
  EXPECT_FALSE(exists("taken") || exists("draws_sensitivity/figures/taken"));

  manifest.at("runs").at(0).at("draw").at("values").at(0).at("variable") = "../a'";
  write("draws/manifest.json", manifest.dump());
  EXPECT_NE(error_of("gem sweep sensitivity draws", 4).find("a variable has no plain name"), std::string::npos);
}

TEST_F(SweepDrawCommandTest, FoldersWithoutDrawsAreRefused) {
  write("list.toml", "include = [\"swing.toml\"]\n[sweep]\nmode = \"list\"\n[[sweep.run]]\nname = \"a\"\n");
  ASSERT_EQ(shell("gem sweep run list.toml --out list --quiet"), 0) << text_of("err");
  EXPECT_NE(error_of("gem sweep sensitivity list", 2).find("has no drawn inputs"), std::string::npos);
  EXPECT_NE(error_of("gem sweep sensitivity nowhere", 4).find("is not the folder of a sweep"), std::string::npos);
}

}  // namespace
}  // namespace gem
