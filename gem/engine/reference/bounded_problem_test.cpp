// Problems with solutions worked out by hand, and one without a solution.
#include "gem/engine/reference/bounded_problem.h"

#include <gtest/gtest.h>

#include <limits>

#include "gem/base/error.h"

namespace gem::reference {
namespace {

constexpr double none = std::numeric_limits<double>::infinity();

/// A problem of normal impulses without caps.
BoundedProblem problem_of(const Eigen::MatrixXd& response, const Eigen::VectorXd& start) {
  BoundedProblem p;
  p.response = response.sparseView();
  p.start = start;
  p.limit = Eigen::VectorXd::Constant(start.size(), none);
  p.normal.assign(static_cast<std::size_t>(start.size()), BoundedProblem::none);
  p.spare.resize(p.normal.size());
  return p;
}

/// One point with a normal and a tangential unknown.
BoundedProblem rough_point(const Eigen::Matrix2d& response, const Eigen::Vector2d& start, double mu) {
  BoundedProblem p = problem_of(response, start);
  p.limit[1] = mu;
  p.normal[1] = 0;
  return p;
}

TEST(BoundedProblem, PressesOrLetsGo) {
  const Eigen::Matrix2d k{{2.0, 0.0}, {0.0, 4.0}};
  const BoundedSolution s = solve(problem_of(k, Eigen::Vector2d{-1.0, 1.0}));
  EXPECT_DOUBLE_EQ(s.x[0], 0.5);
  EXPECT_EQ(s.x[1], 0.0);
}

TEST(BoundedProblem, OnePointPressesForTheOther) {
  // x0 = 1 alone changes w of the second by +2, so the second needs no impulse although it closed at first
  const Eigen::Matrix2d k{{1.0, 2.0}, {2.0, 5.0}};
  const BoundedSolution s = solve(problem_of(k, Eigen::Vector2d{-1.0, -1.5}));
  EXPECT_DOUBLE_EQ(s.x[0], 1.0);
  EXPECT_EQ(s.x[1], 0.0);
}

TEST(BoundedProblem, StopsAtTheCap) {
  BoundedProblem p = problem_of(Eigen::MatrixXd::Constant(1, 1, 2.0), Eigen::VectorXd::Constant(1, -1.0));
  p.limit[0] = 0.3;
  EXPECT_EQ(solve(p).x[0], 0.3);
}

TEST(BoundedProblem, SticksWithinTheConeAndSlipsOnIt) {
  const Eigen::Matrix2d k{{2.0, 0.5}, {0.5, 1.0}};
  const Eigen::Vector2d start{-1.0, 0.1};
  // both w are zero: 2 n + t/2 = 1, n/2 + t = -0.1
  const BoundedSolution stick = solve(rough_point(k, start, 0.7));
  EXPECT_NEAR(stick.x[0], 0.6, 1e-14);
  EXPECT_NEAR(stick.x[1], -0.4, 1e-14);
  // t = -n/2: 1.75 n = 1
  const BoundedSolution slip = solve(rough_point(k, start, 0.5));
  EXPECT_NEAR(slip.x[0], 1.0 / 1.75, 1e-14);
  EXPECT_NEAR(slip.x[1], -0.5 / 1.75, 1e-14);
}

TEST(BoundedProblem, SpareFrictionWidensTheConeOnItsSide) {
  const Eigen::Matrix2d k{{2.0, 0.5}, {0.5, 1.0}};
  BoundedProblem p = rough_point(k, Eigen::Vector2d{-1.0, 0.1}, 0.5);
  p.spare[1] = {7.0, 0.02};  // only the side to which the point pulls counts
  // t = -n/2 - 0.02: 1.75 n = 1.01
  const BoundedSolution slip = solve(p);
  EXPECT_NEAR(slip.x[0], 1.01 / 1.75, 1e-14);
  EXPECT_NEAR(slip.x[1], -0.5 * 1.01 / 1.75 - 0.02, 1e-14);
  p.spare[1].right = 1.0;
  EXPECT_NEAR(solve(p).x[1], -0.4, 1e-14);  // sticks, as with a wide cone
}

TEST(BoundedProblem, TwoPointsInOnePlaceShareTheirImpulse) {
  const BoundedSolution s = solve(problem_of(Eigen::Matrix2d::Constant(2.0), Eigen::Vector2d{-1.0, -1.0}));
  EXPECT_NEAR(s.x[0] + s.x[1], 0.5, 1e-13);
  EXPECT_GE(s.x.minCoeff(), 0.0);
  EXPECT_LE(s.residual, 1e-13);
}

TEST(BoundedProblem, ALongChainIsSolvedToRounding) {
  // equal bodies in a row, the first driven against the others, the last against a wall: all impulses are equal
  constexpr int count = 300;
  Eigen::MatrixXd k = 2.0 * Eigen::MatrixXd::Identity(count, count);
  for (int i = 0; i + 1 < count; ++i) k(i, i + 1) = k(i + 1, i) = -1.0;
  k(count - 1, count - 1) = 1.0;
  Eigen::VectorXd start = Eigen::VectorXd::Zero(count);
  start[0] = -1.0;
  const BoundedSolution s = solve(problem_of(k, start));
  // the inverse of this matrix has min(i, j) + 1
  for (int i = 0; i < count; ++i) EXPECT_NEAR(s.x[i], 1.0, 1e-9) << i;
  EXPECT_LE(s.residual, 4.0 * bounded_tolerance);
}

TEST(BoundedProblem, WithoutAnAnswerItSaysSo) {
  // two points that cannot both separate: separating one closes the other
  const Eigen::Matrix2d k{{1.0, -1.0}, {-1.0, 1.0}};
  try {
    solve(problem_of(k, Eigen::Vector2d{-1.0, -1.0}));
    ADD_FAILURE() << "it found one";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::numerical_stop);
    EXPECT_NE(std::string(error.what()).find("2 unknowns"), std::string::npos) << error.what();
  }
}

TEST(BoundedProblem, WhatCannotBeMetIsSharedOut) {
  const Eigen::Matrix2d k{{1.0, -1.0}, {-1.0, 1.0}};
  const BoundedSolution s = solve_regularised(problem_of(k, Eigen::Vector2d{-1.0, -1.0}));
  const Eigen::Vector2d left = k * s.x - Eigen::Vector2d{1.0, 1.0};
  EXPECT_NEAR(left[0], -1.0, 1e-6);  // neither is served at the other's cost
  EXPECT_NEAR(left[1], -1.0, 1e-6);
}

TEST(BoundedProblem, WhatCanBeMetIsMet) {
  const Eigen::Matrix2d k{{2.0, -1.0}, {-1.0, 1.0}};
  const BoundedSolution s = solve_regularised(problem_of(k, Eigen::Vector2d{-1.0, -1.0}));
  EXPECT_NEAR(s.x[0], 2.0, 1e-12);
  EXPECT_NEAR(s.x[1], 3.0, 1e-12);
}

}  // namespace
}  // namespace gem::reference
