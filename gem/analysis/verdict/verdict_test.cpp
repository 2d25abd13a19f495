// Each criterion at both sides of each of its bounds, and the verdict of all together.
#include <gtest/gtest.h>

#include <limits>

#include "gem/analysis/verdict/energy_criterion.h"
#include "gem/analysis/verdict/judge_run.h"
#include "gem/analysis/verdict/nyquist_criterion.h"
#include "gem/analysis/verdict/overlap_criterion.h"
#include "gem/analysis/verdict/residual_criterion.h"
#include "gem/analysis/verdict/softened_criterion.h"
#include "gem/analysis/verdict/speed_criterion.h"
#include "gem/analysis/verdict/unfinished_criterion.h"
#include "gem/analysis/verdict/verdict_words.h"

namespace gem {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A run of which everything was measured and nothing is wrong, in a current of 0.5 m/s.
RunMeasures healthy() {
  RunMeasures run;
  run.speed_scale = 0.5;
  run.squeeze_friction = 0.25;
  run.overlap_share = {0.001, 12.0};
  run.unfinished_share = 0.0;
  run.residual = {1e-6, 3.0};
  run.residual_median = run.residual_most = 1e-6;
  run.floe_speed = {0.5, 40.0};
  run.energy_created = 0.0;
  run.energy_lost = 600.0;
  run.energy_largest = 400.0;
  run.nyquist_share = 0.4;
  run.loaded_steps = 1000;
  return run;
}

struct Row {
  const char* criterion;
  Judgement (*judge)(const RunMeasures&);
  void (*set)(RunMeasures& run, double value);
  double doubtful_above, bad_above;  // in the unit of `value`
};

// The factors: speeds are over 0.5 m/s, energies over 1000 J.
const Row rows[] = {
    {"overlap", judge_overlap, [](RunMeasures& run, double value) { run.overlap_share.value = value; }, 0.05, 0.25},
    {"unfinished_steps", judge_unfinished, [](RunMeasures& run, double value) { run.unfinished_share = value; }, 0.001,
     std::numeric_limits<double>::infinity()},
    {"residual", judge_residual, [](RunMeasures& run, double value) { run.residual_most = value; }, 0.025, 0.1},
    {"floe_speed", judge_speed, [](RunMeasures& run, double value) { run.floe_speed.value = value; }, 1.0, 2.0},
    {"created_energy", judge_energy, [](RunMeasures& run, double value) { run.energy_created = value; }, 10.0, 100.0},
    {"softened_share", judge_softened, [](RunMeasures& run, double value) { run.softened_share = value; }, 0.05, 0.5},
    {"nyquist_share", judge_nyquist, [](RunMeasures& run, double value) { run.nyquist_share = value; }, 0.6, 0.75},
};

Judgement judged(const Row& row, double value) {
  RunMeasures run = healthy();
  row.set(run, value);
  return row.judge(run);
}

TEST(Verdict, EachCriterionAtBothSidesOfItsBounds) {
  const double below = 1.0 - 1e-9, above = 1.0 + 1e-9;
  for (const Row& row : rows) {
    SCOPED_TRACE(row.criterion);
    EXPECT_EQ(judged(row, 0.0).criterion, row.criterion);
    EXPECT_EQ(judged(row, 0.0).grade, Grade::good);
    EXPECT_EQ(judged(row, below * row.doubtful_above).grade, Grade::good);
    EXPECT_EQ(judged(row, above * row.doubtful_above).grade, Grade::doubtful);
    if (!std::isfinite(row.bad_above)) {
      EXPECT_EQ(judged(row, 1e300).grade, Grade::doubtful);
      continue;
    }
    EXPECT_EQ(judged(row, below * row.bad_above).grade, Grade::doubtful);
    EXPECT_EQ(judged(row, above * row.bad_above).grade, Grade::bad);
    EXPECT_EQ(judged(row, std::numeric_limits<double>::infinity()).grade, Grade::bad);
  }
}

TEST(Verdict, ACriterionWithoutAValueIsNotJudgedAndSaysWhy) {
  for (const Row& row : rows) {
    const Judgement judgement = judged(row, nothing);
    EXPECT_EQ(judgement.grade, Grade::not_judged) << row.criterion;
    EXPECT_TRUE(std::isnan(judgement.value)) << row.criterion;
    EXPECT_FALSE(judgement.text.empty()) << row.criterion;
    EXPECT_EQ(judgement.text.find("nan"), std::string::npos) << judgement.text;
  }
}

TEST(Verdict, TheTextHasNumberBoundsTimeAndAdvice) {
  const Judgement bad = judged(rows[0], 0.5);
  EXPECT_EQ(
      bad.text.find("deepest overlap 50 % of the smaller body's size at 12 s (doubtful above 5 %, bad above 25 %); "),
      0U)
      << bad.text;
  EXPECT_NE(bad.text.find("numerics.time_step_s"), std::string::npos) << bad.text;
  EXPECT_EQ(judged(rows[0], 0.01).text,
            "deepest overlap 1 % of the smaller body's size at 12 s (doubtful above 5 %, bad above 25 %)");
  const Judgement unfinished = judged(rows[1], 0.5);
  EXPECT_EQ(unfinished.text.find("bad above"), std::string::npos) << unfinished.text;
  EXPECT_NE(unfinished.text.find("of the driving speed 0.5 m/s, the worst "), std::string::npos) << unfinished.text;
}

TEST(Verdict, ASqueezedFloeIsAllowedTheSpeedOfItsWedge) {
  // 1 / mu, not below 3 and not above 10
  EXPECT_DOUBLE_EQ(largest_speed_ratio(0.25), 4.0);
  EXPECT_DOUBLE_EQ(largest_speed_ratio(0.0), 10.0);
  EXPECT_DOUBLE_EQ(largest_speed_ratio(1.4), 3.0);
}

TEST(Verdict, ASceneAtRestHasADrivingSpeed) {
  RunMeasures run = healthy();
  run.speed_scale = 0.0;
  run.floe_speed = {1e-4, 1.0};
  EXPECT_DOUBLE_EQ(judge_speed(run).value, 0.1);
}

TEST(Verdict, EnergyFromNowhereIsBadAlsoWhereNothingMoved) {
  RunMeasures run = healthy();
  run.energy_lost = run.energy_largest = 0.0;
  EXPECT_EQ(judge_energy(run).grade, Grade::good);
  run.energy_created = 1.0;
  EXPECT_EQ(judge_energy(run).grade, Grade::bad);
}

TEST(Verdict, AForceOfFewTimeStepsIsNotJudged) {
  RunMeasures run = healthy();
  run.nyquist_share = 1.0;
  EXPECT_EQ(judge_nyquist(run).grade, Grade::bad);
  run.loaded_steps = least_loaded_steps - 1;
  EXPECT_EQ(judge_nyquist(run).grade, Grade::not_judged);
}

TEST(Verdict, TheWorstCriterionDecides) {
  RunMeasures run = healthy();
  EXPECT_EQ(judge_run(run).grade, Grade::good);
  EXPECT_EQ(judge_run(run).judgements.size(), std::size(rows) - 1) << "softened_share is of compliant contacts";
  run.unfinished_share = 0.9;
  EXPECT_EQ(judge_run(run).grade, Grade::doubtful);
  run.overlap_share = {0.5, 7.0};
  EXPECT_EQ(judge_run(run).grade, Grade::bad);
}

TEST(Verdict, CompliantContactsAreNotJudgedByIterations) {
  RunMeasures run = healthy();
  run.compliant = true;
  run.unfinished_share = run.residual_most = nothing;
  run.softened_share = 0.01;
  const RunVerdict verdict = judge_run(run);
  EXPECT_EQ(verdict.grade, Grade::good);
  EXPECT_EQ(criteria_of_grade(verdict, Grade::good),
            "overlap, softened_share, floe_speed, created_energy, nyquist_share");
  EXPECT_EQ(verdict.judgements[0].text.find("deepest overlap beyond crushed ice 0.1 %"), 0U);
  run.energy_created = 50.0;
  EXPECT_EQ(judge_energy(run).text.find("the books of the contacts leave 50 J unexplained, 5 % of "), 0U)
      << judge_energy(run).text;
  EXPECT_NE(judge_energy(run).text.find("numerics.substeps"), std::string::npos);
}

TEST(Verdict, WhatIsNotMeasuredDoesNotDecide) {
  RunMeasures run = healthy();
  run.energy_created = run.energy_lost = run.unfinished_share = run.residual_most = nothing;
  EXPECT_EQ(judge_run(run).grade, Grade::good);
  RunMeasures empty;
  EXPECT_EQ(judge_run(empty).grade, Grade::not_judged);
}

TEST(Verdict, ARunThatStoppedByItselfIsBad) {
  const RunVerdict verdict = judge_stopped_run(healthy(), "floe 3 has a speed that is not finite");
  EXPECT_EQ(verdict.grade, Grade::bad);
  EXPECT_EQ(verdict.judgements.back().criterion, "stopped");
  EXPECT_EQ(verdict.judgements.back().text, "floe 3 has a speed that is not finite");
}

}  // namespace
}  // namespace gem
