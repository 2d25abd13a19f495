// The paper's statements are read, and mistakes in the file are reported.
#include "validation/paper/statements/catalogue.h"

#include <gtest/gtest.h>

#include <set>

#include "gem/base/error.h"
#include "gem/scene/sweep/sweep.h"
#include "validation/paper/statements/settings_check.h"

namespace gem {
namespace {

std::string source(const std::string& path) { return std::string(GEM_SOURCE_DIR) + "/" + path; }

/// Names of the runs of sweeps without their seeds.
std::set<std::string> conditions_of(const std::vector<std::string>& sweeps) {
  std::set<std::string> names;
  for (const std::string& sweep : sweeps)
    for (const SweepMember& member : expand_sweep(source("cases/" + sweep + ".toml")))
      names.insert(condition_of(member.name, member.scene.run.seed));
  return names;
}

std::string message_of(const std::string& text) {
  try {
    parse_catalogue(text, "test.json");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::string with_statement(const std::string& rule) {
  return R"({"table1": [], "table2": [], "statements": [{"id": "P1", "source": "s", "says": "t", "metric": "m", "why": "w", )" +
         rule + "}]}";
}

TEST(Catalogue, HoldsTheTablesOfThePaper) {
  const Catalogue catalogue = read_catalogue(source("validation/paper/paper.json"));
  ASSERT_EQ(catalogue.rows.size(), 36U + 6U);
  EXPECT_EQ(catalogue.rows[23].run, "400_300_100");
  EXPECT_EQ(catalogue.rows[23].number, "24");
  EXPECT_EQ(catalogue.rows[35].thick, 1.0);
  EXPECT_EQ(catalogue.rows[35].medium, 2.0);
  EXPECT_EQ(catalogue.rows[40].stiffness_N_per_m, 5e4);
  EXPECT_TRUE(catalogue.rows[41].drag);
}

TEST(Catalogue, OneRunDecidesWhatIsAlikeInAll) {
  std::set<std::string> alike;
  for (const Statement& statement : read_catalogue(source("validation/paper/paper.json")).statements)
    if (statement.alike) alike.insert(statement.metric);
  for (const char* metric : {"floe_count", "floe_size_mean_m", "duration_s"}) EXPECT_TRUE(alike.contains(metric));
  for (const char* metric : {"orbit_largest_m", "x_amplitude_variation", "plug_over_start"})
    EXPECT_FALSE(alike.contains(metric)) << metric;
}

TEST(Catalogue, EveryConditionIsARunOfSomeSweep) {
  const std::set<std::string> names = conditions_of({"table1", "table2", "period_question"});
  const Catalogue catalogue = read_catalogue(source("validation/paper/paper.json"));
  ASSERT_GT(catalogue.statements.size(), 50U);
  for (const TableRow& row : catalogue.rows) EXPECT_TRUE(names.contains(row.run)) << row.run;
  for (const Statement& statement : catalogue.statements) {
    if (!statement.condition.empty()) {
      EXPECT_TRUE(names.contains(statement.condition)) << statement.id << " asks for " << statement.condition;
    }
    if (!statement.against.empty()) {
      EXPECT_TRUE(names.contains(statement.against)) << statement.id;
    }
  }
}

TEST(Catalogue, EveryChoiceHasBothRunsThatItsStatementsAskFor) {
  const std::set<std::string> names = conditions_of({"sensitivity", "sensitivity_moment"});
  const Catalogue catalogue = read_catalogue(source("validation/paper/paper.json"));
  std::size_t asked = 0;
  for (const Statement& statement : catalogue.statements) {
    if (!statement.choice) continue;
    ++asked;
    EXPECT_TRUE(names.contains("as_is__" + statement.condition)) << statement.id;
    EXPECT_TRUE(names.contains("moment_half__" + statement.condition)) << statement.id;
  }
  EXPECT_GT(asked, 10U);
}

TEST(Catalogue, ThirtySeedsHaveTheExposureOfTable1) {
  const std::vector<SweepMember> once = expand_sweep(source("cases/table1.toml"));
  const std::vector<SweepMember> seeds = expand_sweep(source("cases/table1_seeds.toml"));
  ASSERT_EQ(seeds.size(), 30 * once.size());
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    const SceneDef& scene = seeds[i].scene;
    EXPECT_EQ(condition_of(seeds[i].name, scene.run.seed), once[i / 30].name);
    EXPECT_EQ(scene.run.seed, i % 30 + 1);
    EXPECT_TRUE(differing_options(scene, once[i / 30].scene).empty()) << "recorded otherwise, but the same runs";
  }
}

TEST(Catalogue, FaultsAreNamed) {
  EXPECT_NE(message_of("{").find("test.json"), std::string::npos);
  EXPECT_NE(message_of(with_statement(R"("kind": "about", "expected": 1)")).find("P1: unknown kind"),
            std::string::npos);
  EXPECT_NE(message_of(with_statement(R"("kind": "within", "expected": 1)")).find("positive tolerance"),
            std::string::npos);
  EXPECT_NE(message_of(with_statement(R"("kind": "above")")).find("expected"), std::string::npos);
  EXPECT_EQ(message_of(with_statement(R"("kind": "above", "expected": 1)")), "");
  EXPECT_NE(message_of(with_statement(R"("kind": "above", "expected": 1, "share": 1)")).find("'share'"),
            std::string::npos);
  EXPECT_THROW(read_catalogue("/no/such/file.json"), Error);
}

}  // namespace
}  // namespace gem
