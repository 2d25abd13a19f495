// Faults of floes and the field that is made of them.
#include <gtest/gtest.h>

#include <string>

#include "gem/scene/checks/bad_scene.h"

namespace gem {
namespace {

INSTANTIATE_TEST_SUITE_P(
    Floes, BadSceneTest,
    testing::Values(
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
        BadScene{"field_before_boundary",
                 "[floes]\nstart_x_m = -1700\n",
                 {"floes.start_x_m", "at least boundary.inlet_x_m"}},
        BadScene{"field_wider_than_channel", "[floes]\nwidth_m = 500\n", {"bad.toml:2:11: floes.width_m", "at most"}},
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
        BadScene{"floes_not_used",
                 "[[floe]]\n" + std::string(square_outline),
                 {"bad.toml:1:1: floe:", "set floes.source = \"listed\""}},
        BadScene{"floe_too_large",
                 "[floes]\nsource = \"listed\"\n[[floe]]\n"
                 "outline_m = [[-1e3, -1e3], [1e3, -1e3], [1e3, 1e3], [-1e3, 1e3]]\n",
                 {"floe[0]: size", "value 2000, allowed [0.1, 1000] m"}},
        BadScene{"floe_too_small",
                 "[numerics]\ntime_step_s = 0.01\n[floes]\nsource = \"listed\"\n[[floe]]\n"
                 "outline_m = [[0, 0], [0.05, 0], [0.05, 0.05], [0, 0.05]]\n",
                 {"floe[0]: size", "value 0.05, allowed [0.1, 1000] m"}},
        BadScene{"hash_that_is_none",
                 "[floes]\nsource = \"file\"\npath = \"a.csv\"\nsha256 = \"AB\"\n",
                 {"bad.toml:4:10: floes.sha256: not a SHA-256", "64 digits"}},
        BadScene{"hash_without_file",
                 "[floes]\nsha256 = \"" + std::string(64, 'a') + "\"\n",
                 {"bad.toml:2:10: floes.sha256: has no effect"}}),
    bad_scene_name);

}  // namespace
}  // namespace gem
