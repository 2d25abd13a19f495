// Faults of dynamic positioning.
#include <gtest/gtest.h>

#include <string>

#include "gem/scene/checks/bad_scene.h"

namespace gem {
namespace {

INSTANTIATE_TEST_SUITE_P(
    Dp, BadSceneTest,
    testing::Values(
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
                 {"numerics.time_step_s: the time step is too long for the control of the yaw"}}),
    bad_scene_name);

}  // namespace
}  // namespace gem
