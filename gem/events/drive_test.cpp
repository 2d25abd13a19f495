// Tables of current, tide and wind at any time, and the laws of wind and Coriolis force over one time step.
#include "gem/events/drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "gem/events/coriolis.h"
#include "gem/events/wind.h"

namespace gem {
namespace {

constexpr Drive steady{{0.25, 0.0}, {3.0, -4.0}};

TEST(Drive, WithoutTablesItIsSteady) {
  const DriveSchedule schedule({}, steady, 0.05);
  EXPECT_FALSE(schedule.varies());
  EXPECT_EQ(schedule.at(1000).water.x, 0.25);
  EXPECT_EQ(schedule.at(0).air.y, -4.0);
}

TEST(Drive, VelocitiesAreLinearBetweenRowsAndConstantOutside) {
  DriveDef def;
  def.current_velocity = {{10.0, 0.5, 0.0}, {20.0, 0.0, 0.5}, {40.0, 1.0, 1.0}};
  const auto at = [&](double time) { return drive_at(def, steady, time).water; };
  EXPECT_EQ(at(-1e9).x, 0.5);
  EXPECT_EQ(at(10.0).x, 0.5);
  EXPECT_DOUBLE_EQ(at(15.0).x, 0.25);
  EXPECT_DOUBLE_EQ(at(15.0).y, 0.25);
  EXPECT_DOUBLE_EQ(at(25.0).x, 0.25);
  EXPECT_EQ(at(1e9).y, 1.0);
  EXPECT_EQ(drive_at(def, steady, 15.0).air.x, 3.0) << "the wind has no table";
}

TEST(Drive, DirectionsKeepTheSpeed) {
  DriveDef def;
  def.wind_direction = {{0.0, 8.0, 0.0}, {3600.0, 8.0, M_PI}};
  for (const double time : {0.0, 700.0, 1800.0, 3599.0, 5000.0}) {
    const Vec2 air = drive_at(def, steady, time).air;
    const double angle = M_PI * std::min(time, 3600.0) / 3600.0;
    EXPECT_NEAR(air.x, 8.0 * std::cos(angle), 1e-14);
    EXPECT_NEAR(air.y, 8.0 * std::sin(angle), 1e-14);
  }
}

TEST(Drive, TheTideIsAddedToTheCurrent) {
  DriveDef def;
  def.tide = {{40000.0, 0.3, 0.0, 0.1, 1.5}, {80000.0, 0.05, -0.5, 0.0, 0.0}};
  for (const double time : {0.0, 1234.5, 1e7}) {
    const Vec2 water = drive_at(def, steady, time).water;
    const double a = 2.0 * M_PI * time / 40000.0, b = 2.0 * M_PI * time / 80000.0;
    EXPECT_NEAR(water.x, 0.25 + 0.3 * std::cos(a) + 0.05 * std::cos(b + 0.5), 1e-12);
    EXPECT_NEAR(water.y, 0.1 * std::cos(a - 1.5), 1e-12);
  }
}

TEST(Drive, ATimeStepTakesItsMiddleFromTheStartOfTheTables) {
  DriveDef def;
  def.current_velocity = {{0.0, 0.0, 0.0}, {100.0, 100.0, 0.0}};
  def.start_time_s = 40.0;
  const DriveSchedule schedule(def, steady, 0.5);
  EXPECT_TRUE(schedule.varies());
  EXPECT_DOUBLE_EQ(schedule.at(0).water.x, 40.25);
  EXPECT_DOUBLE_EQ(schedule.at(21).water.x, 50.75);
}

TEST(Wind, AFloeAtRestFollowsTheClosedForm) {
  const WindDef wind{{6.0, -8.0}, 1.3, 1.5e-3, 0.4};
  const double freeboard = 0.12, thickness = 0.5, area = 81.0, mass = 36000.0;
  const double rate = floe_wind_rate(wind, freeboard, thickness, area, mass);
  EXPECT_NEAR(rate * mass, 1.3 * (0.5 * 0.4 * 9.0 * 0.06 + 1.5e-3 * 81.0), 1e-15);
  for (const double dt : {0.05, 100.0, 1e5}) {
    const Vec2 velocity = blown(rate, {}, wind.velocity_m_per_s, dt);
    const double z = rate * 10.0 * dt;
    EXPECT_NEAR(velocity.x, 6.0 * z / (1.0 + z), 1e-14);
    EXPECT_NEAR(velocity.y, -8.0 * z / (1.0 + z), 1e-14);
  }
}

TEST(Wind, AShortTimeGivesTheStress) {
  const WindDef wind{{20.0, 0.0}, 1.3, 0.0, 0.0, 0.9, 4000.0};
  const double mass = 1e8, dt = 1e-3, rate = platform_wind_rate(wind, mass);
  const double force = 0.5 * 1.3 * 0.9 * 4000.0 * 19.0 * 19.0;
  EXPECT_NEAR(mass * (blown(rate, {1.0, 0.0}, wind.velocity_m_per_s, dt).x - 1.0) / dt, force, 1e-5 * force);
}

TEST(Coriolis, TurnsClockwiseOnTheNorthernHemisphere) {
  for (const double dt : {0.05, 100.0}) {
    const Vec2 turned = rotate(coriolis_turn(1.4e-4, dt), {1.0, 0.0});
    EXPECT_NEAR(turned.x, std::cos(1.4e-4 * dt), 1e-15);
    EXPECT_NEAR(turned.y, -std::sin(1.4e-4 * dt), 1e-15);
  }
}

TEST(TurnedDrag, FollowsItsClosedForm) {
  const std::complex<double> slip(0.3, -0.4), i(0.0, 1.0);
  for (const double angle : {0.4, -0.25, 0.0})
    for (const double dt : {0.05, 1.0, 8.0}) {
      const double k = 0.0745, z = k * std::cos(angle) * 0.5 * dt;
      const std::complex<double> power = 1.0 + i * std::tan(angle);
      const std::complex<double> after = slip * std::pow(1.0 + z, -power);
      const std::complex<double> path = angle == 0.0
                                            ? slip * (std::log1p(z) / z * dt)
                                            : slip * dt / z * (std::pow(1.0 + z, 1.0 - power) - 1.0) / (1.0 - power);
      const DragSolution drag = drag_turned(k, turning_of(angle), {0.3, -0.4}, 0.5, dt);
      // the turn of motion.h
      const double turn = 34.0 / 315.0 * std::pow(0.5 * std::abs(std::tan(angle)) * std::log1p(z), 7.0);
      EXPECT_NEAR(drag.slip.x, after.real(), 1e-14 + turn);
      EXPECT_NEAR(drag.slip.y, after.imag(), 1e-14 + turn);
      EXPECT_NEAR(drag.path_correction.x + dt * drag.slip.x, path.real(), 1e-12 * dt);
      EXPECT_NEAR(drag.path_correction.y + dt * drag.slip.y, path.imag(), 1e-12 * dt);
    }
}

TEST(TurnedDrag, WithoutATurnItIsTheQuadraticLaw) {
  const DragSolution turned = drag_turned(0.07, {}, {0.3, -0.4}, 0.5, 2.0);
  const DragSolution plain = drag_quadratic(0.07, {0.3, -0.4}, 0.5, 2.0);
  EXPECT_NEAR(turned.slip.x, plain.slip.x, 1e-16);
  EXPECT_NEAR(turned.path_correction.y, plain.path_correction.y, 1e-15);
}

}  // namespace
}  // namespace gem
