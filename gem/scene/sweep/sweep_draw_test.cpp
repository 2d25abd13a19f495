// Sweeps with drawn numbers: where the numbers go, and what is refused.
#include <gtest/gtest.h>

#include <set>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/sweep/sweep.h"
#include "gem/scene/toml/case_text.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

std::string variable(const std::string& name, const std::string& key, const std::string& law) {
  return "[sweep.draw.variable." + name + "]\nkey = \"" + key + "\"\n" + law + "\n";
}

const std::string friction = variable("friction", "ice.friction_ice", "law = \"uniform\"\nlow = 0.1\nhigh = 0.5");
const std::string seed = variable("field", "run.seed", "law = \"uniform\"\nlow = 1\nhigh = 1000");
const std::string draw_mode = "[sweep]\nmode = \"draw\"\n[sweep.draw]\n";

std::vector<SweepMember> expanded(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return expand_sweep_text(text, "draw.toml", overrides);
}

TEST(SweepDraw, EveryRunHasItsNumbers) {
  const auto members = expanded(draw_mode + "count = 8\n" + friction + seed);
  ASSERT_EQ(members.size(), 8u);
  std::set<double> drawn;
  for (std::size_t i = 0; i < members.size(); ++i) {
    const SweepMember& member = members[i];
    EXPECT_EQ(member.name, "d" + std::to_string(i + 1));
    EXPECT_EQ(member.scene.run.name, member.name);
    ASSERT_EQ(member.draw.values.size(), 2u);
    EXPECT_EQ(member.draw.values[0].key, "ice.friction_ice");
    EXPECT_EQ(member.draw.values[0].law, "uniform from 0.1 to 0.5");
    EXPECT_EQ(member.draw.values[0].value, member.scene.ice.friction_ice);
    EXPECT_EQ(member.draw.values[1].value, static_cast<double>(member.scene.run.seed));
    drawn.insert(member.scene.ice.friction_ice);
    EXPECT_NE(sweep_list_json(members).find("\"variable\": \"friction\""), std::string::npos);
    EXPECT_EQ(parse_scene(resolved_toml(member.scene), "resolved").ice.friction_ice, member.scene.ice.friction_ice);
  }
  EXPECT_EQ(drawn.size(), 8u);
}

TEST(SweepDraw, OtherVariablesAndOrderChangeNoNumber) {
  const auto alone = expanded(draw_mode + "count = 4\n" + friction);
  const auto after = expanded(draw_mode + "count = 4\n" + seed + friction);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(alone[i].scene.ice.friction_ice, after[i].scene.ice.friction_ice);
}

TEST(SweepDraw, AllConditionsGetTheSameDraws) {
  const auto members = expanded(
      "[sweep]\nmode = \"product\"\nname = \"g{gap}\"\ngap = [300, 240]\nmap = { gap = \"boundary.gap_m\" }\n"
      "[sweep.draw]\ncount = 3\n" +
      friction);
  ASSERT_EQ(members.size(), 6u);
  EXPECT_EQ(members[4].name, "g240_d2");
  EXPECT_EQ(members[4].draw.condition, "g240");
  EXPECT_EQ(members[4].draw.draw, 2);
  EXPECT_EQ(members[4].scene.boundary.gap_m, 240.0);
  EXPECT_EQ(members[4].scene.ice.friction_ice, members[1].scene.ice.friction_ice);
}

TEST(SweepDraw, FactorsPairsAndListsAreReached) {
  const auto members = expanded(
      "[current]\nvelocity_m_per_s = [0.5, 0.25]\n"
      "[[ice.class]]\nname = \"a\"\nthickness_m = 0.5\ntenths = 2.0\n"
      "[[ice.class]]\nname = \"b\"\nthickness_m = 1.0\ntenths = 2.0\n" +
      draw_mode + "count = 5\n" +
      variable("thickness", "ice.class.thickness_m",
               "as = \"factor\"\nlaw = \"normal\"\nmean = 1\ndeviation = 0.1\nlow = 0.7\nhigh = 1.3") +
      variable("drift", "current.velocity_m_per_s.x", "law = \"values\"\nvalues = [0.4, 0.6]") +
      variable("count", "floes.count", "as = \"factor\"\nlaw = \"uniform\"\nlow = 0.5\nhigh = 0.6"));
  const SceneDef usual;
  for (const SweepMember& member : members) {
    const double factor = member.draw.values[0].value;
    EXPECT_EQ(member.draw.values[0].law.substr(0, 12), "times normal");
    EXPECT_TRUE(factor >= 0.7 && factor <= 1.3);
    EXPECT_EQ(member.scene.floes.classes[0].thickness_m, 0.5 * factor);
    EXPECT_EQ(member.scene.floes.classes[1].thickness_m, factor);
    EXPECT_EQ(member.scene.current.velocity_m_per_s.x, member.draw.values[1].value);
    EXPECT_EQ(member.scene.current.velocity_m_per_s.y, 0.25);
    EXPECT_NEAR(static_cast<double>(member.scene.floes.count),
                static_cast<double>(usual.floes.count) * member.draw.values[2].value, 0.5);
  }
}

TEST(SweepDraw, RepeatsDifferInTheSeedAlone) {
  const auto members = expanded(draw_mode + "count = 3\nrepeats = 2\n" + friction + seed);
  ASSERT_EQ(members.size(), 6u);
  EXPECT_EQ(members[3].name, "d2_r2");
  EXPECT_EQ(members[3].draw.repeat, 2);
  EXPECT_EQ(members[2].scene.ice.friction_ice, members[3].scene.ice.friction_ice);
  EXPECT_NE(members[2].scene.run.seed, members[3].scene.run.seed);
}

TEST(SweepDraw, ASaltelliDesignChangesOneInputAtATime) {
  const auto members = expanded(draw_mode + "count = 2\nsampling = \"saltelli\"\n" + friction + seed);
  ASSERT_EQ(members.size(), 8u);
  const SweepMember &a = members[4], &b = members[5], &with_friction = members[6], &with_field = members[7];
  EXPECT_EQ(a.name, "d2_A");
  EXPECT_EQ(with_friction.name, "d2_friction");
  EXPECT_EQ(with_field.draw.part, "field");
  EXPECT_NE(a.scene.ice.friction_ice, b.scene.ice.friction_ice);
  EXPECT_NE(a.scene.run.seed, b.scene.run.seed);
  EXPECT_EQ(with_friction.scene.ice.friction_ice, b.scene.ice.friction_ice);
  EXPECT_EQ(with_friction.scene.run.seed, a.scene.run.seed);
  EXPECT_EQ(with_field.scene.ice.friction_ice, a.scene.ice.friction_ice);
  EXPECT_EQ(with_field.scene.run.seed, b.scene.run.seed);
}

struct BadDraw {
  std::string text;  // after [sweep.draw]
  const char* expected;
};

TEST(SweepDraw, MistakesAreRefusedWithTheirPlace) {
  const std::string normal = "law = \"normal\"\nmean = 0.3\ndeviation = 0.1\n";
  const BadDraw bad[] = {
      {friction, "draw.toml:3:8: sweep.draw.count: missing"},
      {"count = 0\n" + friction, "draw.toml:4:9: sweep.draw.count: out of range (value 0, allowed [1, 100000])"},
      {"count = 3\ncuont = 3\n" + friction, "sweep.draw.cuont: unknown key"},
      {"count = 100000\nrepeats = 2\n" + friction + seed, "sweep.draw: too many runs (200000"},
      {"count = 3\nsampling = \"lhs\"\n" + friction, "sweep.draw.sampling: unknown choice"},
      {"count = 3\n", "sweep.draw.variable: missing"},
      {"count = 3\nrepeats = 2\n" + friction, "sweep.draw.repeats: the repeats would be the same run"},
      {"count = 3\nrepeats = 2\nsampling = \"saltelli\"\n" + seed, "not with sampling = \"saltelli\""},
      {"count = 3\n" + variable("a", "ice.friction", normal), "did you mean `ice.friction_ice`"},
      {"count = 3\n" + variable("a", "contact.solver", normal), "only numbers can be drawn"},
      {"count = 3\n" + variable("a", "current.velocity_m_per_s", normal), "is a pair; draw current.velocity_m_per_s.x"},
      {"count = 3\n" + variable("a", "ice.friction_ice", normal), "values outside the range of ice.friction_ice"},
      {"count = 3\n" + variable("a", "ice.friction_ice", normal + "low = 0\nhigh = 1.6"), "set low and high"},
      {"count = 3\n" + variable("a", "ice.friction_ice", normal + "low = 0.9\nhigh = 1.5"), "hardly a value lies"},
      {"count = 3\n" + variable("a", "ice.friction_ice", normal + "low = 1\nhigh = 0"), "not below high"},
      {"count = 3\n" + variable("a", "ice.friction_ice", "law = \"normal\"\nmean = 1\n"), "deviation: missing"},
      {"count = 3\n" + variable("a", "ice.friction_ice", "law = \"unifrom\""), "did you mean `uniform`"},
      {"count = 3\n" + variable("a", "ice.friction_ice", "law = \"uniform\"\nlow = 0\nhigh = 1\nmean = 1"),
       "sweep.draw.variable.a.mean: unknown key"},
      {"count = 3\n" + variable("a", "run.seed", "law = \"uniform\"\nlow = 0.5\nhigh = 9"), "run.seed is an integer"},
      {"count = 3\n" + variable("a", "ice.friction_ice", "law = \"quantiles\"\nquantiles = [[0, 1], [0.5, 0.5]]"),
       "not ascending"},
      {"count = 3\n" + variable("a", "ice.friction_ice", "law = \"quantiles\"\nquantiles = [[0, 0.1], [0.5, 0.5]]"),
       "do not go from 0 to 1"},
      {"count = 3\n" + variable("a", "ice.friction_ice", "law = \"values\"\nvalues = [0.1, 0.2]\nweights = [1]"),
       "not one for each value"},
      {"count = 3\n" + variable("a", "ice.friction_ice", "law = \"values\"\nvalues = [0.1]\nweights = [0]"),
       "allowed above 0"},
      {"count = 3\n" + friction + variable("b", "ice.friction_ice", "law = \"values\"\nvalues = [0.1]"),
       "another variable draws ice.friction_ice"},
      {"count = 3\n" + variable("\"a/b\"", "ice.friction_ice", "law = \"values\"\nvalues = [0.1]"), "not a name"},
      {"count = 3\n" + variable("a", "floe.thickness_m", "law = \"values\"\nvalues = [0.1]"), "has no [[floe]]"},
      {"count = 3\n" + variable("a", "floes.size_mean_m", "law = \"values\"\nvalues = [0.2]"), "in run \"d1\""},
  };
  for (const BadDraw& one : bad) {
    try {
      expanded(draw_mode + one.text);
      ADD_FAILURE() << "accepted: " << one.text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::scene_rejected);
      EXPECT_NE(std::string(error.what()).find(one.expected), std::string::npos)
          << "expected: " << one.expected << "\nmessage: " << error.what();
    }
  }
}

TEST(SweepDraw, DrawsHaveLimits) {
  std::string many = draw_mode + "count = 100000\n";
  int variables = 0;
  for (const auto& option : scene_options())
    if (option.type == OptionType::number && variables < 21) {
      const double value = std::get<double>(option.get(SceneDef{}));
      many += variable("v" + std::to_string(++variables), option.path,
                       "law = \"values\"\nvalues = [" + number_text(value) + "]");
    }
  ASSERT_EQ(variables, 21);
  try {
    expanded(many);
    ADD_FAILURE() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("too many drawn numbers in all (21 variables in 100000 runs"),
              std::string::npos)
        << error.what();
  }
}

TEST(SweepDraw, AKeyThatIsDrawnIsNotSetAsWell) {
  const std::string draws = "[sweep.draw]\ncount = 3\n" + friction;
  const std::pair<std::string, std::vector<std::string>> bad[] = {
      {draw_mode + "count = 3\n" + friction, {"ice.friction_ice=0.2"}},
      {"[sweep]\nmode = \"list\"\n[[sweep.run]]\nname = \"a\"\nice.friction_ice = 0.2\n" + draws, {}}};
  for (const auto& [text, overrides] : bad) {
    try {
      expanded(text, overrides);
      ADD_FAILURE() << "accepted: " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("ice.friction_ice is drawn, and set as well"), std::string::npos)
          << error.what();
    }
  }
  EXPECT_EQ(expanded(draw_mode + "count = 3\n" + friction, {"sweep.draw.count=5"}).size(), 5u);
  EXPECT_THROW(expanded("[sweep]\nmode = \"list\"\nseeds = { count = 2 }\n[[sweep.run]]\nname = \"a\"\n" + draws),
               Error);
}

}  // namespace
}  // namespace gem
