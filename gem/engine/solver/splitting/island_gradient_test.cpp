// Gradient iterations of an island: when they end, and what they find.
#include "gem/engine/solver/splitting/island_gradient.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace gem {
namespace {

constexpr double asked_tolerance = 1e-3;
constexpr std::uint64_t few = GradientControl::asked_units / 32;  // what ends them

/// Goes on to the next iteration that is judged. Returns what follows it.
GradientControl::Next judge(GradientControl& course, const GradientAsked& asked) {
  do course.begin_iteration();
  while (!course.judged());
  return course.after(asked);
}

TEST(GradientPlan, LocksAndUnevenMassesBelongToSplitting) {
  struct Case {
    const char* what;
    IslandSize size;
    float heavy, light;
    bool first, joins;
  };
  for (const Case& c : {Case{"two floes", {2, 2, 1}, 1e5F, 1e5F, true, false},
                        Case{"a small chain", {15, 30, 15}, 1e5F, 1e5F, true, false},
                        Case{"a small chain with a crumb", {15, 30, 15}, 2e5F, 1e2F, false, false},
                        Case{"a lock of a few floes", {15, 60, 30}, 1e5F, 1e5F, false, false},
                        Case{"a long chain", {100, 200, 100}, 1e5F, 1e5F, true, false},
                        Case{"a long chain on a ship", {100, 200, 100}, 2e8F, 1e5F, false, false},
                        Case{"a jam", {100, 300, 200}, 1e5F, 1e5F, true, true},
                        Case{"a plug on a ship", {100, 160, 120}, 2e8F, 1e5F, true, true}}) {
    const GradientPlan plan = gradient_plan(c.size, c.heavy, 1.0F / c.light, 192);
    EXPECT_EQ(plan.first, c.first) << c.what;
    EXPECT_EQ(plan.joins_rounds, c.joins) << c.what;
  }
}

TEST(GradientControl, EndsWhenAllPointsTogetherAskForLittle) {
  GradientControl course(asked_tolerance, 192, false);
  EXPECT_EQ(judge(course, {few + 1, 1e-4F}), GradientControl::Next::iteration);
  EXPECT_GT(course.error(), asked_tolerance);
  EXPECT_EQ(judge(course, {few, 1e-4F}), GradientControl::Next::done);
  EXPECT_LE(course.error(), asked_tolerance);
}

TEST(GradientControl, EndsAJamWhenNoPointAsksForAQuarterOfTheTolerance) {
  const auto largest = static_cast<float>(0.25 * asked_tolerance);
  GradientControl course(asked_tolerance, 192, true);
  EXPECT_EQ(judge(course, {1, 1.01F * largest}), GradientControl::Next::iteration);
  EXPECT_EQ(judge(course, {1000 * few, 0.99F * largest}), GradientControl::Next::done);
  EXPECT_LE(course.error(), asked_tolerance);
}

TEST(GradientControl, NeverJudgesTwoIterationsInARow) {
  GradientControl course(asked_tolerance, 192, false);
  bool last = false;
  for (int k = 0; k < 60; ++k) {
    course.begin_iteration();
    EXPECT_FALSE(course.judged() && last) << k;
    last = course.judged();
  }
}

TEST(GradientControl, GivesUpWhereAPointStaysFarOff) {
  for (const float share : {0.9F, 1.1F}) {
    GradientControl course(asked_tolerance, 192, false);
    auto next = GradientControl::Next::iteration;
    while (next == GradientControl::Next::iteration && course.iteration() < 16)
      next = judge(course, {4 * few, share * 16e-3F});
    EXPECT_EQ(next, share < 1.0F ? GradientControl::Next::iteration : GradientControl::Next::give_up);
    EXPECT_EQ(course.iteration(), 16);
  }
  for (const bool jam : {false, true})
    for (const float asked : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
      GradientControl course(asked_tolerance, 192, jam);
      auto next = GradientControl::Next::iteration;
      while (next == GradientControl::Next::iteration) next = judge(course, {4 * few, asked});
      EXPECT_EQ(next, GradientControl::Next::give_up);
      EXPECT_EQ(course.iteration(), 16);
      EXPECT_TRUE(course.ran_away());
    }
}

TEST(GradientControl, GoesOnInAJamToItsLastIteration) {
  for (const std::int64_t most : {384, 192}) {
    GradientControl course(asked_tolerance, most, true);
    auto next = GradientControl::Next::iteration;
    while (next == GradientControl::Next::iteration) next = judge(course, {4 * few, 0.5F});
    EXPECT_EQ(next, GradientControl::Next::give_up);
    EXPECT_EQ(course.iteration(), most == 384 ? 300 : 188);
    EXPECT_FALSE(course.ran_away());
  }
}

TEST(GradientPlan, HasNoIterationsThatNobodyJudges) {
  for (const std::int64_t most : {1, 2, 3, 4, 5})
    EXPECT_EQ(gradient_plan({3, 4, 2}, 1e5F, 1e-5F, most).first, most > 4);
}

TEST(GradientControl, StaysBelowTheMostIterations) {
  for (const std::int64_t most : {5, 8, 48, 96, 192}) {
    GradientControl course(asked_tolerance, most, false);
    auto next = GradientControl::Next::iteration;
    while (next == GradientControl::Next::iteration) next = judge(course, {4 * few, 1e-9F});
    EXPECT_EQ(next, GradientControl::Next::give_up);
    EXPECT_LT(course.iteration(), most);
    EXPECT_LE(course.iteration(), 96);
  }
}

TEST(GradientControl, ExtrapolatesFromNothingAfterGrowth) {
  GradientControl course(asked_tolerance, 192, false);
  judge(course, {4 * few, 1e-3F});
  EXPECT_GT(course.begin_iteration(), 0.0F);
  judge(course, {4 * few, 3e-3F});
  EXPECT_EQ(course.begin_iteration(), 0.0F);
}

TEST(GradientControl, CountsWhatIsNoNumberAsFarTooMuch) {
  const float units = GradientControl(asked_tolerance, 192, false).units();
  EXPECT_EQ(GradientControl::units_of(0.0F, units), 0);
  EXPECT_EQ(GradientControl::units_of(std::numeric_limits<float>::denorm_min(), units), 1);
  EXPECT_GT(GradientControl::units_of(std::nanf(""), units), static_cast<std::int32_t>(few));
  EXPECT_GT(GradientControl::units_of(std::numeric_limits<float>::infinity(), units), static_cast<std::int32_t>(few));
}

/// A row of bodies that runs into a wall on its left.
struct WallRow {
  static constexpr double mass = 2e4, speed = 0.5;
  std::vector<IslandBody> bodies;
  std::vector<IslandPoint> points;
  std::vector<PointGeometry<double>> geometry;
  std::vector<PointImpulse<double>> impulse;
  std::vector<Motion<double>> motion;

  explicit WallRow(int count) : geometry(count), impulse(count) {
    for (int i = 0; i < count; ++i) {
      bodies.push_back({{1.0 * i, 0.0}, {-speed, 0.0}, 0.0, {1.0 / mass, 0.0}});
      motion.push_back({-speed, 0.0, 0.0, 0.0, 0.0, 0.0});
      PointGeometry<double>& g = geometry[i];
      g.normal_x = 1.0;
      g.friction = 0.3;
      g.cap = 1e30;
      const double points_right = i + 1 < count ? 2.0 : 1.0, points_left = i > 0 ? 2.0 : 0.0;
      set_compliance(g, (points_right + points_left) / mass, 0.0, 0.0);
      points.push_back({i == 0 ? IslandPoint::fixed : i - 1, i, &g, &impulse[i], {}, true});
    }
  }
  bool solve(bool keeps, IslandResult& result) {
    return IslandGradient().solve(bodies, points, motion, {PointFriction::coulomb, asked_tolerance, 0.2, 192, true},
                                  keeps, result);
  }
};

TEST(IslandGradient, StopsAShortRow) {
  constexpr int count = 2;
  WallRow row(count);
  IslandResult result;
  ASSERT_TRUE(row.solve(true, result));
  EXPECT_GT(result.iterations, 0);
  EXPECT_LE(result.error, asked_tolerance);
  for (int i = 0; i < count; ++i) {
    const double behind = i + 1 < count ? row.impulse[i + 1].normal : 0.0;
    EXPECT_GT(row.impulse[i].normal, 0.0);
    EXPECT_NEAR(-WallRow::speed + (row.impulse[i].normal - behind) / WallRow::mass, 0.0, asked_tolerance) << i;
  }
}

TEST(IslandGradient, LeavesALongRowToSplitting) {
  for (const bool keeps : {false, true}) {
    WallRow row(200);
    IslandResult result;
    EXPECT_FALSE(row.solve(keeps, result));
    EXPECT_EQ(result.iterations, 0);
    EXPECT_EQ(row.impulse[0].normal > 0.0, keeps);
    EXPECT_EQ(result.error > asked_tolerance, keeps) << result.error;
  }
}

}  // namespace
}  // namespace gem
