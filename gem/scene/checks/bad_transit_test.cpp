// Faults of a ship in transit.
#include <gtest/gtest.h>

#include "gem/scene/checks/bad_scene.h"

namespace gem {
namespace {

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
    bad_scene_name);

}  // namespace
}  // namespace gem
