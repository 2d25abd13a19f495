// A slope common to groups that have different levels.
#include "validation/paper/analysis/fits/line_fit.h"

#include <gtest/gtest.h>

#include <random>
#include <stdexcept>
#include <vector>

namespace gem {
namespace {

struct Points {
  std::vector<double> x, y;
  std::vector<std::uint64_t> group;
};

/// Five groups of four points. Their levels scatter a hundred times more than the points about the slope of -2.
Points scattered(unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> noise;
  Points points;
  for (std::uint64_t group = 0; group < 5; ++group) {
    const double level = 100.0 * noise(engine);
    for (int i = 0; i < 4; ++i) {
      points.x.push_back(i);
      points.y.push_back(level - 2.0 * i + noise(engine));
      points.group.push_back(group);
    }
  }
  return points;
}

TEST(CommonSlope, IsFoundBelowTheScatterOfTheLevels) {
  int held = 0;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const Points p = scattered(seed);
    const IntervalEstimate slope = common_slope(p.x, p.y, p.group);
    EXPECT_LT(slope.high - slope.low, 2.0);
    held += slope.holds(-2.0) ? 1 : 0;
  }
  EXPECT_NEAR(held / 400.0, 0.95, 0.035);  // three standard deviations of a share of 400
  const Points p = scattered(1);
  EXPECT_GT(fit_line(p.x, p.y).slope.high - fit_line(p.x, p.y).slope.low, 20.0);
}

TEST(CommonSlope, OfOneGroupIsThatOfALine) {
  const std::vector<double> x = {0.0, 1.0, 2.0, 5.0}, y = {1.0, 2.5, 2.0, 7.0};
  const IntervalEstimate slope = common_slope(x, y, std::vector<std::uint64_t>(4, 7));
  const IntervalEstimate line = fit_line(x, y).slope;
  EXPECT_NEAR(slope.value, line.value, 1e-12);
  EXPECT_NEAR(slope.low, line.low, 1e-12);
  EXPECT_NEAR(slope.high, line.high, 1e-12);
}

TEST(CommonSlope, AsksForEnough) {
  const std::vector<double> x = {0.0, 1.0, 2.0}, y = {1.0, 2.0, 3.0};
  EXPECT_THROW(common_slope(x, y, std::vector<std::uint64_t>{1, 1, 2}), std::invalid_argument);
  EXPECT_THROW(common_slope(x, y, std::vector<std::uint64_t>{1, 1}), std::invalid_argument);
  const std::vector<double> alike = {1.0, 1.0, 1.0};
  EXPECT_THROW(common_slope(alike, y, std::vector<std::uint64_t>{1, 1, 1}), std::invalid_argument);
}

}  // namespace
}  // namespace gem
