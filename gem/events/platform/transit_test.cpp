// The path of a ship in transit, and its law.
#include "gem/events/platform/transit_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/base/strict_math.h"
#include "gem/events/platform/transit_thrust.h"

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

TEST(TransitPath, StaysAtItsStartForAShipThatRunsFree) {
  const TransitDef def{
      .speed_m_per_s = 2.0, .course_rad = 0.5, .bollard_thrust_N = 1e6, .open_water_speed_m_per_s = 6.0};
  const TransitPath path(def, {10.0, -5.0}, 0.2);
  const TowStep step = path.step(100, 0.1);
  EXPECT_EQ(step.place.x, 10.0);
  EXPECT_EQ(length(step.velocity), 0.0);
  EXPECT_EQ(step.spin, 0.0);
  EXPECT_NEAR(path.start_velocity(0.1).x, 2.0 * std::cos(0.5), 1e-14);
  EXPECT_NEAR(path.start_velocity(0.1).y, 2.0 * std::sin(0.5), 1e-14);
}

TEST(Thrust, TakesTheSpeedThroughTheWaterAlongTheNetThrustCurve) {
  constexpr double bollard = 1e6, open_water = 6.0, ship_mass = 1e7;
  EXPECT_EQ(net_thrust(bollard, open_water, 0.0), bollard);
  EXPECT_EQ(net_thrust(bollard, open_water, -3.0), bollard);
  EXPECT_EQ(net_thrust(bollard, open_water, open_water), 0.0);
  EXPECT_NEAR(net_thrust(bollard, open_water, 3.0), bollard * (1.0 - 1.0 / 6.0 - 1.0 / 6.0), 1e-9);
  EXPECT_LT(net_thrust(bollard, open_water, 7.0), 0.0);
  const TransitDef def{.bollard_thrust_N = bollard, .open_water_speed_m_per_s = open_water};
  for (const double speed : {-1.0, -0.02, 0.0, 2.0, 6.0, 8.0}) {
    // fourth-order Runge-Kutta of half a time step, cut into small ones: errors of 1e-16
    const double dt = 2.0;
    double v = speed;
    const auto rate = [&](double at) { return net_thrust(bollard, open_water, at) / ship_mass; };
    constexpr int parts = 20000;  // the curve has a corner at rest: a part errs by its square there
    const double h = 0.5 * dt / parts;
    for (int k = 0; k < parts; ++k) {
      const double a = rate(v), b = rate(v + 0.5 * h * a), c = rate(v + 0.5 * h * b), d = rate(v + h * c);
      v += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
    EXPECT_NEAR(speed_under_thrust(thrust_law(def, {1.0, 0.0}, ship_mass, dt), speed), v, 1e-11) << speed;
  }
  EXPECT_FALSE(thrust_law({.speed_m_per_s = 2.0}, {1.0, 0.0}, ship_mass, 0.1).present());
}

TEST(Tow, HoldsAShipThatRunsFreeAcrossItsCourseOnly) {
  const TowStep step{{10.0, 0.0}, {}, {}, 0.0};
  const Vec2 course{0.6, 0.8};
  const Vec2 v = tow_across(step, {10.0 + 3.0 * 0.6 - 0.8, 3.0 * 0.8 + 0.6}, 0.5, course, {2.0, 1.0});
  EXPECT_NEAR(dot(v, course), 2.0, 1e-15);
  EXPECT_NEAR(cross(course, v), -0.5, 1e-15) << "it lies 1 m to the left of its path";
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
