// Faults of the mooring.
#include <gtest/gtest.h>

#include <string>

#include "gem/scene/checks/bad_scene.h"

namespace gem {
namespace {

INSTANTIATE_TEST_SUITE_P(
    Mooring, BadSceneTest,
    testing::Values(
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
                 {"mooring.line_table: line 1 is torn at the start", "at most its strength of 1e+06 N"}}),
    bad_scene_name);

}  // namespace
}  // namespace gem
