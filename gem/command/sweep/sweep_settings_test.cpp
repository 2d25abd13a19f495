// Which settings distinguish the scenes.
#include "gem/command/sweep/sweep_settings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gem {
namespace {

const SummaryColumn* find(const std::vector<SummaryColumn>& columns, const std::string& name) {
  for (const SummaryColumn& column : columns)
    if (column.name == name) return &column;
  return nullptr;
}

TEST(SweepSettings, NamesWhatVariesAndNothingElse) {
  std::vector<SceneDef> scenes(2);
  scenes[1].run.name = "second";
  scenes[1].current.velocity_m_per_s = {0.3, 0.4};
  scenes[1].platform_drag.present = true;
  scenes[1].contact.solver = ContactSolver::independent;
  scenes[1].floes.classes = {{"thick", 1.2, 1.0}, {"thin", 0.5, 3.0}};
  scenes[1].boundary.present = false;
  const std::vector<SummaryColumn> columns = setting_columns(scenes);
  for (const SummaryColumn& column : columns) EXPECT_TRUE(column.is_setting) << column.name;
  EXPECT_EQ(find(columns, "current_speed_m_per_s")->numbers, (std::vector<double>{0.25, 0.5}));
  EXPECT_EQ(find(columns, "current.velocity_m_per_s.x")->numbers, (std::vector<double>{0.25, 0.3}));
  EXPECT_EQ(find(columns, "current.velocity_m_per_s.y")->numbers, (std::vector<double>{0.0, 0.4}));
  EXPECT_EQ(find(columns, "platform_drag.present")->numbers, (std::vector<double>{0.0, 1.0}));
  EXPECT_EQ(find(columns, "contact.solver")->texts, (std::vector<std::string>{"compliant", "independent"}));
  EXPECT_NEAR(find(columns, "ice_thickness_m")->numbers[1], (1.2 + 3.0 * 0.5) / 4.0, 1e-15);
  EXPECT_TRUE(std::isnan(find(columns, "gap_m")->numbers[1])) << "no boundary, no gap";
  EXPECT_EQ(find(columns, "run.name"), nullptr);
  EXPECT_EQ(find(columns, "mooring.stiffness_N_per_m"), nullptr);
  EXPECT_EQ(find(columns, "seed")->numbers, (std::vector<double>{1.0, 1.0})) << "in any case";
}

}  // namespace
}  // namespace gem
