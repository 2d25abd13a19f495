// Faults of the platform.
#include <gtest/gtest.h>

#include "gem/scene/checks/bad_scene.h"

namespace gem {
namespace {

INSTANTIATE_TEST_SUITE_P(
    Platform, BadSceneTest,
    testing::Values(
        BadScene{"gap_below_platform", "[boundary]\ngap_m = 90\n", {"bad.toml:2:9: boundary.gap_m", "at least 100 m"}},
        BadScene{
            "retired_too_early", "[output]\nretire_x_m = 20\n", {"bad.toml:2:14: output.retire_x_m", "at least 50 m"}},
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
        BadScene{"pieces_without_a_piece",
                 "[platform]\noutline = \"pieces\"\n",
                 {"platform.piece: missing (platform.outline = \"pieces\"); give the pieces as [[platform.piece]]"}},
        BadScene{"piece_without_corners",
                 "[platform]\noutline = \"pieces\"\n[[platform.piece]]\n",
                 {"bad.toml:3:", "platform.piece[0].outline_m: missing"}},
        BadScene{"pieces_as_one_table",
                 "[platform]\noutline = \"pieces\"\n[platform.piece]\noutline_m = [[0, 0], [1, 0], [0, 1]]\n",
                 {"platform.piece: wrong type", "expected [[platform.piece]]"}},
        BadScene{"too_many_pieces",
                 "[platform]\noutline = \"pieces\"\n" +
                     repeated("[[platform.piece]]\noutline_m = [[0, 0], [1, 0], [0, 1]]\n", 65),
                 {"platform.piece: too many pieces (value 65, allowed at most 64)"}},
        BadScene{"ship_too_short",
                 "[platform]\noutline = \"ship\"\nlength_m = 70\n",
                 {"bad.toml:3:", "platform.length_m: the ship is shorter", "at least 80 m"}},
        BadScene{"fixed_with_speed",
                 "[platform]\nfixed = true\nstart_velocity_m_per_s = [1, 0]\n",
                 {"bad.toml:3:", "platform.start_velocity_m_per_s: a fixed platform does not move"}},
        BadScene{"fixed_with_spin",
                 "[platform]\nfixed = true\nstart_spin_rad_per_s = 0.1\n",
                 {"platform.start_spin_rad_per_s: a fixed platform does not move (value 0.1"}},
        BadScene{"coupling_of_added_mass_too_large",
                 "[added_mass]\nsway_kg = 4e6\nyaw_kg_m2 = 1e8\nsway_yaw_kg_m = 3e7\n",
                 {"bad.toml:4:", "added_mass.sway_yaw_kg_m: the matrix of the added mass is not positive (value 3e+07",
                  "allowed up to 2e+07"}},
        BadScene{"added_mass_below_zero",
                 "[added_mass]\nsurge_kg = -1\n",
                 {"bad.toml:2:", "added_mass.surge_kg", "[0, 1e+12]"}},
        BadScene{"added_mass_with_a_damping_ratio",
                 "[mooring]\ndamping_ratio = 0.1\n[added_mass]\nsway_kg = 1e7\n",
                 {"bad.toml:2:", "mooring.damping_ratio: has no meaning", "mooring.damping_N_s_per_m"}},
        BadScene{"added_mass_in_transit",
                 "[transit]\nspeed_m_per_s = 1\nway_point_table = [[0, 0]]\n[added_mass]\nsway_kg = 1e7\n",
                 {"added_mass.surge_kg: the path of a ship in transit gives its motion"}},
        BadScene{"unknown_law_of_drag",
                 "[platform_drag]\nlaw = \"axis\"\n",
                 {"bad.toml:2:", "platform_drag.law: unknown choice", "by_axis"}},
        BadScene{"surge_of_the_round_law",
                 "[platform_drag]\npresent = true\nsurge_coefficient = 0.2\n",
                 {"bad.toml:3:", "platform_drag.surge_coefficient: has no effect (value 0.2",
                  "only with platform_drag.law = \"by_axis\""}},
        BadScene{"sway_of_the_round_law",
                 "[platform_drag]\nsway_coefficient = 0.0\n",
                 {"bad.toml:2:", "platform_drag.sway_coefficient: has no effect (value 0"}},
        BadScene{"yaw_of_the_round_law",
                 "[platform_drag]\nlaw = \"round\"\nyaw_coefficient = 1.0\n",
                 {"bad.toml:3:", "platform_drag.yaw_coefficient: has no effect (value 1"}},
        BadScene{"coefficient_of_the_other_law_at_its_default",
                 "[platform_drag]\nlaw = \"by_axis\"\ncoefficient = 0.8\n",
                 {"bad.toml:3:", "platform_drag.coefficient: has no effect (value 0.8",
                  "remove it; platform_drag.surge_coefficient, platform_drag.sway_coefficient and "
                  "platform_drag.yaw_coefficient "
                  "count instead"}},
        BadScene{"axes_at_their_defaults_without_a_law",
                 "[platform_drag]\nsurge_coefficient = 0.1\nsway_coefficient = 0.7\nyaw_coefficient = 0.7\n",
                 {"bad.toml:2:21: platform_drag.surge_coefficient: has no effect (value 0.1, allowed only with "
                  "platform_drag.law = \"by_axis\"; the same holds for platform_drag.sway_coefficient and "
                  "platform_drag.yaw_coefficient); set platform_drag.law = \"by_axis\", or remove them"}},
        BadScene{"axes_at_their_defaults_of_the_round_law",
                 "[platform_drag]\nlaw = \"round\"\nsway_coefficient = 0.7\n",
                 {"platform_drag.sway_coefficient: has no effect (value 0.7",
                  "remove it; platform_drag.coefficient counts instead, or set platform_drag.law = \"by_axis\""}},
        BadScene{"round_coefficient_by_axis",
                 "[platform_drag]\nlaw = \"by_axis\"\ncoefficient = 0.5\n",
                 {"bad.toml:3:", "platform_drag.coefficient: has no effect (value 0.5",
                  "only with platform_drag.law = \"round\"", "sway_coefficient"}},
        BadScene{"drag_coefficient_below_zero",
                 "[platform_drag]\nlaw = \"by_axis\"\nyaw_coefficient = -0.5\n",
                 {"bad.toml:3:", "platform_drag.yaw_coefficient", "[0, 100]"}},
        BadScene{"field_reaches_the_bow",
                 "[platform]\noutline = \"ship\"\n[floes]\nstart_x_m = -1580\n",
                 {"floes.start_x_m: the field reaches the platform", "allowed at most -1604.87"}}),
    bad_scene_name);

}  // namespace
}  // namespace gem
