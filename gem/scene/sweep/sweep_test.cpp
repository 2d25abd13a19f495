// Sweeps give exactly the paper's runs, every shipped case is accepted, and the schema is consistent.
#include "gem/scene/sweep/sweep.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "gem/base/error.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/case_text.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

const std::string cases = GEM_SOURCE_DIR "/cases/";

TEST(Table1, NamesDurationsAndParametersAreThePapers) {
  struct Ice {
    std::string name;
    std::vector<double> thickness, tenths;
  };
  const std::vector<Ice> sets = {
      {"004", {0.5}, {4}}, {"040", {0.7}, {4}}, {"400", {1.2}, {4}}, {"121", {1.2, 0.7, 0.5}, {1, 2, 1}}};
  const std::vector<std::pair<int, double>> gaps = {{400, 1800.0}, {300, 2400.0}, {200, 3800.0}};
  const std::vector<SweepMember> members = expand_sweep(cases + "table1.toml");
  ASSERT_EQ(members.size(), 36u);
  std::size_t i = 0;
  double hours = 0.0;
  for (const Ice& ice : sets)
    for (const auto& [gap, drift] : gaps)
      for (const int speed : {25, 50, 100}) {
        const SweepMember& m = members[i++];
        EXPECT_EQ(m.index, static_cast<std::int64_t>(i));
        EXPECT_EQ(m.name, ice.name + "_" + std::to_string(gap) + "_" + std::to_string(speed));
        EXPECT_EQ(m.scene.run.name, m.name);
        EXPECT_EQ(m.scene.boundary.gap_m, gap) << m.name;
        EXPECT_EQ(m.scene.current.velocity_m_per_s.x, speed / 100.0) << m.name;
        EXPECT_EQ(m.scene.run.duration_s, drift / (speed / 100.0)) << m.name;
        EXPECT_EQ(m.scene.numerics.time_step_s, speed == 100 ? 0.05 : 0.1) << m.name;
        ASSERT_EQ(m.scene.floes.classes.size(), ice.tenths.size()) << m.name;
        for (std::size_t c = 0; c < ice.tenths.size(); ++c) {
          EXPECT_EQ(m.scene.floes.classes[c].thickness_m, ice.thickness[c]) << m.name;
          EXPECT_EQ(m.scene.floes.classes[c].tenths, ice.tenths[c]) << m.name;
        }
        hours += m.scene.run.duration_s / 3600.0;
      }
  // With the five repeats of two hours this is the paper's "about 72 hours".
  EXPECT_NEAR(hours + 5 * 2.0, 72.0, 0.5);
}

TEST(Table1, FirstRunIsTheMainCase) {
  const std::vector<SweepMember> members = expand_sweep(cases + "table1.toml");
  EXPECT_EQ(scene_hash(members.at(0).scene), scene_hash(read_scene(cases + "004_400_25.toml")));
  EXPECT_TRUE(members.at(0).differences.empty());
  EXPECT_EQ(members.at(1).differences,
            (std::vector<std::string>{"run.duration_s=3600.0", "current.velocity_m_per_s=[0.5, 0.0]"}));
}

TEST(Table2, SixRunsWithThePapersNames) {
  const std::vector<SweepMember> members = expand_sweep(cases + "table2.toml");
  const std::vector<std::string> names = {"004_400_25",    "004_400_25(2)",    "004_400_25_F",
                                          "004_400_25_WD", "004_400_25_50kND", "004_400_25_50k_WD"};
  ASSERT_EQ(members.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const SceneDef& scene = members[i].scene;
    EXPECT_EQ(members[i].name, names[i]);
    EXPECT_EQ(scene.mooring.stiffness_N_per_m, i < 4 ? 5e5 : 5e4) << names[i];
    EXPECT_EQ(scene.platform_drag.present, i == 3 || i == 5) << names[i];
    EXPECT_EQ(scene.run.duration_s, 7200.0) << names[i];
  }
}

TEST(ShippedCases, AreAllAcceptedAndComeBackAsThemselves) {
  int singles = 0;
  int sweeps = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(cases)) {
    if (entry.path().extension() != ".toml") continue;
    SCOPED_TRACE(entry.path().string());
    std::vector<SceneDef> scenes;
    if (is_sweep(entry.path().string())) {
      for (const SweepMember& member : expand_sweep(entry.path().string())) scenes.push_back(member.scene);
      ++sweeps;
    } else {
      scenes.push_back(read_scene(entry.path().string()));
      ++singles;
    }
    for (const SceneDef& scene : scenes)
      EXPECT_EQ(resolved_toml(parse_scene(resolved_toml(scene), "resolved")), resolved_toml(scene));
  }
  EXPECT_GE(singles, 5);
  EXPECT_GE(sweeps, 2);
}

TEST(Sweep, SeedsRepeatEveryRun) {
  const auto members = expand_sweep_text(
      "[sweep]\nmode = \"list\"\nseeds = { count = 3, first = 5 }\n[[sweep.run]]\nname = \"a\"\n", "seeds.toml");
  ASSERT_EQ(members.size(), 3u);
  EXPECT_EQ(members[0].name, "a_s5");
  EXPECT_EQ(members[2].name, "a_s7");
  EXPECT_EQ(members[2].scene.run.seed, 7u);
  EXPECT_EQ(members[2].differences, std::vector<std::string>{"run.seed=7"});
}

TEST(Sweep, OverridesReachTheTableAndEveryMember) {
  const auto members = expand_sweep(cases + "table2.toml", {"sweep.seeds.count=2", "mooring.stiffness_N_per_m=1e5"});
  ASSERT_EQ(members.size(), 12u);
  for (const SweepMember& member : members) EXPECT_EQ(member.scene.mooring.stiffness_N_per_m, 1e5) << member.name;
}

struct BadSweep {
  const char* text;
  const char* expected;
};

TEST(Sweep, SizesHaveLimits) {
  const std::string product = "[sweep]\nmode = \"product\"\n", map = "map.gap = \"boundary.gap_m\"\n";
  std::string hundreds = "[300";
  for (int i = 1; i < 400; ++i) hundreds += ", " + std::to_string(300 + i);
  std::string floes = "[floes]\nsource = \"listed\"\n";
  for (int i = 0; i < 201; ++i) floes += "[[floe]]\noutline_m = [[0, 0], [9, 0], [9, 9]]\nposition_m = [-200, 0]\n";
  const struct {
    std::string text;
    const char* expected;
  } rows[] = {
      {product + "name = \"{a}{gap}\"\ngap = " + hundreds + "]\na = " + hundreds + "]\n" + map +
           "map.a = \"run.seed\"\n",
       "sweep: too many runs (allowed 100000)"},
      {product + "name = \"" + std::string(401, 'n') + "\"\ngap = [300]\n" + map, "sweep.name: too long"},
      {product + "name = \"{gap}\"\ngap = [\"" + std::string(201, 'v') + "\"]\n" + map,
       "a value of an axis is too long"},
      {floes + "[sweep]\nmode = \"list\"\nseeds = { count = 10000 }\n[[sweep.run]]\nname = \"a\"\n",
       "list too many floes and fixed bodies together"},
  };
  for (const auto& row : rows) {
    try {
      expand_sweep_text(row.text, "bad.toml");
      ADD_FAILURE() << "accepted: " << row.expected;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(row.expected), std::string::npos)
          << std::string(error.what()).substr(0, 300);
    }
  }
}

TEST(Sweep, FaultsAreNamedWithTheirPlace) {
  const std::vector<BadSweep> bad = {
      {"[run]\n", "bad.toml: sweep: missing"},
      {"[sweep]\n", "bad.toml:1:2: sweep.mode: missing"},
      {"[sweep]\nmode = \"produkt\"\n", "bad.toml:2:8: sweep.mode: unknown choice"},
      {"[sweep]\nmode = \"product\"\nname = \"a\"\n", "no axis"},
      {"[sweep]\nmode = \"product\"\ngap = [1]\n", "sweep.name: missing"},
      {"[sweep]\nmode = \"product\"\nname = \"{gap}\"\ngap = [300, 400]\n", "sweep.gap: the axis has no effect"},
      {"[sweep]\nmode = \"product\"\nname = \"a\"\ngap = []\n", "bad.toml:4:7: sweep.gap: the axis is empty"},
      {"[sweep]\nmode = \"product\"\nname = \"a\"\ngap = [true]\n", "bad.toml:4:8"},
      {"[sweep]\nmode = \"product\"\nname = \"a\"\ngap = [300, 400]\nmap.gap = \"boundary.gap_m\"\n",
       "two runs have the name \"a\""},
      {"[sweep]\nmode = \"product\"\nname = \"{gap}\"\ngap = [300]\nmap.gab = \"boundary.gap_m\"\n",
       "did you mean `gap`"},
      {"[sweep]\nmode = \"product\"\nname = \"{gap}\"\ngap = [300]\nmap.gap = \"boundary.gp_m\"\n",
       "bad.toml:4:8: boundary.gp_m: unknown key; did you mean `boundary.gap_m`"},
      {"[sweep]\nmode = \"product\"\nname = \"{gap}\"\ngap = [50]\nmap.gap = \"boundary.gap_m\"\n",
       "bad.toml:4:8: boundary.gap_m: the platform does not fit"},
      {"[sweep]\nmode = \"product\"\nname = \"{h}\"\nh = [0.5, 1.2]\nmap.h = \"ice.class.thickness_m\"\n",
       "bad.toml:5:9: sweep.map.h: map cannot address a list (value \"ice.class.thickness_m\"); give the list for each "
       "value: [sweep.set.h] with \"0.5\".ice.class = [{ ... }]"},
      {"[sweep]\nmode = \"product\"\nname = \"{i}\"\ni = [\"a\"]\nset.i.b.run.seed = 1\n", "no settings for \"a\""},
      {"[sweep]\nmode = \"product\"\nname = \"{i}\"\ni = [\"a\"]\nset.i.a.run.seed = 1\nset.i.b.run.seed = 1\n",
       "bad.toml:6:7: sweep.set.i: no run has the value \"b\""},
      {"[sweep]\nmode = \"list\"\nseeds.count = 0\n[[sweep.run]]\nname = \"a\"\n",
       "bad.toml:3:15: sweep.seeds.count: out of range"},
      {"[sweep]\nmode = \"list\"\n[[sweep.run]]\nmooring.stiffness_N_per_m = 1\n", "sweep.run.name: missing"},
      {"[sweep]\nmode = \"list\"\nrum = 1\n",
       "bad.toml:3:1: sweep.rum: unknown key (known are mode, run, seeds and draw); did you mean `run`"},
  };
  for (const BadSweep& sweep : bad) {
    try {
      expand_sweep_text(sweep.text, "bad.toml");
      ADD_FAILURE() << "accepted: " << sweep.text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::scene_rejected);
      EXPECT_NE(std::string(error.what()).find(sweep.expected), std::string::npos)
          << "expected: " << sweep.expected << "\nmessage: " << error.what();
    }
  }
}

TEST(CaseText, ExplainsEveryKeyAndSuggestsNames) {
  const std::string text = explain();
  for (const auto& option : scene_options())
    EXPECT_NE(text.find(option.path.substr(option.path.find('.') + 1) + " = "), std::string::npos) << option.path;
  EXPECT_NE(explain("platform.mass_kg").find("number, kg"), std::string::npos);
  const std::pair<const char*, const char*> rows[] = {{"platform.mas", "`platform.mass_kg`"},
                                                      {"boundry", "`boundary`"},
                                                      {"ice.clas", "`ice.class`"},
                                                      {"zzzzzz", "lists"}};
  for (const auto& [key, hint] : rows) {
    try {
      explain(key);
      ADD_FAILURE() << key << " accepted";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::usage);
      EXPECT_NE(std::string(error.what()).find(hint), std::string::npos) << error.what();
    }
  }
  EXPECT_EQ(nlohmann::json::parse(explain_json("platform")).size(), 19u);
}

TEST(CaseText, SchemaHoldsEveryOptionWithItsDefault) {
  const auto schema = nlohmann::json::parse(json_schema());
  for (const auto& option : scene_options()) {
    const std::size_t dot = option.path.find('.');
    const auto& section = schema.at("properties").at(option.path.substr(0, dot));
    EXPECT_FALSE(section.at("additionalProperties").get<bool>());
    const auto& entry = section.at("properties").at(option.path.substr(dot + 1));
    EXPECT_EQ(entry.contains("default"), option.type != OptionType::outline)
        << option.path << ": no outline is the default";
    EXPECT_FALSE(entry.at("description").get<std::string>().empty()) << option.path;
  }
  EXPECT_EQ(schema.at("properties").at("floe").at("items").at("required"), nlohmann::json::array({"outline_m"}));
}

TEST(CaseText, SweepListsAreReadableByMachine) {
  const std::vector<SweepMember> members = expand_sweep(cases + "table1.toml");
  EXPECT_NE(sweep_list_text(members).find("   36  121_200_100  run.duration_s=3800.0"), std::string::npos);
  const auto list = nlohmann::json::parse(sweep_list_json(members));
  ASSERT_EQ(list.size(), 36u);
  std::set<std::string> hashes;
  for (const auto& entry : list) hashes.insert(entry.at("sha256").get<std::string>());
  EXPECT_EQ(hashes.size(), 36u);
  EXPECT_EQ(list[35].at("name"), "121_200_100");
}

TEST(OptionTable, PathsAreUniqueAndDefaultsLieInTheirRange) {
  std::set<std::string> paths;
  const SceneDef defaults;
  for (const auto& option : scene_options()) {
    EXPECT_TRUE(paths.insert(option.path).second) << option.path;
    EXPECT_FALSE(option.doc.empty()) << option.path;
    const OptionValue value = option.get(defaults);
    if (const auto* number = std::get_if<double>(&value)) {
      EXPECT_TRUE(option.range.contains(*number)) << option.path;
    }
  }
}

}  // namespace
}  // namespace gem
