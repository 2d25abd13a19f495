// Statements are judged by condition, as a ratio of two, and under another choice; settings are compared with the
// tables.
#include "validation/paper/statements/evaluation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "validation/paper/statements/settings_check.h"
#include "validation/paper/studies/sensitivity.h"

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
  for (std::uint64_t seed = 1; seed <= kRunsForShare; ++seed)
    folder.conditions["slow__a"].push_back(run_with("slow__a", seed, 0.5));
  return folder;
}

TEST(Evaluation, JudgesTheRunsOfACondition) {
  const PaperFolder folder = two_conditions();
  const auto verdict = [&](double above) {
    Statement s = statement(RuleKind::above, above);
    s.alike = true;
    return evaluate(s, folder, {}).verdict;
  };
  EXPECT_EQ(verdict(1.5), Verdict::reproduced);
  EXPECT_EQ(verdict(2.5), Verdict::undecidable);
  EXPECT_EQ(verdict(3.5), Verdict::not_reproduced);
  Statement missing = statement(RuleKind::above, 1.0);
  missing.condition = "c";
  const JudgedRow row = evaluate(missing, folder, {});
  EXPECT_EQ(row.verdict, Verdict::undecidable);
  EXPECT_EQ(row.note, "no run c");
}

TEST(Evaluation, FewSeedsDecideNothingAboutEachRunUnlessAllAreAlike) {
  for (std::size_t count = 1; count < kRunsForShare; ++count) {
    PaperFolder folder;
    for (std::uint64_t seed = 1; seed <= count; ++seed) folder.conditions["a"].push_back(run_with("a", seed, 2.0));
    Statement s = statement(RuleKind::above, 1.0);
    const JudgedRow row = evaluate(s, folder, {});
    EXPECT_EQ(row.verdict, Verdict::undecidable) << count;
    EXPECT_EQ(row.one_seed, count == 1);
    s.rule.expected = 3.0;
    EXPECT_EQ(evaluate(s, folder, {}).verdict, Verdict::undecidable) << count;
    s.alike = true;
    EXPECT_EQ(evaluate(s, folder, {}).verdict, Verdict::not_reproduced) << count;
    EXPECT_FALSE(evaluate(s, folder, {}).one_seed);
  }
}

TEST(Evaluation, ARatioTakesBothIntervalsAtTheirWorst) {
  Statement ratio = statement(RuleKind::above, 1.9);
  ratio.against = "b";
  ratio.over = Over::mean;
  PaperFolder folder;
  const auto of = [&](const std::string& name, const RunNumber& number) {
    folder.conditions[name] = {run_with(name, 1, 0.0)};
    folder.conditions[name][0].numbers.add("largest_m", number);
  };
  of("a", {5.0, 4.0, 6.0, true});
  of("b", {1.5, 1.0, 2.0, true});
  const JudgedRow row = evaluate(ratio, folder, {});
  ASSERT_TRUE(row.measured);
  EXPECT_DOUBLE_EQ(row.measured->low, 2.0);
  EXPECT_DOUBLE_EQ(row.measured->high, 6.0);
  EXPECT_EQ(row.verdict, Verdict::reproduced);
  of("b", {0.0, 0.0, 0.0, true});
  EXPECT_EQ(evaluate(ratio, folder, {}).verdict, Verdict::undecidable) << "nothing over nothing";
}

PaperFolder seeds(const std::vector<double>& a, const std::vector<double>& b = {}) {
  PaperFolder folder;
  for (std::size_t i = 0; i < a.size(); ++i) folder.conditions["a"].push_back(run_with("a", i + 1, a[i]));
  for (std::size_t i = 0; i < b.size(); ++i) folder.conditions["b"].push_back(run_with("b", i + 1, b[i]));
  return folder;
}

TEST(Evaluation, TheShareOfSeedsDecidesAboutEachRun) {
  const Statement above = statement(RuleKind::above, 1.0);
  const std::vector<double> most = {2, 2, 2, 2, 2, 2, 2, 2, 2, 0.5};
  const JudgedRow held = evaluate(above, seeds(most), {});
  ASSERT_TRUE(held.share);
  EXPECT_EQ(held.share->holds, 9U);
  EXPECT_EQ(held.share->runs, 10U);
  EXPECT_NEAR(held.share->low, 0.5958, 1e-4);
  EXPECT_EQ(held.verdict, Verdict::reproduced) << "one run of ten that does not obey is no refutation";
  EXPECT_NE(held.measured->interval.find("holds in 9 of 10, 60"), std::string::npos) << held.measured->interval;
  EXPECT_EQ(evaluate(above, seeds({0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 2}), {}).verdict, Verdict::not_reproduced);
  EXPECT_EQ(evaluate(above, seeds({2, 0.5, 2, 0.5, 2, 0.5, 2, 2}), {}).verdict, Verdict::undecidable);
  Statement in_all = above;
  in_all.share = 0.95;
  EXPECT_EQ(evaluate(in_all, seeds(most), {}).verdict, Verdict::undecidable);
}

TEST(Evaluation, TheMeanDecidesAboutAnAverageWhateverTheShare) {
  Statement mean = statement(RuleKind::above, 1.0);
  mean.over = Over::mean;
  // Nine of ten runs lie above 1, but their mean does not clearly.
  EXPECT_EQ(evaluate(mean, seeds({2, 2, 2, 2, 2, 2, 2, 2, 2, -9}), {}).verdict, Verdict::undecidable);
  EXPECT_EQ(evaluate(mean, seeds({0.9, 0.8, 0.7, 0.9, 0.8}), {}).verdict, Verdict::not_reproduced);
  EXPECT_EQ(evaluate(mean, seeds({1.4, 1.6, 1.5, 1.3}), {}).verdict, Verdict::reproduced);
}

TEST(Evaluation, ARatioAboutEachRunPairsTheSeeds) {
  Statement ratio = statement(RuleKind::above, 1.0);
  ratio.against = "b";
  // Every seed obeys, although the smallest of a lies far below the largest of b.
  const JudgedRow row = evaluate(ratio, seeds({2, 4, 6, 8, 10}, {1, 3, 5, 7, 9}), {});
  ASSERT_TRUE(row.share);
  EXPECT_EQ(row.share->holds, 5U);
  EXPECT_EQ(row.verdict, Verdict::reproduced);
}

TEST(Evaluation, ARatioAboutEachRunNeedsCommonSeeds) {
  Statement ratio = statement(RuleKind::above, 1.0);
  ratio.against = "b";
  const JudgedRow none = evaluate(ratio, seeds({2, 4, 6, 8}, {0, 0, 0, 0}), {});
  EXPECT_FALSE(none.measured) << "a ratio to nothing is left out";
  EXPECT_EQ(none.note, "no seed in common");
  const JudgedRow few = evaluate(ratio, seeds({2, 4, 6, 8, 10}, {1, 1, 1}), {});
  EXPECT_EQ(few.measured->each.size(), 3U);
  EXPECT_EQ(few.verdict, Verdict::undecidable);
}

TEST(Evaluation, APairThatNeverPartsObeysNoTime) {
  Statement parting = statement(RuleKind::within, 3300.0);
  parting.rule.tolerance = 900.0;
  parting.condition.clear();
  const double never = std::numeric_limits<double>::infinity();
  const auto judged = [&](const std::vector<double>& times) {
    std::vector<RunNumber> runs;
    for (const double time : times) runs.push_back({time, time, time, false});
    return evaluate(parting, {}, {{"largest_m", *over_runs(runs, Over::every)}}).verdict;
  };
  EXPECT_EQ(judged({never, never, never, never, never, never, never, 3300.0}), Verdict::not_reproduced);
  EXPECT_EQ(judged({3000.0, 3300.0, 3500.0, 2600.0, 4000.0}), Verdict::reproduced);
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
  // For all of 27 pairs Wilson's interval is not a point: its end is n / (n + z^2).
  EXPECT_NEAR(numbers.at("thicker_is_larger_share").low, 27.0 / (27.0 + 1.959964 * 1.959964), 1e-6);
  EXPECT_NEAR(numbers.at("thicker_is_larger_share").high, 1.0, 1e-12);
  EXPECT_FALSE(numbers.contains("simulated_h"));  // without wall times nothing is said about speed
}

TEST(SettingsCheck, SaysWhatShouldBeAlikeAndIsNot) {
  PaperFolder folder = two_conditions();
  TableRow a, b;
  a.run = "a";
  b.run = "b";
  EXPECT_TRUE(mixed_settings(folder, {a, b}).empty());
  folder.conditions["b"][0].scene.boundary.gap_m = 200.0;  // an option that the tables vary
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
