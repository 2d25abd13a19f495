// Files that are no TOML, or more than a case needs.
#include <gtest/gtest.h>

#include <string>

#include "gem/scene/checks/bad_scene.h"

namespace gem {
namespace {

// Not in the list below: each test of the program would make these 16 MB.
TEST(BadScene, ALargeFileIsRefused) {
  const std::string message = rejection(repeated("#" + repeated("x", 1023), 16385));
  EXPECT_NE(message.find("too large"), std::string::npos) << message;
  EXPECT_NE(message.find("16777216"), std::string::npos) << message;
}

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
        BadScene{"number_with_unit",
                 "[platform_drag]\ndraft_m = 8.0 m  # deep\n",
                 {"bad.toml:2:",
                  "platform_drag.draft_m: a number with a unit (value 8.0 m); write the number alone; "
                  "the unit is in the key's name"}},
        BadScene{"number_with_unit_and_no_blank",
                 "[run]\nduration_s = 20min\n",
                 {"bad.toml:2:", "run.duration_s: a number with a unit (value 20min)"}},
        BadScene{"number_with_unit_in_a_list",
                 "[current]\nvelocity_m_per_s = [0.0, 0.5 m/s]\n",
                 {"current.velocity_m_per_s: a number with a unit (value 0.5 m/s)"}},
        BadScene{"choice_without_quotes",
                 "[contact]\nsolver = coupled\n",
                 {"contact.solver: a text needs quotes (value coupled, allowed independent, coupled, compliant); write "
                  "\"coupled\""}},
        BadScene{
            "text_without_quotes", "[run]\nname = 20min_of_ice # a comment\n", {"bad.toml:2:", "run.name: malformed"}},
        BadScene{"text_with_a_dot_without_quotes",
                 "[floes]\npath = ice.csv\n",
                 {"floes.path: a text needs quotes (value ice.csv); write \"ice.csv\""}},
        BadScene{"flag_in_capitals",
                 "[platform]\nfixed = True\n",
                 {"platform.fixed: wrong type (value True, expected true or false)"}},
        BadScene{"too_large_integer", "[floes]\ncount = 99999999999999999999\n", {"bad.toml:2:", "floes.count"}},
        BadScene{"invalid_utf8", "[run]\nname = \"\xff\xfe\"\n", {"bad.toml:2:", "utf-8"}},
        BadScene{"multi_line_text", "[run]\nname = \"\"\"a\nb\"\"\"\n", {"bad.toml:2:8", "multi-line"}},
        BadScene{"deep_brackets", "x = " + repeated("[", 100000), {"bad.toml:1:", "nested too deep"}},
        BadScene{"deep_keys", repeated("a.", 100000) + "a = 1", {"bad.toml:1:", "nested too deep"}},
        BadScene{
            "deep_quoted_keys", "x = {" + repeated("\"=\".", 100000) + "a = 1}", {"bad.toml:1:", "nested too deep"}},
        BadScene{"long_text", "[run]\nname = \"" + repeated("x", 5000) + "\"\n", {"bad.toml:2:", "too long"}}),
    bad_scene_name);

}  // namespace
}  // namespace gem
