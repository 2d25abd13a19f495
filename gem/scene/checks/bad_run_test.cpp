// Faults of name, time step and output.
#include <gtest/gtest.h>

#include <string>

#include "gem/scene/checks/bad_scene.h"

namespace gem {
namespace {

INSTANTIATE_TEST_SUITE_P(
    Run, BadSceneTest,
    testing::Values(BadScene{"time_step_against_floes",
                             "[numerics]\ntime_step_s = 1.7\n",
                             {"bad.toml:2:15: numerics.time_step_s", "value 1.7, allowed at most 1.6 s"}},
                    BadScene{"time_step_against_mooring",
                             "[floes]\ncount = 0\n[mooring]\nstiffness_N_per_m = 1e10\n[numerics]\ntime_step_s = 0.1\n",
                             {"bad.toml:6:15: numerics.time_step_s", "mooring (value 0.1, allowed at most 0.02 s"}},
                    BadScene{"too_many_steps",
                             "[run]\nduration_s = 1e8\n[numerics]\ntime_step_s = 1e-6\n",
                             {"bad.toml:2:14: run.duration_s", "allowed at most 10000 s"}},
                    BadScene{"sample_below_time_step",
                             "[output]\nplatform_interval_s = 0.01\n",
                             {"bad.toml:2:23: output.platform_interval_s", "at least 0.05 s"}},
                    BadScene{"name_with_slash", "[run]\nname = \"a/b\"\n", {"bad.toml:2:8: run.name"}},
                    BadScene{"name_empty", "[run]\nname = \"\"\n", {"bad.toml:2:8: run.name"}},
                    BadScene{
                        "name_with_control", "[run]\nname = \"a\\u0007\"\n", {"bad.toml:2:8: run.name", "a\\u0007"}},
                    BadScene{"name_with_wide_control", "[run]\nname = \"a\\u009b\"\n", {"bad.toml:2:8: run.name"}}),
    bad_scene_name);

TEST(BadScene, ListedFloesLimitTheTimeStep) {
  // Two floes of 2 m closing at 1 m/s: they cover a tenth of a floe in 0.2 s, and a fifth in 0.4 s.
  const std::string pair =
      "[current]\nvelocity_m_per_s = [0, 0]\n[boundary]\npresent = false\n[floes]\nsource = \"listed\"\n"
      "[[floe]]\noutline_m = [[0,0],[2,0],[2,2],[0,2]]\nposition_m = [-80, 0]\nvelocity_m_per_s = [0.5, 0]\n"
      "[[floe]]\noutline_m = [[0,0],[2,0],[2,2],[0,2]]\nposition_m = [-70, 0]\nvelocity_m_per_s = [-0.5, 0]\n"
      "[output]\nplatform_interval_s = 1\n[numerics]\ntime_step_s = ";
  EXPECT_EQ(rejection(pair + "0.4\n"), "accepted");
  EXPECT_NE(rejection(pair + "0.41\n").find("allowed at most 0.4 s"), std::string::npos);
  // Here contacts are seen once they overlap, as with a reach of nothing.
  for (const std::string unseen :
       {"[contact]\nsolver = \"independent\"\n", "[contact]\nsolver = \"coupled\"\nmanifold = \"chord_middle\"\n",
        "contact_reach = 0\n"}) {
    EXPECT_EQ(rejection(pair + "0.2\n" + unseen), "accepted");
    EXPECT_NE(rejection(pair + "0.21\n" + unseen).find("allowed at most 0.2 s"), std::string::npos);
  }
  EXPECT_EQ(rejection(pair + "0.4\ncontact_reach = 1\n"), "accepted");
  EXPECT_NE(rejection(pair + "0.4\ncontact_reach = 0.9\n").find("overlap by more than a tenth"), std::string::npos);
}

TEST(BadScene, ThePlatformsStartLimitsTheTimeStep) {
  // A floe of 2 m in still water: the platform moves at 1 m/s and covers a fifth of the floe in 0.4 s.
  const std::string still =
      "[current]\nvelocity_m_per_s = [0, 0]\n[boundary]\npresent = false\n[floes]\nsource = \"listed\"\n"
      "[[floe]]\noutline_m = [[0,0],[2,0],[2,2],[0,2]]\nposition_m = [-80, 0]\n"
      "[output]\nplatform_interval_s = 1\n";
  const std::string thrown = still + "[platform]\nstart_velocity_m_per_s = [-1, 0]\n[numerics]\ntime_step_s = ";
  EXPECT_EQ(rejection(thrown + "0.4\n"), "accepted");
  EXPECT_NE(rejection(thrown + "0.41\n").find("allowed at most 0.4 s"), std::string::npos);
  // Released 10 m from its anchor position, omega = 0.1 /s.
  const std::string released = still +
                               "[mooring]\nstiffness_N_per_m = 1e6\n[platform]\nmass_kg = 1e8\n"
                               "start_offset_m = [10, 0]\n[numerics]\ntime_step_s = ";
  EXPECT_EQ(rejection(released + "0.39\n"), "accepted");
  EXPECT_NE(rejection(released + "0.41\n").find("bodies closing at"), std::string::npos);
}

}  // namespace
}  // namespace gem
