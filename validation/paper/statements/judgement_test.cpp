// Verdicts: the whole interval, none of it, or part of it obeys the rule.
#include "validation/paper/statements/judgement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gem {
namespace {

Measured between(double low, double high) { return {0.5 * (low + high), low, high, "test"}; }

TEST(Judgement, WithinNeedsTheWholeInterval) {
  const Rule rule{RuleKind::within, 72.0, 3.6};
  EXPECT_EQ(judge(rule, between(70.0, 74.0)), Verdict::reproduced);
  EXPECT_EQ(judge(rule, between(88.0, 89.0)), Verdict::not_reproduced);
  EXPECT_EQ(judge(rule, between(60.0, 67.0)), Verdict::not_reproduced);
  EXPECT_EQ(judge(rule, between(70.0, 80.0)), Verdict::undecidable);
  EXPECT_EQ(judge(rule, between(50.0, 90.0)), Verdict::undecidable);
}

TEST(Judgement, AboveAndBelow) {
  const Rule above{RuleKind::above, 1.0, 0.0};
  EXPECT_EQ(judge(above, between(1.1, 2.0)), Verdict::reproduced);
  EXPECT_EQ(judge(above, between(0.1, 1.0)), Verdict::not_reproduced);
  EXPECT_EQ(judge(above, between(0.9, 1.1)), Verdict::undecidable);
  const Rule below{RuleKind::below, 1.0, 0.0};
  EXPECT_EQ(judge(below, between(0.1, 0.9)), Verdict::reproduced);
  EXPECT_EQ(judge(below, between(1.0, 2.0)), Verdict::not_reproduced);
  EXPECT_EQ(judge(below, between(0.9, 1.1)), Verdict::undecidable);
}

TEST(Judgement, ALargeChanceProvesNothing) {
  const Rule rule{RuleKind::significant, 0.05, 0.0};
  EXPECT_EQ(judge(rule, between(0.01, 0.04)), Verdict::reproduced);
  EXPECT_EQ(judge(rule, between(0.6, 0.6)), Verdict::undecidable);
}

TEST(Judgement, NothingMeasuredIsUndecidable) {
  for (const RuleKind kind : {RuleKind::within, RuleKind::above, RuleKind::below, RuleKind::significant}) {
    EXPECT_EQ(judge({kind, 1.0, 1.0}, std::nullopt), Verdict::undecidable);
    EXPECT_EQ(judge({kind, 1.0, 1.0}, Measured{std::nan(""), 0.0, 2.0, ""}), Verdict::undecidable);
  }
}

TEST(Judgement, OneRunWithoutIntervalDecidesNothingAboutAMean) {
  const auto measured = over_runs({{5.0, 5.0, 5.0, false}}, Over::mean);
  EXPECT_EQ(judge({RuleKind::above, 1.0, 0.0}, measured), Verdict::undecidable);
  const auto with_interval = over_runs({{5.0, 4.0, 6.0, true}}, Over::mean);
  EXPECT_EQ(judge({RuleKind::above, 1.0, 0.0}, with_interval), Verdict::reproduced);
}

TEST(Judgement, RunsBecomeOneNumber) {
  const std::vector<RunNumber> runs = {{1.0, 1.0, 1.0, false}, {2.0, 2.0, 2.0, false}, {6.0, 6.0, 6.0, false}};
  const auto mean = over_runs(runs, Over::mean);
  EXPECT_NEAR(mean->value, 3.0, 1e-12);
  EXPECT_LT(mean->low, 3.0);
  EXPECT_GT(mean->high, 3.0);
  const auto every = over_runs(runs, Over::every);
  EXPECT_EQ(every->value, 2.0);
  EXPECT_EQ(every->low, 1.0);
  EXPECT_EQ(every->high, 6.0);
  EXPECT_FALSE(over_runs({}, Over::mean));
  const auto chance = over_runs({{0.1, 0.1, 0.1, false}, {0.2, 0.2, 0.2, false}}, Over::chances);
  EXPECT_GT(chance->value, 0.02);
  EXPECT_LT(chance->value, 0.1);
}

TEST(Judgement, SeedsThatChangeNothingAreOneRun) {
  const auto same = over_runs({{5.0, 4.0, 6.0, true}, {5.0, 4.0, 6.0, true}}, Over::mean);
  EXPECT_EQ(same->low, 4.0);
  EXPECT_EQ(same->high, 6.0);
}

TEST(Judgement, RulesAreRead) {
  EXPECT_EQ(rule_kind("within"), RuleKind::within);
  EXPECT_EQ(rule_kind("significant"), RuleKind::significant);
  EXPECT_FALSE(rule_kind("about"));
  EXPECT_EQ(rule_text({RuleKind::within, 72.0, 3.6}), "72 ± 3.6");
}

}  // namespace
}  // namespace gem
