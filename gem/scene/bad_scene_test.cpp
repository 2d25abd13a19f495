// Bad input: every error is reported with its place, key, value and range. Nothing is repaired.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <ostream>

#include "gem/base/error.h"
#include "gem/scene/toml/document.h"
#include "gem/scene/toml/scene_file.h"

namespace gem {
namespace {

struct BadScene {
  const char* name;
  std::string text;
  std::vector<std::string> expected;  ///< parts of the message
};

void PrintTo(const BadScene& bad, std::ostream* out) { *out << bad.name; }

std::string rejection(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    parse_scene(text, "bad.toml", overrides);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_rejected);
    return error.what();
  }
  return "accepted";
}

class BadSceneTest : public testing::TestWithParam<BadScene> {};

TEST_P(BadSceneTest, IsRefusedWithItsPlace) {
  const std::string message = rejection(GetParam().text);
  for (const std::string& part : GetParam().expected)
    EXPECT_NE(message.find(part), std::string::npos) << "expected: " << part << "\nmessage: " << message;
}

std::string repeated(const std::string& part, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += part;
  return out;
}

// Not in the list below: each test of the program would make these 16 MB.
TEST(BadScene, ALargeFileIsRefused) {
  const std::string message = rejection(repeated("#" + repeated("x", 1023), 16385));
  EXPECT_NE(message.find("too large"), std::string::npos) << message;
  EXPECT_NE(message.find("16777216"), std::string::npos) << message;
}

const std::string square = "outline_m = [[0, 0], [1, 0], [1, 1], [0, 1]]\n";

INSTANTIATE_TEST_SUITE_P(
    Syntax, BadSceneTest,
    testing::Values(
        BadScene{"malformed", "[run]\nname = \n", {"bad.toml:2:", "run.name: malformed"}},
        BadScene{"garbage", "\n\n}{\n", {"bad.toml:3:1"}},
        BadScene{"letter_outside_quotes", "[run]\nn\u00e4me = \"a\"\n", {"bad.toml:2:2", "outside ASCII"}},
        BadScene{"quote_in_word", "[run]\nseed = 1'\u00e4'\n", {"bad.toml:2:9", "a quote in the middle"}},
        BadScene{"quote_behind_point", "[run]\nseed = 1.\"{\u00e4\"\n", {"bad.toml:2:10", "a quote in the middle"}},
        BadScene{"quote_behind_point_in_list",
                 "[run]\nseed = [1.\"{\u00e4\"]\n",
                 {"bad.toml:2:11", "a quote in the middle"}},
        BadScene{"bracket_in_word", "[run]\nseed = 9k{\"\u00e4\n", {"bad.toml:2:10", "a bracket in the middle"}},
        BadScene{"bracket_of_another_kind", "[run]\nseed = [1}\n", {"bad.toml:2:10", "without its"}},
        BadScene{
            "truncated_list", "[current]\nvelocity_m_per_s = [0.2", {"bad.toml:2:", "velocity_m_per_s", "end-of-file"}},
        BadScene{"truncated_header", "[platf", {"bad.toml:1:", "end-of-file"}},
        BadScene{"truncated_text", "[run]\nname = \"abc", {"bad.toml:2:", "run.name"}},
        BadScene{"duplicate_key", "[run]\nseed = 1\nseed = 2\n", {"bad.toml:3:", "run.seed", "redefine"}},
        BadScene{"duplicate_section", "[run]\nseed = 1\n[run]\nduration_s = 2\n", {"bad.toml:3:", "redefine"}},
        BadScene{"too_large_number", "[platform]\nmass_kg = 1e400\n", {"bad.toml:2:", "platform.mass_kg", "1e400"}},
        BadScene{"hex_float", "[platform]\nmass_kg = 0x1p3\n", {"bad.toml:2:", "platform.mass_kg", "hexadecimal"}},
        BadScene{"decimal_comma", "[platform]\nmass_kg = 1,5\n", {"bad.toml:2:12", "platform.mass_kg"}},
        BadScene{"too_large_integer", "[floes]\ncount = 99999999999999999999\n", {"bad.toml:2:", "floes.count"}},
        BadScene{"invalid_utf8", "[run]\nname = \"\xff\xfe\"\n", {"bad.toml:2:", "utf-8"}},
        BadScene{"multi_line_text", "[run]\nname = \"\"\"a\nb\"\"\"\n", {"bad.toml:2:8", "multi-line"}},
        BadScene{"deep_brackets", "x = " + repeated("[", 100000), {"bad.toml:1:", "nested too deep"}},
        BadScene{"deep_keys", repeated("a.", 100000) + "a = 1", {"bad.toml:1:", "nested too deep"}},
        BadScene{
            "deep_quoted_keys", "x = {" + repeated("\"=\".", 100000) + "a = 1}", {"bad.toml:1:", "nested too deep"}},
        BadScene{"long_text", "[run]\nname = \"" + repeated("x", 5000) + "\"\n", {"bad.toml:2:", "too long"}}),
    [](const auto& test) { return std::string(test.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Values, BadSceneTest,
    testing::Values(
        BadScene{"unknown_key",
                 "[platform]\nmas = 1e8\n",
                 {"bad.toml:2:1: platform.mas: unknown key", "`platform.mass_kg`"}},
        BadScene{"key_without_unit", "[mooring]\nstiffness = 1\n", {"bad.toml:2:1", "`mooring.stiffness_N_per_m`"}},
        BadScene{
            "key_in_wrong_section", "[ice]\ndrag_law = \"none\"\n", {"bad.toml:2:1: ice.drag_law", "`water.drag_law`"}},
        BadScene{"unknown_section",
                 "[plattform]\nmass_kg = 1\n",
                 {"bad.toml:1:2: plattform: unknown section", "`platform`"}},
        BadScene{"key_without_section", "mass_kg = 1\n", {"bad.toml:1:1: mass_kg: unknown key", "`platform.mass_kg`"}},
        BadScene{"section_as_value", "platform = 3\n", {"bad.toml:1:12: platform: wrong type (value 3"}},
        BadScene{"text_for_number",
                 "[platform]\nmass_kg = \"1e8 kg\"\n",
                 {"bad.toml:2:11: platform.mass_kg: wrong type (value \"1e8 kg\", expected a number in kg)"}},
        BadScene{
            "number_for_integer", "[floes]\ncount = 4008.0\n", {"bad.toml:2:9: floes.count: wrong type (value 4008.0"}},
        BadScene{"number_for_text", "[run]\nname = 7\n", {"bad.toml:2:8: run.name: wrong type"}},
        BadScene{"number_for_flag", "[boundary]\npresent = 1\n", {"bad.toml:2:11", "expected true or false"}},
        BadScene{
            "date", "[run]\nduration_s = 1979-05-27\n", {"bad.toml:2:14: run.duration_s: wrong type (value a date"}},
        BadScene{"number_for_pair", "[current]\nvelocity_m_per_s = 0.25\n", {"bad.toml:2:20", "expected a pair"}},
        BadScene{"triple_for_pair", "[current]\nvelocity_m_per_s = [1, 2, 3]\n", {"bad.toml:2:20", "expected a pair"}},
        BadScene{"unknown_choice",
                 "[contact]\nsolver = \"couple\"\n",
                 {"bad.toml:2:10", "allowed independent, coupled", "`coupled`"}},
        BadScene{"nan", "[platform]\nmass_kg = nan\n", {"bad.toml:2:11: platform.mass_kg: not finite (value nan"}},
        BadScene{"infinity",
                 "[current]\nvelocity_m_per_s = [-inf, 0]\n",
                 {"bad.toml:2:21: current.velocity_m_per_s: not finite (value -inf, allowed [-10, 10] m/s)"}},
        BadScene{"negative",
                 "[ice]\ndensity_kg_per_m3 = -900\n",
                 {"bad.toml:2:21: ice.density_kg_per_m3: out of range (value -900, allowed [1, 10000] kg/m3)"}},
        BadScene{"zero_time_step",
                 "[numerics]\ntime_step_s = 0\n",
                 {"bad.toml:2:15: numerics.time_step_s: out of range (value 0"}},
        BadScene{"open_bound", "[mooring]\ndamping_ratio = 1\n", {"bad.toml:2:17", "allowed [0, 1)"}},
        BadScene{"friction",
                 "[ice]\nfriction_ice = 10.5\n",
                 {"bad.toml:2:16: ice.friction_ice", "allowed [0, 1.5]", "ice has less friction"}},
        BadScene{"millimetres",
                 "[[ice.class]]\nthickness_m = 500\n",
                 {"bad.toml:2:15: ice.class[0].thickness_m: out of range (value 500, allowed [0.01, 10] m)"}},
        BadScene{
            "centimetres_per_second", "[current]\nvelocity_m_per_s = [25, 0]\n", {"bad.toml:2:21", "[-10, 10] m/s"}},
        BadScene{"absurd_count", "[floes]\ncount = 3000000000\n", {"bad.toml:2:9: floes.count: out of range"}},
        BadScene{"seed_below_zero", "[run]\nseed = -1\n", {"bad.toml:2:8: run.seed: out of range"}},
        BadScene{"list_as_table", "[floe]\n" + square, {"bad.toml:1:1: floe: wrong type", "[[floe]]"}},
        BadScene{"entry_not_a_table", "floe = [1]\n", {"bad.toml:1:9: floe[0]: wrong type"}},
        BadScene{"unknown_key_in_list",
                 "[[floe]]\n" + square + "thicknes_m = 1\n",
                 {"bad.toml:3:1: floe[0].thicknes_m", "`thickness_m`"}},
        BadScene{"outline_missing", "[[fixed]]\n", {"bad.toml:1:1: fixed[0].outline_m: missing"}},
        BadScene{"two_corners",
                 "[[fixed]]\noutline_m = [[0, 0], [1, 1]]\n",
                 {"bad.toml:2:13: fixed[0].outline_m: wrong number of corners (value 2"}},
        BadScene{"bad_corner",
                 "[[fixed]]\noutline_m = [[0, 0], [1, nan], [1, 1]]\n",
                 {"bad.toml:2:26: fixed[0].outline_m"}}),
    [](const auto& test) { return std::string(test.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Comparisons, BadSceneTest,
    testing::Values(
        BadScene{"time_step_against_floes",
                 "[numerics]\ntime_step_s = 0.9\n",
                 {"bad.toml:2:15: numerics.time_step_s", "value 0.9, allowed at most 0.8 s"}},
        BadScene{"time_step_against_mooring",
                 "[floes]\ncount = 0\n[mooring]\nstiffness_N_per_m = 1e10\n[numerics]\ntime_step_s = 0.1\n",
                 {"bad.toml:6:15: numerics.time_step_s", "mooring (value 0.1, allowed at most 0.02 s"}},
        BadScene{"too_many_steps",
                 "[run]\nduration_s = 1e8\n[numerics]\ntime_step_s = 1e-6\n",
                 {"bad.toml:2:14: run.duration_s", "allowed at most 10000 s"}},
        BadScene{"sample_below_time_step",
                 "[output]\nplatform_interval_s = 0.01\n",
                 {"bad.toml:2:23: output.platform_interval_s", "at least 0.05 s"}},
        BadScene{
            "mean_outside_limits",
            "[floes]\nsize_mean_m = 25\n",
            {"bad.toml:2:15: floes.size_mean_m", "between floes.size_minimum_m = 2 and floes.size_maximum_m = 20 m"}},
        BadScene{"limits_reversed",
                 "[floes]\nsize_minimum_m = 20\nsize_maximum_m = 2\n",
                 {"floes.size_mean_m", "between floes.size_minimum_m = 20 and floes.size_maximum_m = 2 m"}},
        BadScene{"deviation_infeasible",
                 "[floes]\nsize_deviation_m = 9\n",
                 {"bad.toml:2:20: floes.size_deviation_m", "allowed below 8.011 m"}},
        BadScene{"field_too_full",
                 "[floes]\ncount = 100000\n",
                 {"bad.toml:2:9: floes.count", "do not fit", "cover 10.47 of its area"}},
        BadScene{"no_classes", "[ice]\nclass = []\n", {"bad.toml:2:9: ice.class", "value 0, allowed (0, 9]"}},
        BadScene{"too_many_tenths", "[[ice.class]]\ntenths = 9.5\n", {"ice.class", "value 9.5, allowed (0, 9]"}},
        BadScene{
            "field_in_platform", "[floes]\nstart_x_m = -1540\n", {"bad.toml:2:13: floes.start_x_m", "at most -1550 m"}},
        BadScene{
            "mooring_without_table", "[mooring]\nlaw = \"table\"\n", {"bad.toml:2:7: mooring.law", "needs one table"}},
        BadScene{"table_of_a_linear_mooring",
                 "[mooring]\nforce_table = [[0, 0], [1, 1e5]]\n",
                 {"bad.toml:2:15: mooring.force_table: has no effect"}},
        BadScene{"mooring_that_begins_with_a_force",
                 "[mooring]\nlaw = \"table\"\nforce_table = [[0, 5], [1, 1e5]]\n",
                 {"mooring.force_table: the force does not begin at 0"}},
        BadScene{"mooring_rows_that_fall",
                 "[mooring]\nlaw = \"table\"\nforce_table = [[1, 0], [1, 1e5]]\n",
                 {"mooring.force_table: the offsets of the rows do not rise"}},
        BadScene{
            "half_a_turn_of_directions",
            "[mooring]\nlaw = \"table\"\ndirection_table = [[0, 0, 0], [0, 1, 1e5], [1, 0, 0], [1, 1, 1e5], [2, 0, 0], "
            "[2, 1, 1e5]]\n",
            {"mooring.direction_table: the directions do not go around a turn", "4.28 rad after 2 rad"}},
        BadScene{"damping_ratio_of_a_table",
                 "[mooring]\nlaw = \"table\"\ndamping_ratio = 0.1\nforce_table = [[0, 0], [1, 1e5]]\n",
                 {"mooring.damping_ratio: has no effect", "mooring.damping_N_s_per_m"}},
        BadScene{"line_too_short",
                 "[mooring]\nlaw = \"catenary\"\nline_height_m = 50\n"
                 "line_table = [[100, 0, 50, 0, 40, 1000, 1e9, 0]]\n",
                 {"mooring.line_table: line 1 does not reach the seabed", "line_height_m = 50"}},
        BadScene{"torn_line",
                 "[mooring]\nlaw = \"catenary\"\nline_height_m = 50\n"
                 "line_table = [[900, 0, 50, 0, 800, 1000, 1e9, 1e6]]\n",
                 {"mooring.line_table: line 1 is torn at the start", "at most its strength of 1e+06 N"}},
        BadScene{"thrusters_of_a_locked_platform",
                 "[platform]\nyaw = \"locked\"\n[[dp.thruster]]\nposition_m = [10, 0]\n[[dp.thruster]]\n",
                 {"bad.toml:2:7: platform.yaw: thrusters need a platform that moves and turns", "\"locked\""}},
        BadScene{"thrusters_that_cannot_turn",
                 "[[dp.thruster]]\nposition_m = [0, 0]\n",
                 {"dp.thruster: the thrusters cannot push the yaw by itself"}},
        BadScene{"thrusters_all_athwart",
                 "[[dp.thruster]]\nkind = \"tunnel\"\nposition_m = [40, 0]\n"
                 "[[dp.thruster]]\nkind = \"tunnel\"\nposition_m = [-40, 0]\n",
                 {"dp.thruster: the thrusters cannot push the surge by itself"}},
        BadScene{"two_rows_of_gains",
                 "[dp]\ngain_table = [[1, 1, 0], [1, 1, 0]]\n[[dp.thruster]]\nposition_m = [40, 0]\n"
                 "[[dp.thruster]]\nposition_m = [-40, 0]\n",
                 {"bad.toml:2:14: dp.gain_table: wrong number of rows (value 2, allowed 3)"}},
        BadScene{"unstable_filter",
                 "[dp]\nfilter_time_s = 40\n[[dp.thruster]]\nposition_m = [40, 0]\n"
                 "[[dp.thruster]]\nposition_m = [-40, 0]\n",
                 {"dp.filter_time_s: the control of the surge is unstable", "allowed below 20.37 s"}},
        BadScene{"unstable_integral",
                 "[dp]\nintegral_time_s = 5\n[[dp.thruster]]\nposition_m = [40, 0]\n"
                 "[[dp.thruster]]\nposition_m = [-40, 0]\n",
                 {"dp.integral_time_s: the control of the surge is unstable", "the integral time is 5 s"}},
        BadScene{"two_heading_controls",
                 "[heading]\nmoment_N_m = 1e6\n[[dp.thruster]]\nposition_m = [40, 0]\n"
                 "[[dp.thruster]]\nposition_m = [-40, 0]\n",
                 {"heading.moment_N_m: the yaw has two controls", "dp.follows_drift"}},
        BadScene{"strong_dp_damping",
                 "[platform]\nmass_kg = 1e7\n[numerics]\ntime_step_s = 0.1\n"
                 "[dp]\ngain_table = [[1e3, 2e8, 0], [1e3, 1e5, 0], [1e6, 1e8, 0]]\n"
                 "[[dp.thruster]]\nposition_m = [40, 0]\n[[dp.thruster]]\nposition_m = [-40, 0]\n",
                 {"numerics.time_step_s: the time step is too long for the damping of the surge", "at most 0.05 s"}},
        BadScene{"short_dp_period",
                 "[dp]\nyaw_period_s = 1\n[numerics]\ntime_step_s = 0.05\n[[dp.thruster]]\nposition_m = [40, 0]\n"
                 "[[dp.thruster]]\nposition_m = [-40, 0]\n",
                 {"numerics.time_step_s: the time step is too long for the control of the yaw"}},
        BadScene{"unknown_thruster",
                 "[[dp.thruster]]\nkind = \"rudder\"\n",
                 {"dp.thruster[0].kind: unknown choice", "azimuth, fixed, tunnel"}},
        BadScene{"field_before_boundary",
                 "[floes]\nstart_x_m = -1700\n",
                 {"floes.start_x_m", "at least boundary.inlet_x_m"}},
        BadScene{"field_wider_than_channel", "[floes]\nwidth_m = 500\n", {"bad.toml:2:11: floes.width_m", "at most"}},
        BadScene{"gap_below_platform", "[boundary]\ngap_m = 90\n", {"bad.toml:2:9: boundary.gap_m", "at least 100 m"}},
        BadScene{
            "retired_too_early", "[output]\nretire_x_m = 20\n", {"bad.toml:2:14: output.retire_x_m", "at least 50 m"}},
        BadScene{"ice_sinks", "[ice]\ndensity_kg_per_m3 = 1030\n", {"bad.toml:2:21", "does not float"}},
        BadScene{"file_without_path", "[floes]\nsource = \"file\"\n", {"bad.toml: floes.path: missing"}},
        BadScene{"path_not_used", "[floes]\npath = \"a.csv\"\n", {"bad.toml:2:8: floes.path: has no effect"}},
        BadScene{"concentration_too_low",
                 "[floes]\nconcentration = 0.01\n",
                 {"floes.concentration", "allowed 0 or [0.05, 0.95]"}},
        BadScene{"concentration_too_high", "[floes]\nconcentration = 9.0\n", {"floes.concentration", "[0, 0.95]"}},
        BadScene{"concentration_of_listed_floes",
                 "[floes]\nsource = \"listed\"\nconcentration = 0.9\n",
                 {"floes.concentration", "has no effect"}},
        BadScene{"concave_without_file", "[floes]\nconcave = \"cut\"\n", {"floes.concave", "has no effect"}},
        BadScene{"floes_not_used", "[[floe]]\n" + square, {"bad.toml:1:1: floe:", "set floes.source = \"listed\""}},
        BadScene{"floe_too_large",
                 "[floes]\nsource = \"listed\"\n[[floe]]\n"
                 "outline_m = [[-1e3, -1e3], [1e3, -1e3], [1e3, 1e3], [-1e3, 1e3]]\n",
                 {"floe[0]: size", "value 2000, allowed [0.1, 1000] m"}},
        BadScene{"floe_too_small",
                 "[numerics]\ntime_step_s = 0.01\n[floes]\nsource = \"listed\"\n[[floe]]\n"
                 "outline_m = [[0, 0], [0.05, 0], [0.05, 0.05], [0, 0.05]]\n",
                 {"floe[0]: size", "value 0.05, allowed [0.1, 1000] m"}},
        BadScene{"name_with_slash", "[run]\nname = \"a/b\"\n", {"bad.toml:2:8: run.name"}},
        BadScene{"name_empty", "[run]\nname = \"\"\n", {"bad.toml:2:8: run.name"}},
        BadScene{"name_with_control", "[run]\nname = \"a\\u0007\"\n", {"bad.toml:2:8: run.name", "a\\u0007"}},
        BadScene{"name_with_wide_control", "[run]\nname = \"a\\u009b\"\n", {"bad.toml:2:8: run.name"}},
        BadScene{"text_that_includes", "include = [\"/etc/passwd\"]\n", {"bad.toml:1:11: include: only a file can"}},
        BadScene{"include_in_a_section", "[run]\ninclude = [\"a\"]\n", {"bad.toml:2:1: run.include: unknown key"}},
        BadScene{"hash_that_is_none",
                 "[floes]\nsource = \"file\"\npath = \"a.csv\"\nsha256 = \"AB\"\n",
                 {"bad.toml:4:10: floes.sha256: not a SHA-256", "64 digits"}},
        BadScene{"hash_without_file",
                 "[floes]\nsha256 = \"" + std::string(64, 'a') + "\"\n",
                 {"bad.toml:2:10: floes.sha256: has no effect"}},
        BadScene{"degrees_for_radians",
                 "[floes]\nsource = \"listed\"\n[[floe]]\nangle_rad = 45\n" + square,
                 {"bad.toml:4:13: floe[0].angle_rad: out of range", "45 degrees are 0.785"}},
        BadScene{"too_many_corners",
                 "[[fixed]]\noutline_m = [" +
                     [] {
                       std::string text;
                       for (int i = 0; i < 30; ++i) text += "[" + std::to_string(i) + ", 0], ";
                       return text;
                     }() +
                     "]\n",
                 {"bad.toml:2:13: fixed[0].outline_m: wrong number of corners (value 30, allowed [3, 20])"}},
        BadScene{"sweep_as_case", "[sweep]\nmode = \"list\"\n", {"bad.toml:1:2: sweep", "index"}}),
    [](const auto& test) { return std::string(test.param.name); });

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

TEST(BadScene, ListedFloesLimitTheTimeStep) {
  // Two floes of 2 m closing at 1 m/s: they cover a tenth of a floe in 0.2 s.
  const std::string pair =
      "[current]\nvelocity_m_per_s = [0, 0]\n[boundary]\npresent = false\n[floes]\nsource = \"listed\"\n"
      "[[floe]]\noutline_m = [[0,0],[2,0],[2,2],[0,2]]\nposition_m = [-80, 0]\nvelocity_m_per_s = [0.5, 0]\n"
      "[[floe]]\noutline_m = [[0,0],[2,0],[2,2],[0,2]]\nposition_m = [-70, 0]\nvelocity_m_per_s = [-0.5, 0]\n"
      "[output]\nplatform_interval_s = 1\n[numerics]\ntime_step_s = ";
  EXPECT_EQ(rejection(pair + "0.2\n"), "accepted");
  EXPECT_NE(rejection(pair + "0.21\n").find("allowed at most 0.2 s"), std::string::npos);
}

TEST(BadScene, ThePlatformsStartLimitsTheTimeStep) {
  // A floe of 2 m in still water: the platform moves at 1 m/s and covers a tenth of the floe in 0.2 s.
  const std::string still =
      "[current]\nvelocity_m_per_s = [0, 0]\n[boundary]\npresent = false\n[floes]\nsource = \"listed\"\n"
      "[[floe]]\noutline_m = [[0,0],[2,0],[2,2],[0,2]]\nposition_m = [-80, 0]\n"
      "[output]\nplatform_interval_s = 1\n";
  const std::string thrown = still + "[platform]\nstart_velocity_m_per_s = [-1, 0]\n[numerics]\ntime_step_s = ";
  EXPECT_EQ(rejection(thrown + "0.2\n"), "accepted");
  EXPECT_NE(rejection(thrown + "0.21\n").find("allowed at most 0.2 s"), std::string::npos);
  // Released 10 m from its anchor position, omega = 0.1 /s.
  const std::string released = still +
                               "[mooring]\nstiffness_N_per_m = 1e6\n[platform]\nmass_kg = 1e8\n"
                               "start_offset_m = [10, 0]\n[numerics]\ntime_step_s = ";
  EXPECT_EQ(rejection(released + "0.19\n"), "accepted");
  EXPECT_NE(rejection(released + "0.21\n").find("bodies closing at"), std::string::npos);
}

class SceneFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("gem_scene_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_ / "parts");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }
  std::filesystem::path folder_;
};

TEST_F(SceneFiles, LaterIncludesWinAndPathsFollowTheirFile) {
  write("parts/a.toml", "[platform]\nmass_kg = 2e8\nsides = 12\n[floes]\nsource = \"file\"\npath = \"floes.csv\"\n");
  write("b.toml", "[platform]\nmass_kg = 3e8\n");
  const std::string main =
      write("main.toml", "include = [\"parts/a.toml\", \"b.toml\"]\n[platform]\ndiameter_m = 80\n");
  const SceneDef scene = read_scene(main, {"platform.diameter_m=90"});
  EXPECT_EQ(scene.platform.mass_kg, 3e8);
  EXPECT_EQ(scene.platform.sides, 12);
  EXPECT_EQ(scene.platform.diameter_m, 90.0);
  EXPECT_EQ(scene.floes.path, (folder_ / "parts/floes.csv").string());
}

TEST_F(SceneFiles, IncludeCycleIsRefused) {
  write("b.toml", "include = [\"a.toml\"]\n");
  const std::string a = write("a.toml", "include = [\"./b.toml\"]\n");
  try {
    read_scene(a);
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_rejected);
    EXPECT_NE(std::string(error.what()).find("b.toml:1:12: include: the file includes itself"), std::string::npos)
        << error.what();
  }
}

// Each file includes the next one twice, so that the number of files doubles with the depth.
TEST_F(SceneFiles, IncludesDoNotMultiply) {
  for (int i = 0; i < 15; ++i) {
    const std::string next = "\"f" + std::to_string(i + 1) + ".toml\"";
    write("f" + std::to_string(i) + ".toml", "include = [" + next + ", " + next + "]\n");
  }
  write("f15.toml", "[run]\nseed = 2\n");
  try {
    read_scene((folder_ / "f0.toml").string());
    FAIL() << "accepted";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("include: too many files (allowed 256)"), std::string::npos)
        << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Platform, BadSceneTest,
    testing::Values(
        BadScene{"unknown_outline",
                 "[platform]\noutline = \"shp\"\n",
                 {"bad.toml:2:", "platform.outline: unknown choice", "ship"}},
        BadScene{"listed_without_corners", "[platform]\noutline = \"listed\"\n", {"platform.outline_m: missing"}},
        BadScene{"two_corners",
                 "[platform]\noutline = \"listed\"\noutline_m = [[0, 0], [1, 0]]\n",
                 {"bad.toml:3:", "platform.outline_m: wrong number of corners (value 2, allowed [3, 256])"}},
        BadScene{"too_many_corners",
                 "[platform]\noutline_m = [" + repeated("[0, 0],", 257) + "]\n",
                 {"wrong number of corners (value 257"}},
        BadScene{"ship_too_short",
                 "[platform]\noutline = \"ship\"\nlength_m = 70\n",
                 {"bad.toml:3:", "platform.length_m: the ship is shorter", "at least 80 m"}},
        BadScene{"fixed_with_speed",
                 "[platform]\nfixed = true\nstart_velocity_m_per_s = [1, 0]\n",
                 {"bad.toml:3:", "platform.start_velocity_m_per_s: a fixed platform does not move"}},
        BadScene{"fixed_with_spin",
                 "[platform]\nfixed = true\nstart_spin_rad_per_s = 0.1\n",
                 {"platform.start_spin_rad_per_s: a fixed platform does not move (value 0.1"}},
        BadScene{"field_reaches_the_bow",
                 "[platform]\noutline = \"ship\"\n[floes]\nstart_x_m = -1580\n",
                 {"floes.start_x_m: the field reaches the platform", "allowed at most -1604.87"}}));

INSTANTIATE_TEST_SUITE_P(
    Transit, BadSceneTest,
    testing::Values(
        BadScene{"ship_on_a_mooring",
                 "[transit]\nspeed_m_per_s = 1.0\n",
                 {"mooring.stiffness_N_per_m: a ship in transit is held by its tow alone", "set it to 0"}},
        BadScene{"ship_with_a_start_velocity",
                 "[transit]\nspeed_m_per_s = 1.0\n[platform]\nstart_velocity_m_per_s = [1, 0]\n",
                 {"bad.toml:4:", "platform.start_velocity_m_per_s: the path gives the motion"}},
        BadScene{"ship_that_stands",
                 "[transit]\nspeed_m_per_s = 1.0\n[platform]\nfixed = true\n",
                 {"platform.fixed: a transit needs a platform that moves"}},
        BadScene{"ship_that_cannot_turn",
                 "[transit]\nspeed_m_per_s = 1.0\nway_point_table = [[-900, 0], [-900, 900]]\n[platform]\n"
                 "yaw = \"locked\"\n",
                 {"platform.yaw: the ship turns at its way points"}},
        BadScene{"arcs_that_do_not_fit",
                 "[transit]\nspeed_m_per_s = 1.0\nway_point_table = [[-150, 0], [-150, 900]]\n",
                 {"transit.way_point_table: the arcs do not fit on the way to way point 0 (they need 50 m"}},
        BadScene{"path_that_turns_back",
                 "[transit]\nspeed_m_per_s = 1.0\nway_point_table = [[-900, 0], [0, 0]]\n",
                 {"transit.way_point_table: the arcs do not fit", "the ship turns back there"}},
        BadScene{"thrust_without_speed_in_open_water",
                 "[transit]\nbollard_thrust_N = 1e6\n",
                 {"transit.open_water_speed_m_per_s: a ship with thrust needs its speed in open water"}},
        BadScene{"thrust_around_a_bend",
                 "[transit]\nbollard_thrust_N = 1e6\nopen_water_speed_m_per_s = 6.0\n"
                 "way_point_table = [[-900, 0], [-900, 900]]\n",
                 {"bad.toml:4:", "transit.way_point_table: a ship with thrust keeps to a straight path (value 2"}},
        BadScene{"thrust_with_water_drag",
                 "[transit]\nbollard_thrust_N = 1e6\nopen_water_speed_m_per_s = 6.0\n[platform_drag]\n"
                 "present = true\n",
                 {"platform_drag.present: the thrust of a ship in transit is what the resistance"}},
        BadScene{"thrust_on_a_mooring",
                 "[transit]\nbollard_thrust_N = 1e6\nopen_water_speed_m_per_s = 6.0\n",
                 {"mooring.stiffness_N_per_m: a ship in transit is held by its tow alone"}},
        BadScene{"course_without_transit", "[transit]\ncourse_rad = 7.0\n", {"transit.course_rad: out of range"}}),
    [](const auto& bad) { return bad.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Drive, BadSceneTest,
    testing::Values(BadScene{"row_too_short",
                             "[current]\nvelocity_table = [[0.0, 0.5, 0.0], [60.0, 0.5]]\n",
                             {"bad.toml:2:36", "current.velocity_table: wrong type", "[time s, x m/s, y m/s]"}},
                    BadScene{"cell_out_of_range",
                             "[current]\ndirection_table = [[0.0, 0.5, 0.0], [60.0, 0.5, 90.0]]\n",
                             {"bad.toml:2:", "current.direction_table.direction: out of range (value 90.0",
                              "give it in rad"}},
                    BadScene{"table_is_no_list", "[wind]\nvelocity_table = 3.0\n", {"wind.velocity_table: wrong type"}},
                    BadScene{"times_do_not_rise",
                             "[wind]\nvelocity_table = [[0.0, 5.0, 0.0], [60.0, 5.0, 1.0], [60.0, 5.0, 2.0]]\n",
                             {"wind.velocity_table: the times of the rows do not rise (value 60", "row 3"}},
                    BadScene{"two_tables",
                             "[current]\nvelocity_table = [[0, 0.5, 0]]\ndirection_table = [[0, 0.5, 0]]\n",
                             {"bad.toml:3:", "current.direction_table: so does current.velocity_table"}},
                    BadScene{"period_of_zero",
                             "[current]\ntide_table = [[0.0, 0.1, 0.0, 0.1, 0.0]]\n",
                             {"current.tide_table.period: out of range"}},
                    BadScene{"wind_without_drag",
                             "[wind]\nvelocity_m_per_s = [5, 0]\n[water]\ndrag_law = \"none\"\n",
                             {"water.drag_law: does not hold floes against the wind"}},
                    BadScene{"wind_without_skin_drag",
                             "[wind]\nvelocity_m_per_s = [5, 0]\n[water]\nskin_coefficient = 0.0\n",
                             {"water.skin_coefficient: does not hold floes against the wind"}},
                    BadScene{"turned_linear_drag",
                             "[water]\ndrag_law = \"linear\"\nturning_rad = 0.4\n",
                             {"water.turning_rad: has no effect"}},
                    BadScene{"time_step_for_a_storm",
                             "[wind]\nvelocity_m_per_s = [100, 0]\n[numerics]\ntime_step_s = 0.05\n",
                             {"numerics.time_step_s: the time step is too long"}}),
    [](const auto& bad) { return bad.param.name; });

TEST_F(SceneFiles, UnreadableFilesAreFaultsOfTheFileSystem) {
  const std::string main = write("main.toml", "include = [\"missing.toml\"]\n");
  for (const std::string& path : {main, folder_.string(), (folder_ / "none.toml").string()}) {
    try {
      read_scene(path);
      FAIL() << "accepted " << path;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::file_system) << error.what();
    }
  }
}

}  // namespace
}  // namespace gem
