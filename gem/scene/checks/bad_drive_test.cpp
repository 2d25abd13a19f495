// Faults of current, wind and drag.
#include <gtest/gtest.h>

#include "gem/scene/checks/bad_scene.h"

namespace gem {
namespace {

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
                             "[wind]\nvelocity_m_per_s = [100, 0]\n[numerics]\ntime_step_s = 0.1\n",
                             {"numerics.time_step_s: the time step is too long"}}),
    bad_scene_name);

}  // namespace
}  // namespace gem
