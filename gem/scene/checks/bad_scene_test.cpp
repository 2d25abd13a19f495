// Bad input: every error is reported with its place, key, value and range. Nothing is repaired.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "gem/scene/checks/bad_scene.h"
#include "gem/scene/toml/document.h"

namespace gem {
namespace {

TEST_P(BadSceneTest, IsRefusedWithItsPlace) {
  const std::string message = rejection(GetParam().text);
  for (const std::string& part : GetParam().expected)
    EXPECT_NE(message.find(part), std::string::npos) << "expected: " << part << "\nmessage: " << message;
}

TEST(BadScene, AllProblemsAreReportedTogetherOneLineEach) {
  const std::string message = rejection("[platform]\nmas = 1\nsides = 2\n[floes]\ncount = \"x\"\n[nothing]\n");
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 3) << message;
  for (const char* place : {"bad.toml:2:1", "bad.toml:3:9", "bad.toml:5:9", "bad.toml:6:2"})
    EXPECT_NE(message.find(place), std::string::npos) << place << " in " << message;
}

TEST(BadScene, AnUnknownKeyLikeNoOtherGetsAHint) {
  const std::string message = rejection("[nothing]\nx = 1\n[run]\nqqqqqqqqqqqqqqqqqq = 1\n[[floe]]\nqqqqqqqqqq = 1\n");
  EXPECT_EQ(message.find(";\n"), std::string::npos) << message;
  EXPECT_NE(message.find("nothing: unknown section; `gem case explain` lists all keys"), std::string::npos) << message;
  EXPECT_NE(message.find("unknown key; `gem case explain` lists all keys"), std::string::npos) << message;
}

TEST(BadScene, OverridesNameThemselves) {
  EXPECT_NE(rejection("", {"platform.mas=3"}).find("--set platform.mas=3: platform.mas: unknown key"),
            std::string::npos);
  EXPECT_NE(rejection("", {"--until run.duration_s=-5"}).find("--until -5: run.duration_s: out of range"),
            std::string::npos);
  EXPECT_NE(rejection("", {"contact.solver=coupled contacts"}).find("needs quotes"), std::string::npos);
  EXPECT_NE(rejection("", {"ice.class[1].thickness_m=0.7"}).find("give the whole list"), std::string::npos);
  EXPECT_EQ(rejection("", {"ice.class=[{name=\"thin\", thickness_m=0.7, tenths=4}]"}), "accepted");
  EXPECT_EQ(rejection("", {"floes.path=ice.csv"}),
            "--set floes.path=ice.csv: floes.path: a text needs quotes (value ice.csv); write \"ice.csv\", in a shell "
            "--set 'floes.path=\"ice.csv\"'");
  EXPECT_EQ(rejection("", {"platform_drag.law=by-axis"}),
            "--set platform_drag.law=by-axis: platform_drag.law: a text needs quotes (value by-axis, allowed round, "
            "by_axis); write \"by_axis\", in a shell --set 'platform_drag.law=\"by_axis\"'");
  EXPECT_EQ(rejection("", {"run.duration_s=20min"}),
            "--set run.duration_s=20min: run.duration_s: a number with a unit (value 20min); write the number alone; "
            "the unit is in the key's name");
  EXPECT_NE(rejection("", {"run.name=20min"}).find("a text needs quotes (value 20min)"), std::string::npos);
  // An unquoted word is a text.
  EXPECT_NE(rejection("", {"contact.solver=couple"}).find("--set contact.solver=couple: contact.solver"),
            std::string::npos);
  EXPECT_NE(rejection("", {"platform.mass_kg=heavy"}).find("--set platform.mass_kg=heavy"), std::string::npos);
  EXPECT_EQ(find_path(parse_override("contact.solver=coupled"), "contact.solver")->text, "coupled");
  EXPECT_EQ(find_path(parse_override("contact.solver='coupled'"), "contact.solver")->text, "coupled");
  EXPECT_EQ(find_path(parse_override("drag=true"), "drag")->kind,
            find_path(parse_override("drag=false"), "drag")->kind);
  EXPECT_NE(find_path(parse_override("drag=true"), "drag")->kind,
            find_path(parse_override("drag=truth"), "drag")->kind);
}

}  // namespace
}  // namespace gem
