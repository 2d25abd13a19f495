// gem view writes one page or refuses, and gem run --view ends by itself when nobody looks.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "gem/command/command_fixture.h"

namespace gem {
namespace {

TEST_F(CommandTest, APageIsWrittenAndWrittenAgain) {
  ASSERT_EQ(shell("gem run swing.toml --out swing.h5 -q && gem view swing.h5 --out page.html"), 0) << text_of("err");
  EXPECT_EQ(text_of("out"), "page.html\n");
  EXPECT_NE(text_of("page.html").find("<title>swing - gem view</title>"), std::string::npos);
  EXPECT_EQ(shell("gem view swing.h5 --out page.html"), 0) << text_of("err");
  EXPECT_FALSE(exists("page.html.new"));
}

TEST_F(CommandTest, WhatIsNoPageIsNotReplaced) {
  ASSERT_EQ(shell("gem run swing.toml --out swing.h5 -q && echo notes > notes.html"), 0);
  EXPECT_EQ(shell("gem view swing.h5 --out notes.html"), 4);
  EXPECT_EQ(text_of("notes.html"), "notes\n");
  EXPECT_EQ(shell("gem view swing.h5 --out notes.html --overwrite"), 0) << text_of("err");
  EXPECT_EQ(shell("gem view swing.h5 --out missing/page.html"), 4);
  EXPECT_EQ(shell("gem view swing.h5 --overwrite"), 2);
  EXPECT_EQ(shell("gem view swing.toml --out page.html"), 4);
  EXPECT_FALSE(exists("page.html"));
}

TEST_F(CommandTest, ThePageOfAnotherRunIsNotReplaced) {
  ASSERT_EQ(shell("gem run swing.toml --out swing.h5 -q && gem run swing.toml --out swing2.h5 -q --set run.name=other"),
            0);
  ASSERT_EQ(shell("gem view swing.h5 --out page.html && cp page.html kept.html"), 0);
  EXPECT_EQ(shell("gem view swing2.h5 --out page.html"), 4);
  EXPECT_NE(text_of("err").find("it is the page of another run"), std::string::npos) << text_of("err");
  EXPECT_EQ(shell("cmp page.html kept.html"), 0);
  EXPECT_EQ(shell("gem view swing2.h5 --out page.html --overwrite"), 0) << text_of("err");
  EXPECT_EQ(shell("cmp page.html kept.html"), 1);
}

TEST_F(CommandTest, ThePageKnowsCurrentAndWindOverTime) {
  const auto drive_of = [this](const std::string& settings) {
    EXPECT_EQ(shell("gem run swing.toml --overwrite --out swing.h5 -q --threads 1 " + settings +
                    " && gem view swing.h5 --out page.html --overwrite"),
              0)
        << text_of("err");
    const std::string page = text_of("page.html"), tag = "application/json\">";
    const std::size_t from = page.find(tag) + tag.size();
    return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from)).at("drive");
  };
  const auto steady = drive_of("--set current.velocity_m_per_s=[0.3,0.1]");
  EXPECT_EQ(steady.at("current_m_per_s"), nlohmann::json::parse("[[0.3, 0.1]]"));
  EXPECT_TRUE(steady.at("wind_m_per_s").is_null());
  // turns by a right angle in the 20 s of the run; rows are the middles of time steps of 0.1 s
  const auto turning = drive_of(
      "--set current.direction_table=[[0,0.2,0],[20,0.2,1.5707963267948966]] --set wind.velocity_m_per_s=[5.0,0.0]");
  ASSERT_EQ(turning.at("current_m_per_s").size(), 241u);
  EXPECT_NEAR(turning.at("current_m_per_s").at(0).at(0).get<double>(), 0.2, 1e-5);
  EXPECT_NEAR(turning.at("current_m_per_s").at(120).at(0).get<double>(), 0.2 * std::sqrt(0.5), 2e-3);
  EXPECT_NEAR(turning.at("current_m_per_s").at(240).at(1).get<double>(), 0.2, 1e-5);
  EXPECT_EQ(turning.at("wind_m_per_s").at(240), nlohmann::json::parse("[5.0, 0.0]"));
}

// Nobody can find a page whose address was not written. The command would serve it until it is stopped.
TEST_F(CommandTest, ThePageIsNotServedIfItsAddressCannotBeWritten) {
  ASSERT_EQ(shell("gem run swing.toml --out swing.h5 -q --threads 1"), 0);
  const std::string view = "timeout 20 '" GEM_PROGRAM "' view swing.h5 --no-browser ";
  const auto refuses = [&](const std::string& line, const std::string& why) {
    const int code = shell(line);
    if (text_of("err").find("cannot serve a page") != std::string::npos) return;  // built without a server
    EXPECT_EQ(code, 4) << line << "\n" << text_of("err");
    EXPECT_NE(text_of("err").find("cannot write to standard output (" + why), std::string::npos) << text_of("err");
  };
  refuses(view + ">&-", "it is closed");
  refuses(view + ">/dev/full", "");
  refuses("(sleep 0.3; " + view + ") | true; exit ${PIPESTATUS[0]}", "its reader has gone");
}

TEST_F(CommandTest, AShownRunEndsByItselfWhenNobodyLooks) {
  ASSERT_EQ(shell("gem run swing.toml --out bare.h5 -q"), 0);
  const int code = shell("gem run swing.toml --out seen.h5 --view --no-browser");
  if (text_of("err").find("cannot be served") != std::string::npos) GTEST_SKIP() << "built without a server";
  EXPECT_EQ(code, 0) << text_of("err");
  EXPECT_NE(text_of("err").find("the run is shown at http://127.0.0.1:"), std::string::npos) << text_of("err");
  ASSERT_EQ(shell("gem info bare.h5 | grep state_hash > a && gem info seen.h5 | grep state_hash > b && cmp a b"), 0);
  EXPECT_EQ(shell("gem run swing.toml --no-browser"), 2);
  EXPECT_EQ(shell("gem run swing.toml --view --dry-run"), 2);
}

}  // namespace
}  // namespace gem
