// Statements meet runs: by condition, as a ratio of two, under another choice; and settings meet the printed tables.
#include "gem/report/paper/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/report/paper/sensitivity.h"
#include "gem/report/paper/settings_check.h"

namespace gem {
namespace {

PaperRun run_with(const std::string& condition, std::uint64_t seed, double value) {
  PaperRun run;
  run.condition = condition;
  run.seed = seed;
  run.numbers.add("largest_m", value);
  run.numbers.add("orbit_largest_m", value);
  return run;
}

Statement statement(RuleKind kind, double expected) {
  Statement s;
  s.id = "P1";
  s.condition = "a";
  s.metric = "largest_m";
  s.over = Over::every;
  s.rule = {kind, expected, 0.0};
  s.choice = true;
  return s;
}

PaperFolder two_conditions() {
  PaperFolder folder;
  folder.conditions["a"] = {run_with("a", 1, 2.0), run_with("a", 2, 3.0)};
  folder.conditions["b"] = {run_with("b", 1, 1.0)};
  folder.conditions["slow__a"] = {run_with("slow__a", 1, 0.5)};
  return folder;
}

TEST(Evaluation, JudgesTheRunsOfACondition) {
  const PaperFolder folder = two_conditions();
  EXPECT_EQ(evaluate(statement(RuleKind::above, 1.5), folder, {}).verdict, Verdict::reproduced);
  EXPECT_EQ(evaluate(statement(RuleKind::above, 2.5), folder, {}).verdict, Verdict::undecidable);
  EXPECT_EQ(evaluate(statement(RuleKind::above, 3.5), folder, {}).verdict, Verdict::not_reproduced);
  Statement missing = statement(RuleKind::above, 1.0);
  missing.condition = "c";
  const JudgedRow row = evaluate(missing, folder, {});
  EXPECT_EQ(row.verdict, Verdict::undecidable);
  EXPECT_EQ(row.note, "no run c");
}

TEST(Evaluation, ARatioTakesBothIntervalsAtTheirWorst) {
  Statement ratio = statement(RuleKind::above, 1.9);
  ratio.against = "b";
  const JudgedRow row = evaluate(ratio, two_conditions(), {});
  ASSERT_TRUE(row.measured);
  EXPECT_DOUBLE_EQ(row.measured->low, 2.0);
  EXPECT_DOUBLE_EQ(row.measured->high, 3.0);
  EXPECT_EQ(row.verdict, Verdict::reproduced);
}

TEST(Evaluation, NumbersOfTheFolderHaveNoCondition) {
  Statement s = statement(RuleKind::below, 1.0);
  s.condition.clear();
  EXPECT_EQ(evaluate(s, {}, {}).verdict, Verdict::undecidable);
  EXPECT_EQ(evaluate(s, {}, {{"largest_m", {0.5, 0.4, 0.6, ""}}}).verdict, Verdict::reproduced);
}

TEST(Evaluation, AChoiceHasItsOwnVerdicts) {
  Catalogue catalogue;
  catalogue.statements = {statement(RuleKind::above, 1.0)};
  const std::vector<ChoiceRow> rows = sensitivity(two_conditions(), catalogue);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].choice, "slow");
  EXPECT_EQ(rows[0].statements[0].verdict, Verdict::not_reproduced);
}

TEST(Evaluation, SettingsAreComparedWithTheTable) {
  TableRow row{"1", "1", "a", 0.0, 0.0, 4.0, 400.0, 0.25, 5e5, false};
  PaperFolder folder = two_conditions();
  EXPECT_EQ(compare_settings(row, folder).verdict, Verdict::reproduced);
  row.gap_m = 300.0;
  row.drag = true;
  const JudgedSettings other = compare_settings(row, folder);
  EXPECT_EQ(other.verdict, Verdict::not_reproduced);
  ASSERT_EQ(other.differences.size(), 2U);
  EXPECT_EQ(other.differences[0], "gap 400 m, not 300 m");
  row.run = "c";
  EXPECT_EQ(compare_settings(row, folder).verdict, Verdict::undecidable);
}

TEST(Evaluation, TrendsOverTheConditionsOfTable1) {
  PaperFolder folder;
  Catalogue catalogue;
  for (const auto& [ice, thickness] : {std::pair("004", 0.5), std::pair("040", 0.7), std::pair("400", 1.2)})
    for (const double gap : {400.0, 300.0, 200.0})
      for (const double current : {0.25, 0.5, 1.0}) {
        TableRow row{"1", "", std::string(ice) + "_" + std::to_string(gap) + std::to_string(current)};
        row.gap_m = gap;
        row.current_m_per_s = current;
        PaperRun run = run_with(row.run, 1, 0.1 * thickness * thickness * std::pow(gap, -0.5) * current);
        run.scene.floes.classes[0].thickness_m = thickness;
        run.numbers.add("duration_s", 1.0);
        folder.conditions[row.run] = {run};
        catalogue.rows.push_back(row);
      }
  const FolderNumbers numbers = folder_numbers(folder, catalogue);
  EXPECT_NEAR(numbers.at("excursion_exponent_thickness").value, 2.0, 1e-9);
  EXPECT_NEAR(numbers.at("excursion_exponent_gap").value, -0.5, 1e-9);
  EXPECT_NEAR(numbers.at("excursion_exponent_current").value, 1.0, 1e-9);
  EXPECT_EQ(numbers.at("thicker_is_larger_share").value, 1.0);
  EXPECT_EQ(numbers.at("narrower_is_larger_share").value, 1.0);
  EXPECT_FALSE(numbers.contains("simulated_h"));  // no wall times: nothing is said about speed
}

TEST(SettingsCheck, SaysWhatShouldBeAlikeAndIsNot) {
  PaperFolder folder = two_conditions();
  TableRow a, b;
  a.run = "a";
  b.run = "b";
  EXPECT_TRUE(mixed_settings(folder, {a, b}).empty());
  folder.conditions["b"][0].scene.boundary.gap_m = 200.0;  // the tables vary this
  folder.conditions["b"][0].scene.run.name = "b";
  EXPECT_TRUE(mixed_settings(folder, {a, b}).empty());
  folder.conditions["b"][0].scene.ice.friction_ice = 0.0;
  EXPECT_EQ(mixed_settings(folder, {a, b}),
            std::vector<std::string>{"the runs of the tables differ in ice.friction_ice"});
  EXPECT_TRUE(mixed_settings(folder, {a}).empty());
  folder.conditions["a"][1].scene.run.duration_s = 1.0;
  EXPECT_EQ(mixed_settings(folder, {a}), std::vector<std::string>{"the runs of a differ in run.duration_s"});
}

TEST(Evaluation, TheSeedIsNotPartOfTheCondition) {
  EXPECT_EQ(condition_of("004_400_25_s3", 3), "004_400_25");
  EXPECT_EQ(condition_of("004_400_25_s3", 4), "004_400_25_s3");
  EXPECT_EQ(condition_of("004_400_25", 1), "004_400_25");
}

}  // namespace
}  // namespace gem
