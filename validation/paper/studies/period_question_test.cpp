// Candidates for the period hold or are refuted by intervals only.
#include "validation/paper/studies/period_question.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace gem {
namespace {

Measured between(double low, double high) { return {0.5 * (low + high), low, high, "test"}; }

/// A folder in which every run oscillates with `period_s(scene)`, known to half a second.
template <typename Period>
PaperFolder folder_of(Period period_s) {
  PaperFolder folder;
  const auto add = [&](const std::string& condition, double stiffness, double current) {
    PaperRun run;
    run.condition = condition;
    run.scene.mooring.stiffness_N_per_m = stiffness;
    run.scene.current.velocity_m_per_s = {current, 0.0};
    const double period = period_s(run.scene);
    const RunNumber number{period, period - 0.5, period + 0.5, true};
    for (const char* name : {"x_period_by_spectrum_s", "x_period_by_crossings_s", "free_period_s"})
      run.numbers.add(name, number);
    run.numbers.add("x_period_by_maxima_s", RunNumber{3.0, 2.9, 3.1, true});
    folder.conditions[condition].push_back(run);
  };
  for (const char* name : {"free_swing", "q_run1", "q_tiled_100m", "q_tiled_50m", "q_independent", "q_independent_1e5",
                           "q_independent_1e7", "q_open", "q_narrow"})
    add(name, 5e5, 0.25);
  add("q_soft", 5e4, 0.25);
  add("q_current_50", 5e5, 0.5);
  add("q_current_100", 5e5, 1.0);
  return folder;
}

double natural(const SceneDef& scene) {
  return 2.0 * std::numbers::pi * std::sqrt(scene.platform.mass_kg / scene.mooring.stiffness_N_per_m);
}

std::vector<Verdict> verdicts(const PaperFolder& folder) {
  std::vector<Verdict> list;
  for (const Candidate& candidate : period_candidates(folder, 72.0)) list.push_back(candidate.verdict);
  return list;
}

constexpr Verdict kHolds = Verdict::reproduced;
constexpr Verdict kRefuted = Verdict::not_reproduced;

TEST(PeriodQuestion, OnlyMassAndMooringExplainTheNaturalPeriod) {
  EXPECT_EQ(verdicts(folder_of(natural)), (std::vector<Verdict>{kHolds, kRefuted, kRefuted, kRefuted, kRefuted}));
}

TEST(PeriodQuestion, OnlyTheMassExplainsAConstantFactor) {
  const auto shorter = [](const SceneDef& scene) { return natural(scene) * 72.0 / natural(SceneDef{}); };
  EXPECT_EQ(verdicts(folder_of(shorter)), (std::vector<Verdict>{kRefuted, kHolds, kRefuted, kRefuted, kRefuted}));
}

TEST(PeriodQuestion, OnlyAPatternFollowsTheCurrent) {
  const auto pattern = [](const SceneDef& scene) { return 18.0 / scene.current.velocity_m_per_s.x; };
  EXPECT_EQ(verdicts(folder_of(pattern)), (std::vector<Verdict>{kRefuted, kRefuted, kRefuted, kRefuted, kHolds}));
}

TEST(PeriodQuestion, MissingRunsDecideNothing) {
  PaperFolder folder = folder_of(natural);
  folder.conditions.erase("q_soft");
  EXPECT_EQ(verdicts(folder).front(), Verdict::undecidable);
  EXPECT_TRUE(period_candidates(PaperFolder{}, 72.0).empty());
}

TEST(PeriodQuestion, AWideIntervalDecidesNothing) {
  PaperFolder folder = folder_of(natural);
  folder.conditions["q_run1"][0].numbers.add("x_period_by_maxima_s", RunNumber{77.0, 60.0, 94.0, true});
  EXPECT_EQ(verdicts(folder)[3], Verdict::undecidable);  // the interval contains 72 s and 88.9 s
  folder.conditions["q_run1"][0].numbers.add("x_period_by_maxima_s", RunNumber{72.5, 71.0, 74.0, true});
  EXPECT_EQ(verdicts(folder)[3], kHolds);
}

TEST(PeriodQuestion, IntervalsDecide) {
  const auto judged = [](double period_s, std::optional<Measured> measured, std::size_t together = 1) {
    return judge_period({"run", "metric", period_s, 72.0, std::move(measured), Verdict::undecidable}, together);
  };
  EXPECT_EQ(judged(88.86, between(88.0, 89.0)), kHolds);
  EXPECT_EQ(judged(80.0, between(88.0, 89.0)), kRefuted);
  EXPECT_EQ(judged(88.86, between(60.0, 95.0)), Verdict::undecidable);
  EXPECT_EQ(judged(91.0, between(88.0, 89.0)), kRefuted);  // a tenth of the distance is 1.9 s
  EXPECT_EQ(judged(90.8, between(88.0, 89.0)), kHolds);
  EXPECT_EQ(judged(91.0, between(88.0, 89.0), 13), kHolds);
  EXPECT_EQ(judged(88.86, between(89.5, 89.6)), kHolds) << "known better than the explanation is meant";
  EXPECT_EQ(judged(88.86, std::nullopt), Verdict::undecidable);
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(judged(88.86, Measured{80.0, -infinity, infinity, ""}), Verdict::undecidable);
  EXPECT_EQ(judge_candidate({}), Verdict::undecidable);
}

}  // namespace
}  // namespace gem
