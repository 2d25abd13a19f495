// Axes and sense of rotation of ellipses.
#include "gem/analysis/orbit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

struct Path {
  std::vector<double> x, y;
};

/// Whole cycles of an ellipse about (3, -1) with half axes a and b, the first at `angle`.
Path ellipse(double a, double b, double angle, std::size_t count = 2000) {
  Path path;
  for (std::size_t i = 0; i < count; ++i) {
    const double phase = kTestTurn * static_cast<double>(i) / 100.0;
    const double u = a * std::cos(phase);
    const double v = b * std::sin(phase);
    path.x.push_back(3.0 + u * std::cos(angle) - v * std::sin(angle));
    path.y.push_back(-1.0 + u * std::sin(angle) + v * std::cos(angle));
  }
  return path;
}

TEST(Orbit, OfATurnedEllipse) {
  const Path path = ellipse(2.0, 0.5, 0.6);
  const Orbit result = orbit(path.x, path.y, 1.0);
  EXPECT_NEAR(result.centre_x, 3.0, 1e-12);
  EXPECT_NEAR(result.centre_y, -1.0, 1e-12);
  EXPECT_NEAR(result.major, 2.0 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(result.minor, 0.5 / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(result.angle, 0.6, 1e-12);
}

// The chord of a step is sin(h) / h of its arc with h = pi / 100, an error of 1.6e-4.
TEST(Orbit, TurningSenseOfCirclesAndLines) {
  const Path left = ellipse(1.0, 1.0, 0.0);
  const Path right = ellipse(1.0, -1.0, 0.0);
  const Path line = ellipse(1.0, 0.0, 1.0);
  EXPECT_NEAR(orbit(left.x, left.y, 1.0).turning, 1.0, 1e-3);
  EXPECT_NEAR(orbit(right.x, right.y, 1.0).turning, -1.0, 1e-3);
  EXPECT_NEAR(orbit(line.x, line.y, 1.0).turning, 0.0, 1e-12);
  EXPECT_NEAR(orbit(line.x, line.y, 1.0).minor, 0.0, 1e-7);
}

TEST(OrbitOverTime, SeesTheSenseChange) {
  Path path = ellipse(2.0, 0.5, 0.3);
  const Path back = ellipse(2.0, -0.5, -0.4, 1050);
  path.x.insert(path.x.end(), back.x.begin(), back.x.end());
  path.y.insert(path.y.end(), back.y.begin(), back.y.end());
  const auto orbits = orbit_over_time(path.x, path.y, 0.5, 500.0);
  ASSERT_EQ(orbits.size(), 3u);
  EXPECT_GT(orbits[1].turning, 0.3);
  EXPECT_LT(orbits[2].turning, -0.3);
  EXPECT_NEAR(orbits[1].angle, 0.3, 1e-12);
  EXPECT_NEAR(orbits[2].angle, -0.4, 1e-12);
  EXPECT_DOUBLE_EQ(orbits[2].start, 1000.0);
  EXPECT_DOUBLE_EQ(orbits[2].end, 1500.0);
}

TEST(Orbit, RefusesUnequalAxes) {
  const std::vector<double> two(2, 0.0);
  const std::vector<double> three(3, 0.0);
  EXPECT_THROW(orbit(two, three, 1.0), std::invalid_argument);
  EXPECT_THROW(orbit_over_time(three, three, 1.0, 1.0), std::invalid_argument);
}

}  // namespace
}  // namespace gem
