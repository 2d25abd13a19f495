// A study sorts its runs, leaves out incomplete draws, and uses what its design allows.
#include "gem/analysis/sensitivity/study.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace gem {
namespace {

/// 50 draws in two conditions, each with two seeds: y = 10 friction + a number that only the seed knows.
Study plain_study() {
  Study study;
  study.inputs = {{"friction", "ice.friction_ice", "uniform", false}, {"field", "run.seed", "uniform", true}};
  study.outputs = {"force_N", "constant"};
  for (const char* condition : {"thin", "thick"})
    for (int draw = 1; draw <= 50; ++draw)
      for (int repeat = 1; repeat <= 2; ++repeat) {
        const double friction = std::fmod(0.618034 * draw, 1.0),
                     field = std::fmod(0.7548777 * (2 * draw + repeat), 1.0);
        study.runs.push_back({"", condition, draw, "", repeat, {friction, field}, {10.0 * friction + field, 1.0}});
      }
  return study;
}

TEST(Study, GivesTheSharesOfEachCondition) {
  const Study study = plain_study();
  const std::vector<ConditionEffects> effects = study_effects(study, {100});
  ASSERT_EQ(effects.size(), 2u);
  EXPECT_EQ(effects[1].condition, "thick");
  const OutputEffects& force = effects[0].outputs[0];
  EXPECT_EQ(force.draws, 50u);
  EXPECT_EQ(force.runs, 100u);
  EXPECT_EQ(force.left_out, 0u);
  EXPECT_NEAR(force.mean->value, 5.5, 0.2);
  EXPECT_NEAR(force.inputs[0].linear->share.value, 100.0 / 101.0, 0.01);
  EXPECT_NEAR(force.inputs[1].total->value, 1.0 / 101.0, 0.01);
  EXPECT_TRUE(force.inputs[0].first.has_value());
  EXPECT_FALSE(force.inputs[1].linear.has_value()) << "a seed has no trend";
  EXPECT_FALSE(force.inputs[0].total.has_value()) << "the design does not give it";
  const OutputEffects& constant = effects[0].outputs[1];
  EXPECT_FALSE(constant.inputs[0].linear.has_value());
  EXPECT_EQ(constant.mean->value, 1.0);
}

TEST(Study, TheOrderOfTheRunsChangesNothing) {
  Study study = plain_study();
  const auto before = study_effects(study, {20});
  std::reverse(study.runs.begin() + 1, study.runs.begin() + 100);
  const auto after = study_effects(study, {20});
  EXPECT_EQ(before[0].outputs[0].inputs[0].linear->share.high, after[0].outputs[0].inputs[0].linear->share.high);
  EXPECT_EQ(before[0].outputs[0].mean->value, after[0].outputs[0].mean->value);
}

TEST(Study, DrawsWithoutAllTheirRunsAreLeftOut) {
  Study study = plain_study();
  study.runs[3].outputs[0] = std::nan("");  // draw 2 of the thin ice
  study.runs.erase(study.runs.begin());     // a repeat of draw 1
  const auto effects = study_effects(study, {20});
  EXPECT_EQ(effects[0].outputs[0].draws, 48u);
  EXPECT_EQ(effects[0].outputs[0].left_out, 2u);
  EXPECT_EQ(effects[1].outputs[0].left_out, 0u);
}

TEST(Study, ASaltelliDesignHasFirstAndTotalIndices) {
  Study study;
  study.inputs = {
      {"a", "x.a", "uniform", false}, {"b", "x.b", "uniform", false}, {"field", "run.seed", "uniform", true}};
  study.outputs = {"y"};
  const auto number = [](int draw, int k) { return std::fmod(draw * (0.618034 + 0.1371 * k) + 0.37 * k, 1.0); };
  for (int draw = 1; draw <= 400; ++draw) {
    const std::vector<double> a = {number(draw, 0), number(draw, 1), number(draw, 2)};
    const std::vector<double> b = {number(draw, 3), number(draw, 4), number(draw, 5)};
    const auto add = [&](const std::string& part, const std::vector<double>& x) {
      study.runs.push_back({"", "", draw, part, 1, x, {2.0 * x[0] + x[1] + 1e-9 * x[2]}});
    };
    add("A", a);
    add("B", b);
    add("a", {b[0], a[1], a[2]});
    add("b", {a[0], b[1], a[2]});
    add("field", {a[0], a[1], b[2]});
  }
  const auto effects = study_effects(study, {50});
  const OutputEffects& y = effects.at(0).outputs.at(0);
  EXPECT_EQ(y.runs, 800u) << "A and B are independent";
  EXPECT_NEAR(y.inputs[0].first->value, 0.8, 0.05);
  EXPECT_NEAR(y.inputs[1].total->value, 0.2, 0.05);
  EXPECT_NEAR(y.inputs[2].total->value, 0.0, 1e-6);
  EXPECT_NEAR(y.inputs[0].linear->share.value, 0.8, 0.05);
  study.runs.pop_back();
  EXPECT_EQ(study_effects(study, {20})[0].outputs[0].left_out, 1u);
  std::erase_if(study.runs, [](const StudyRun& run) { return run.part == "b"; });
  EXPECT_FALSE(study_effects(study, {20})[0].outputs[0].inputs[0].first.has_value());
}

}  // namespace
}  // namespace gem
