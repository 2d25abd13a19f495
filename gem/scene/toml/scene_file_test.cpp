// Reading and writing agree: the resolved text is read back unchanged, in any locale, and defaults have one source.
#include "gem/scene/toml/scene_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <clocale>
#include <cmath>
#include <limits>
#include <locale>
#include <random>

#include "gem/base/error.h"
#include "gem/scene/check_scene.h"
#include "gem/scene/problems.h"
#include "gem/scene/schema/schema.h"
#include "gem/scene/toml/scene_tree.h"
#include "gem/scene/toml/toml_text.h"

namespace gem {
namespace {

TEST(SceneFile, EmptyTextIsTheDefaultScene) {
  EXPECT_EQ(resolved_toml(parse_scene("", "empty.toml")), resolved_toml(SceneDef{}));
  EXPECT_TRUE(check_scene(SceneDef{}).empty());
  EXPECT_TRUE(scene_warnings(SceneDef{}).empty());
}

TEST(SceneFile, ScenesWithNothingInThemAreValid) {
  const SceneDef scene = parse_scene(
      "run.duration_s = 0\nplatform.present = false\nboundary.present = false\nfloes.source = \"listed\"\nice.class = "
      "[]\n",
      "nothing.toml");
  EXPECT_TRUE(scene.floe.empty());
  EXPECT_TRUE(scene.floes.classes.empty());
  EXPECT_EQ(resolved_toml(parse_scene(resolved_toml(scene), "again.toml")), resolved_toml(scene));
}

TEST(SceneFile, EveryOptionIsReadBackFromItsOwnText) {
  // Sets each option to a value other than its default and checks it in the scene that is read. An option that counts
  // only with a choice of another one gets that choice first.
  for (const auto& option : scene_options()) {
    SceneDef usual;
    for (const auto& other : scene_options())
      if (other.path == option.counts_with.key) other.set(usual, option.counts_with.choice);
    SceneDef scene = usual;
    OptionValue value = option.get(scene);
    if (auto* number = std::get_if<double>(&value))
      *number = option.range.high <= 0.25 ? 0.5 * option.range.high : option.range.high <= 1.0 ? 0.25 : *number + 0.5;
    if (auto* integer = std::get_if<std::int64_t>(&value)) *integer += 1;
    if (auto* text = std::get_if<std::string>(&value))
      *text = option.type == OptionType::choice ? *std::find_if(option.choices.begin(), option.choices.end(),
                                                                [&](const auto& c) { return c != *text; })
                                                : "other \"name\"";
    if (auto* flag = std::get_if<bool>(&value)) *flag = !*flag;
    if (auto* pair = std::get_if<Vec2>(&value)) *pair = {pair->x + 0.125, pair->y - 0.3};
    if (auto* corners = std::get_if<std::vector<Vec2>>(&value)) *corners = {{0.0, 0.5}, {80.0, 0.5}, {0.0, 60.25}};
    if (auto* rows = std::get_if<OptionRows>(&value)) {
      rows->emplace_back();
      for (const OptionColumn& column : option.columns) rows->back().push_back(std::max(0.125, column.range.low));
    }
    option.set(scene, value);
    EXPECT_EQ(value_text(option.get(scene)), value_text(value)) << option.path;
    EXPECT_NE(resolved_toml(scene), resolved_toml(usual)) << option.path;
    EXPECT_NE(scene_hash(scene), scene_hash(usual)) << option.path;
    if (!check_scene(scene).empty()) continue;
    const SceneDef again = parse_scene(resolved_toml(scene), "resolved.toml");
    EXPECT_EQ(value_text(option.get(again)), value_text(value)) << option.path;
  }
}

TEST(SceneFile, TablesComeBackAsTheyAreAndCasesWithoutThemKeepTheirText) {
  const std::string plain = resolved_toml(SceneDef{});
  for (const char* word : {"table", "[wind]", "[coriolis]", "turning"})
    EXPECT_EQ(plain.find(word), std::string::npos) << word;
  const SceneDef scene = parse_scene(
      "[current]\ndirection_table = [[0, 0.25, -0.5], [3600.5, 0.1, 1.0]]\ntide_table = [[44714, 0.1, 0, 0.2, 1]]\n"
      "[wind]\nvelocity_table = [[-60, 5, 1e-3]]\n[run]\ntable_time_s = 30\n",
      "tables.toml");
  EXPECT_EQ(scene.drive.current_direction[1][0], 3600.5);
  EXPECT_EQ(scene.drive.tide[0][4], 1.0);
  const SceneDef again = parse_scene(resolved_toml(scene), "again.toml");
  EXPECT_EQ(again.drive.current_direction, scene.drive.current_direction);
  EXPECT_EQ(again.drive.wind_velocity, scene.drive.wind_velocity);
  EXPECT_EQ(again.drive.start_time_s, 30.0);
  EXPECT_EQ(scene_hash(again), scene_hash(scene));
  EXPECT_NE(scene_hash(scene), scene_hash(SceneDef{}));
}

/// A random double in the range, with many digits.
double awkward(const Range& range, std::mt19937_64& random) {
  const double low = std::max(range.low, -1e3);
  const double high = std::min(range.high, 1e3);
  return std::clamp(low + (high - low) * std::generate_canonical<double, 53>(random), std::nextafter(low, high),
                    std::nextafter(high, low));
}

TEST(SceneFile, ResolvedTextComesBackAsItself) {
  std::mt19937_64 random(7);
  int accepted = 0;
  for (int trial = 0; trial < 300; ++trial) {
    SceneDef scene;
    scene.floes.source = FloeSource::listed;
    scene.run.name = "n\\\"\xc3\xa9" + std::to_string(trial);
    for (const auto& option : scene_options())
      if (option.type == OptionType::number && option.path.starts_with("ice."))
        option.set(scene, awkward(option.range, random));
    FloeDef floe;
    for (int i = 0; i < 5; ++i)
      floe.outline_m.push_back({awkward({-900.0, 900.0}, random), awkward({-900.0, 900.0}, random)});
    floe.angle_rad = awkward({-3.0, 3.0}, random);
    scene.floe.assign(2, floe);
    scene.fixed.push_back({floe.outline_m});
    if (!check_scene(scene).empty()) continue;
    ++accepted;
    const std::string text = resolved_toml(scene);
    EXPECT_EQ(resolved_toml(parse_scene(text, "resolved.toml")), text);
  }
  EXPECT_GT(accepted, 30);
}

TEST(SceneFile, DamagedTextIsRefusedOrStillAScene) {
  // Truncated texts and random bytes must give an Error or a scene that is written and read back unchanged.
  const std::string whole = resolved_toml(SceneDef{});
  std::mt19937_64 random(11);
  int refused = 0;
  for (std::size_t trial = 0; trial < 2 * whole.size(); trial += 7) {
    std::string text = whole.substr(0, trial < whole.size() ? trial : whole.size());
    if (trial >= whole.size()) text[random() % text.size()] = "\"'[]{}=.,#\n\\-e9nx\xff"[random() % 18];
    try {
      const std::string resolved = resolved_toml(parse_scene(text, "damaged.toml"));
      EXPECT_EQ(resolved_toml(parse_scene(resolved, "resolved.toml")), resolved) << text;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::scene_rejected);
      EXPECT_TRUE(std::string(error.what()).starts_with("damaged.toml")) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 200);
}

TEST(SceneFile, TheIterationSetsTheEndOfIterationsThatACaseLeavesOut) {
  const auto numerics = [](const std::string& keys) {
    return parse_scene("[numerics]\n" + keys, "iteration.toml").numerics;
  };
  EXPECT_EQ(numerics("").iteration, Iteration::splitting);
  EXPECT_EQ(numerics("").residual_tolerance, 3e-3);
  EXPECT_EQ(numerics("").iterations_maximum, 384);
  EXPECT_EQ(numerics("iteration = \"splitting\"").iterations_maximum, 384);
  EXPECT_EQ(numerics("iteration = \"gradient\"").residual_tolerance, 1e-5);
  EXPECT_EQ(numerics("iteration = \"gradient\"").iterations_maximum, 32);
  const NumericsDef given = numerics("iterations_maximum = 192\nresidual_tolerance = 1e-3\niteration = \"gradient\"");
  EXPECT_EQ(given.residual_tolerance, 1e-3) << "what a case gives stays";
  EXPECT_EQ(given.iterations_maximum, 192);
  EXPECT_EQ(parse_scene("", "iteration.toml", {"numerics.iteration=\"gradient\""}).numerics.iterations_maximum, 32);
}

TEST(SceneFile, HashIsThatOfTheResolvedValuesOnly) {
  const SceneDef a = parse_scene("# comment\n[platform]\nmass_kg = 100000000\n", "a.toml");
  const SceneDef b =
      parse_scene("platform = { mass_kg = 1e8 }\n[current]\nvelocity_m_per_s = [0.25, -0.0]\n", "b.toml");
  EXPECT_EQ(scene_hash(a), scene_hash(b));
  EXPECT_EQ(scene_hash(a).size(), 64u);
}

void expect_numbers_unchanged() {
  const SceneDef scene =
      parse_scene("[platform]\nmass_kg = 1234567.875\n[ice]\nfriction_ice = 1.5e-1\n", "locale.toml");
  EXPECT_EQ(scene.platform.mass_kg, 1234567.875);
  EXPECT_EQ(scene.ice.friction_ice, 0.15);
  EXPECT_NE(resolved_toml(scene).find("mass_kg = 1234567.875\n"), std::string::npos);
  EXPECT_NE(resolved_toml(scene).find("friction_ice = 0.15\n"), std::string::npos);
}

struct CommaNumbers : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(SceneLocale, StreamsWithDecimalCommaChangeNothing) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  expect_numbers_unchanged();
  std::locale::global(before);
}

TEST(SceneLocale, ProcessWithDecimalCommaChangesNothing) {
  const std::string before = std::setlocale(LC_ALL, nullptr);
  if (std::setlocale(LC_ALL, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "the locale de_DE.UTF-8 is not installed";
  expect_numbers_unchanged();
  std::setlocale(LC_ALL, before.c_str());
}

TEST(SceneWarnings, HighFrictionIsAcceptedWithAWarning) {
  const SceneDef scene = parse_scene("[ice]\nfriction_ice = 1.5\n", "friction.toml");
  ASSERT_EQ(scene_warnings(scene).size(), 1u);
  EXPECT_NE(scene_warnings(scene)[0].find("ice.friction_ice: above the Painleve bound"), std::string::npos);
}

TEST(SceneWarnings, UnlikelyMassAndCoverAreNamed) {
  EXPECT_NE(scene_warnings(parse_scene("[platform]\nmass_kg = 1e5\n", "t.toml")).at(0).find("platform.mass_kg"),
            std::string::npos);
  EXPECT_NE(scene_warnings(parse_scene("[floes]\ncount = 1000\n", "t.toml")).at(0).find("cover 1 tenths"),
            std::string::npos);
}

TEST(ResolvedText, HasTheCoefficientsOfTheChosenDragOnly) {
  const auto has = [](const std::string& text, const std::string& line) {
    return resolved_toml(parse_scene(text, "t.toml")).find("\n" + line + "\n") != std::string::npos;
  };
  const std::string by_axis = "[platform_drag]\npresent = true\nlaw = \"by_axis\"\n";
  const std::string axes[] = {"surge_coefficient = 0.1", "sway_coefficient = 0.7", "yaw_coefficient = 0.7"};
  for (const std::string& axis : axes) {
    EXPECT_TRUE(has(by_axis, axis)) << axis;
    EXPECT_FALSE(has("", axis)) << axis;
  }
  EXPECT_FALSE(has(by_axis, "coefficient = 0.8"));
  EXPECT_TRUE(has("", "coefficient = 0.8"));
  const std::string resolved = resolved_toml(parse_scene(by_axis, "t.toml"));
  EXPECT_EQ(resolved_toml(parse_scene(resolved, "again.toml")), resolved);
}

TEST(SceneWarnings, DragThatDoesNothingIsNamed) {
  const auto warned = [](const std::string& text) { return scene_warnings(parse_scene(text, "t.toml")); };
  const std::string law = "[platform_drag]\nlaw = \"by_axis\"\n", on = "present = true\nwater = \"current\"\n";
  EXPECT_EQ(warned(law).at(0),
            "platform_drag.law: has no effect (platform_drag.present is false); set platform_drag.present = true");
  EXPECT_NE(warned("[platform_drag]\ndraft_m = 8.0\n").at(0).find("platform_drag.draft_m: has no effect"),
            std::string::npos);
  EXPECT_TRUE(warned(law + on).empty());
  const std::string yaw = "yaw_coefficient = 0.5\n", locked = "[platform]\nyaw = \"locked\"\n";
  EXPECT_TRUE(warned(law + on + yaw).empty());
  EXPECT_NE(warned(law + on + yaw + locked).at(0).find("platform_drag.yaw_coefficient: has no effect"),
            std::string::npos);
  const std::string fixed = "[platform]\nfixed = true\n";
  EXPECT_TRUE(warned(fixed).empty());
  EXPECT_EQ(warned(fixed + law + on).at(0),
            "platform_drag.present: has no effect (the platform is fixed); set platform_drag.present = false");
}

TEST(SceneWarnings, DragInStillWaterBesideACurrentIsNamed) {
  const auto warned = [](const std::string& text) { return scene_warnings(parse_scene(text, "t.toml")); };
  const std::string still = "[platform_drag]\npresent = true\nwater = \"still\"\n";
  ASSERT_EQ(warned(still).size(), 1u);
  EXPECT_NE(warned(still)[0].find("platform_drag.water: still water in a current (of up to 0.25 m/s"),
            std::string::npos)
      << warned(still)[0];
  EXPECT_TRUE(warned(still + "[current]\nvelocity_m_per_s = [0.0, 0.0]\n").empty());
}

TEST(SceneWarnings, TimesThatAreNoWholeTimeStepsAreNamed) {
  const auto warned = [](const std::string& text) { return scene_warnings(parse_scene(text, "t.toml")); };
  EXPECT_NE(warned("[output]\nplatform_interval_s = 0.12\n").at(0).find("output.platform_interval_s"),
            std::string::npos);
  EXPECT_NE(warned("[output]\nforce_window_s = 0.12\n").at(0).find("forces are means over 0.1 s"), std::string::npos);
  EXPECT_NE(warned("[run]\nduration_s = 0.32\n").at(0).find("the run ends at 0.3 s"), std::string::npos);
  EXPECT_TRUE(warned("[run]\nduration_s = 15200.0\n[numerics]\ntime_step_s = 0.1\n").empty());
}

TEST(SceneWarnings, IceThatCannotReachThePlatformIsNamed) {
  const auto warned = [](const std::string& text) {
    const std::vector<std::string> warnings = scene_warnings(parse_scene(text, "t.toml"));
    return std::any_of(warnings.begin(), warnings.end(),
                       [](const std::string& one) { return one.find("carries the ice past") != std::string::npos; });
  };
  EXPECT_TRUE(warned("[current]\nvelocity_m_per_s = [-0.5, 0.0]\n"));
  EXPECT_TRUE(warned("[current]\nvelocity_m_per_s = [0.0, 0.5]\n"));
  EXPECT_TRUE(warned("[platform]\nanchor_m = [0.0, 400.0]\n[boundary]\npresent = false\n"));
  EXPECT_FALSE(warned("[current]\nvelocity_m_per_s = [0.5, 0.0]\n"));
  EXPECT_FALSE(warned("[current]\nvelocity_m_per_s = [0.5, 0.1]\n"));
  EXPECT_FALSE(warned("[current]\nvelocity_m_per_s = [-0.1, 0.0]\n[wind]\nvelocity_m_per_s = [20.0, 0.0]\n"));
  // what bends the paths of the floes may bring them
  EXPECT_FALSE(warned("[current]\nvelocity_m_per_s = [0.0, 0.5]\n[coriolis]\nparameter_per_s = 1.4e-4\n"));
  EXPECT_FALSE(warned("[current]\nvelocity_m_per_s = [0.0, 0.5]\n[water]\nturning_rad = 0.4\n"));
}

TEST(SceneWarnings, APlatformWithoutSamplesIsNamed) {
  const auto warnings = scene_warnings(parse_scene("[output]\nplatform_interval_s = 7200.0\n", "t.toml"));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("no sample of the platform before its end"), std::string::npos) << warnings[0];
  EXPECT_TRUE(scene_warnings(parse_scene("[output]\nplatform_interval_s = 3600.0\n", "t.toml")).empty());
}

TEST(PlatformInterval, IsAWholeNumberOfTimeStepsUnlessGiven) {
  const auto interval = [](const std::string& step, const std::string& output = "") {
    const SceneDef scene =
        parse_scene(output + "[run]\nduration_s = 84\n[numerics]\ntime_step_s = " + step + "\n", "t.toml");
    EXPECT_TRUE(scene_warnings(scene).empty() || !output.empty()) << step;
    EXPECT_EQ(parse_scene(resolved_toml(scene), "again.toml").output.platform_interval_s,
              scene.output.platform_interval_s);
    return scene.output.platform_interval_s;
  };
  EXPECT_EQ(interval("0.05"), 0.1);
  EXPECT_EQ(interval("0.1"), 0.1);
  EXPECT_EQ(interval("0.0125"), 0.1);
  EXPECT_EQ(interval("0.2"), 0.2);
  EXPECT_EQ(interval("0.04"), 0.12);
  EXPECT_EQ(interval("0.035"), 0.105);
  EXPECT_EQ(interval("0.2", "[output]\nplatform_interval_s = 0.5\n"), 0.5);
  EXPECT_EQ(interval("0.04", "[output]\nplatform_interval_s = 0.1\n"), 0.1);
}

TEST(OlderKeys, AreReadAndNamedInOneLineEach) {
  const SceneDef scene =
      parse_scene("[contact]\nresolution = \"independent\"\n", "old.toml", {"numerics.moment_s=0.1"});
  EXPECT_EQ(scene.contact.solver, ContactSolver::independent);
  EXPECT_EQ(scene.numerics.time_step_s, 0.1);
  EXPECT_EQ(scene_warnings(scene), (std::vector<std::string>{
                                       "contact.resolution is now called contact.solver; both names are read",
                                       "numerics.moment_s is now called numerics.time_step_s; both names are read",
                                   }));
}

TEST(OlderKeys, AreLaidOverThoseOfToday) {
  EXPECT_EQ(parse_scene("[numerics]\nmoment_s = 0.1\n", "old.toml", {"numerics.time_step_s=0.02"}).numerics.time_step_s,
            0.02);
  EXPECT_EQ(parse_scene("[numerics]\ntime_step_s = 0.1\n", "new.toml", {"numerics.moment_s=0.02"}).numerics.time_step_s,
            0.02);
}

TEST(NearestName, FindsSlipsAndRefusesNonsense) {
  const std::vector<std::string> names = {"platform.mass_kg", "platform.yaw", "mooring.stiffness_N_per_m"};
  EXPECT_EQ(nearest_name("platform.mas", names), "platform.mass_kg");
  EXPECT_EQ(nearest_name("platform.mass_t", names), "platform.mass_kg");
  EXPECT_EQ(nearest_name("mooring.stifness", names), "mooring.stiffness_N_per_m");
  EXPECT_EQ(nearest_name("mass_kg", names), "platform.mass_kg");
  EXPECT_EQ(nearest_name("zzzzzzzz", names), "");
  EXPECT_EQ(nearest_name("mooring.stiff", names), "mooring.stiffness_N_per_m");
  EXPECT_EQ(nearest_name("mooring.stif", names), "mooring.stiffness_N_per_m");
  EXPECT_EQ(nearest_name("x", names), "");
}

TEST(NearestName, FindsAKeyByItsBeginning) {
  EXPECT_EQ(nearest_name("platform_drag.surge_coef", known_keys()), "platform_drag.surge_coefficient");
  EXPECT_EQ(nearest_name("surge_coef", known_keys()), "platform_drag.surge_coefficient");
  EXPECT_EQ(nearest_name("platform_drag.sway_koeff", known_keys()), "platform_drag.sway_coefficient");
  EXPECT_EQ(nearest_name("floes.size_max", known_keys()), "floes.size_maximum_m");
  EXPECT_EQ(nearest_name("numerics.iteration_max", known_keys()), "numerics.iterations_maximum");
}

TEST(NumberText, IsTheShortestThatReadsBack) {
  EXPECT_EQ(toml_number_text(0.1), "0.1");
  EXPECT_EQ(toml_number_text(2.0), "2.0");
  EXPECT_EQ(toml_number_text(1e8), "1e+08");
  EXPECT_EQ(toml_number_text(std::numeric_limits<double>::denorm_min()), "5e-324");
  EXPECT_EQ(plain_number_text(400.0), "400");
  EXPECT_EQ(quoted_text("a\"\\\n"), "\"a\\\"\\\\\\u000A\"");
}

}  // namespace
}  // namespace gem
