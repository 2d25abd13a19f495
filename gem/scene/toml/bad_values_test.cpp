// Keys that do not exist, and values of the wrong type or out of range.
#include <gtest/gtest.h>

#include <string>

#include "gem/scene/checks/bad_scene.h"

namespace gem {
namespace {

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
        BadScene{"unit_in_the_text",
                 "[platform]\nmass_kg = \"1e8 kg\"\n",
                 {"expected a number in kg); write the number alone; the unit is in the key's name"}},
        BadScene{"text_for_number_without_unit",
                 "[platform]\nmass_kg = \"heavy\"\n",
                 {"bad.toml:2:11: platform.mass_kg: wrong type (value \"heavy\", expected a number in kg)"}},
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
        BadScene{
            "list_as_table", "[floe]\n" + std::string(square_outline), {"bad.toml:1:1: floe: wrong type", "[[floe]]"}},
        BadScene{"entry_not_a_table", "floe = [1]\n", {"bad.toml:1:9: floe[0]: wrong type"}},
        BadScene{"unknown_key_in_list",
                 "[[floe]]\n" + std::string(square_outline) + "thicknes_m = 1\n",
                 {"bad.toml:3:1: floe[0].thicknes_m", "`thickness_m`"}},
        BadScene{"outline_missing", "[[fixed]]\n", {"bad.toml:1:1: fixed[0].outline_m: missing"}},
        BadScene{"two_corners",
                 "[[fixed]]\noutline_m = [[0, 0], [1, 1]]\n",
                 {"bad.toml:2:13: fixed[0].outline_m: wrong number of corners (value 2"}},
        BadScene{
            "bad_corner", "[[fixed]]\noutline_m = [[0, 0], [1, nan], [1, 1]]\n", {"bad.toml:2:26: fixed[0].outline_m"}},
        BadScene{"unknown_thruster",
                 "[[dp.thruster]]\nkind = \"rudder\"\n",
                 {"dp.thruster[0].kind: unknown choice", "azimuth, fixed, tunnel"}},
        BadScene{"text_that_includes", "include = [\"/etc/passwd\"]\n", {"bad.toml:1:11: include: only a file can"}},
        BadScene{"include_in_a_section", "[run]\ninclude = [\"a\"]\n", {"bad.toml:2:1: run.include: unknown key"}},
        BadScene{"degrees_for_radians",
                 "[floes]\nsource = \"listed\"\n[[floe]]\nangle_rad = 45\n" + std::string(square_outline),
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
    bad_scene_name);

}  // namespace
}  // namespace gem
