// Loads on the [[fixed]] bodies of a case, from the case to gem analyse.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "gem/command/command_fixture.h"

namespace gem {
namespace {

/// Two floes of 90 t in a row, at rest in a current of 0.5 m/s against the second of two fixed bodies. Linear drag of
/// 100 s pushes each with 90000 kg x 0.5 m/s / 100 s = 450 N.
constexpr const char* row_case = R"([run]
name = "row"
duration_s = 60.0
[current]
velocity_m_per_s = [0.5, 0.0]
[water]
drag_law = "linear"
linear_time_s = 100.0
[boundary]
present = false
[floes]
source = "listed"
[platform]
fixed = true
anchor_m = [0.0, 500.0]
[mooring]
stiffness_N_per_m = 0.0
[output]
contact_forces = true
floes_interval_s = 1.0
retire_x_m = 1000.0
[numerics]
time_step_s = 0.05
residual_tolerance = 1e-6
[[fixed]]
outline_m = [[0.0, 100.0], [10.0, 100.0], [10.0, 110.0], [0.0, 110.0]]
[[fixed]]
outline_m = [[0.0, -10.0], [10.0, -10.0], [10.0, 10.0], [0.0, 10.0]]
[[floe]]
outline_m = [[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0]]
position_m = [-5.01, 0.0]
thickness_m = 1.0
[[floe]]
outline_m = [[-5.0, -5.0], [5.0, -5.0], [5.0, 5.0], [-5.0, 5.0]]
position_m = [-15.02, 0.0]
thickness_m = 1.0
)";

TEST_F(CommandTest, AnalyseSaysTheLoadOnEachFixedBody) {
  std::ofstream(path("row.toml")) << row_case;
  ASSERT_EQ(shell("gem run row.toml -q --threads 1 --engine cpu && gem analyse row.h5 --from 20 --json"), 0)
      << text_of("err");
  const auto findings = nlohmann::json::parse(text_of("out")).at("findings");
  const auto value = [&](const std::string& name) { return findings.at(name).at("value").get<double>(); };
  EXPECT_EQ(value("fixed_0_force_x_mean_N"), 0.0);
  EXPECT_EQ(value("fixed_0_force_largest_N"), 0.0);
  // a floe that rests feels the drag of its velocity after the drag: (1 - exp(-dt / 100 s)) of it each time step
  const double wanted = 900.0 * (1.0 - 0.5 * 0.05 / 100.0);
  // what the iterations leave: the mass of both floes times residual_tolerance x 0.5 m/s, in a time step
  const double left = 180000.0 * 1e-6 * 0.5 / 0.05;
  EXPECT_NEAR(value("fixed_1_force_x_mean_N"), wanted, left);
  EXPECT_NEAR(value("fixed_1_force_largest_N"), wanted, left);
  EXPECT_NEAR(value("fixed_1_force_y_mean_N"), 0.0, left);
  EXPECT_DOUBLE_EQ(value("fixed_all_force_x_mean_N"), value("fixed_1_force_x_mean_N"));
  ASSERT_EQ(shell("gem analyse row.h5 --from 20"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("\n  fixed_1_force_x_mean_N          899."), std::string::npos) << text_of("out");
}

TEST_F(CommandTest, AnalyseSaysNothingOfFixedBodiesWithoutTheForces) {
  std::ofstream(path("row.toml")) << row_case;
  ASSERT_EQ(
      shell("gem run row.toml -q --threads 1 --engine cpu --set output.contact_forces=false && gem analyse row.h5"), 0)
      << text_of("err");
  EXPECT_EQ(text_of("out").find("fixed_"), std::string::npos) << text_of("out");
}

TEST_F(CommandTest, AnalyseSaysTheLoadOnFixedBodiesWithoutAPlatform) {
  const std::string text = row_case;
  const std::size_t begin = text.find("[platform]"), end = text.find("[output]");
  std::ofstream(path("row.toml")) << text.substr(0, begin) + "[platform]\npresent = false\n" + text.substr(end);
  ASSERT_EQ(shell("gem run row.toml -q --threads 1 --engine cpu && gem analyse row.h5 --from 20"), 0) << text_of("err");
  EXPECT_NE(text_of("out").find("\n  fixed_1_force_x_mean_N          899."), std::string::npos) << text_of("out");
  EXPECT_NE(text_of("out").find(": row, 40 s\n"), std::string::npos) << text_of("out");
  EXPECT_EQ(text_of("out").find("contact_fraction"), std::string::npos) << text_of("out");
  EXPECT_EQ(shell("gem analyse row.h5 --from 59.5"), 2);
  EXPECT_NE(text_of("err").find("fewer than 2 floe frames after --from 59.5 s"), std::string::npos) << text_of("err");
  ASSERT_EQ(shell("gem run row.toml -q --threads 1 --engine cpu --out other.h5 --set output.contact_forces=false"), 0);
  EXPECT_EQ(shell("gem analyse other.h5"), 2);
  EXPECT_NE(text_of("err").find("output.contact_forces = true"), std::string::npos) << text_of("err");
}

}  // namespace
}  // namespace gem
