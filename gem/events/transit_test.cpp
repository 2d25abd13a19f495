// The path of a ship in transit, and its law.
#include "gem/events/transit_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/base/strict_math.h"

namespace gem {
namespace {

const double pi = std::acos(-1.0);

TransitDef zigzag() {
  return {.speed_m_per_s = 1.5, .way_point_m = {{300.0, 0.0}, {300.0, 400.0}, {700.0, 700.0}}, .turn_radius_m = 80.0};
}

TEST(TransitPath, IsStraightWithoutWayPoints) {
  const TransitPath path({.speed_m_per_s = 2.0, .course_rad = 0.5}, {10.0, -5.0}, 0.2);
  const PathPlace there = path.at(1234.0);
  EXPECT_NEAR(there.place.x, 10.0 + 1234.0 * std::cos(0.5), 1e-10);
  EXPECT_NEAR(there.place.y, -5.0 + 1234.0 * std::sin(0.5), 1e-10);
  const TowStep step = path.step(100, 0.1);
  EXPECT_NEAR(length(step.velocity), 2.0, 1e-11);
  EXPECT_EQ(step.spin, 0.0);
  EXPECT_NEAR(strict::angle_of(step.rotation), 0.2, 1e-14);
}

TEST(TransitPath, ArcsTouchTheLegs) {
  const TransitPath path(zigzag(), {}, 0.0);
  // 300 + 400 + 500 m, less twice the tangent of each corner, with its arc
  const double second = 0.5 * pi - std::atan2(3.0, 4.0);
  const double expected = 1200.0 - 2.0 * 80.0 * (1.0 + std::tan(0.5 * second)) + 80.0 * (0.5 * pi + second);
  EXPECT_NEAR(path.length(), expected, 1e-9);
  const PathPlace end = path.at(path.length());
  EXPECT_NEAR(end.place.x, 700.0, 1e-9);
  EXPECT_NEAR(end.place.y, 700.0, 1e-9);
  // no jump of place or course anywhere, and the yaw comes round by as much as the course
  for (double s = 0.0; s < path.length() + 50.0; s += 0.5) {
    const PathPlace a = path.at(s), b = path.at(s + 0.5);
    EXPECT_NEAR(length(b.place - a.place), 0.5, 0.5 * 0.5 * 0.5 / (24.0 * 80.0 * 80.0) + 1e-9);
    EXPECT_LE(std::abs(strict::angle_of({b.course.cosine * a.course.cosine + b.course.sine * a.course.sine,
                                         b.course.sine * a.course.cosine - b.course.cosine * a.course.sine})),
              0.5 / 80.0 + 1e-12);
  }
  EXPECT_NEAR(strict::angle_of(path.step(100000, 0.1).rotation), std::atan2(3.0, 4.0), 1e-12);
}

TEST(TransitPath, SaysWhichLegIsTooShort) {
  TransitDef def = zigzag();
  for (const double rest : straight_rests(def, {})) EXPECT_GT(rest, 0.0);
  def.turn_radius_m = 350.0;
  EXPECT_NEAR(straight_rests(def, {})[0], -50.0, 1e-9);
  def.way_point_m = {{100.0, 0.0}, {0.0, 0.0}};
  EXPECT_FALSE(straight_rests(def, {})[0] >= 0.0) << "it turns back";
  def.way_point_m = {{0.0, 0.0}};
  EXPECT_FALSE(straight_rests(def, {})[0] >= 0.0) << "it lies at the start";
}

TEST(Tow, MakesUpWhatTheShipLags) {
  const TowStep step{{10.0, 0.0}, strict::rotation_of_angle(0.3), {2.0, 0.0}, 0.01};
  EXPECT_EQ(tow_velocity(step, {10.0, 0.0}, 1.0).x, 2.0);
  EXPECT_EQ(tow_velocity(step, {9.5, 0.25}, 1.0).x, 2.5);
  EXPECT_EQ(tow_velocity(step, {9.5, 0.25}, 1.0).y, -0.25);
  EXPECT_NEAR(tow_spin(step, strict::rotation_of_angle(0.2), 1.0), 0.01 + std::sin(0.1), 1e-15);
  EXPECT_EQ(tow_rate(0.05), 1.0);
  EXPECT_EQ(tow_rate(0.5), 0.4);
}

}  // namespace
}  // namespace gem
