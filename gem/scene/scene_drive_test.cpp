// Bounds on current and wind over a whole run.
#include "gem/scene/scene_drive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/scene/scene_bounds.h"

namespace gem {
namespace {

SceneDef turning_scene() {
  SceneDef scene;
  scene.drive.current_direction = {{0.0, 0.5, -0.5 * M_PI}, {3600.0, 0.5, 0.5 * M_PI}};
  return scene;
}

TEST(SceneDrive, ASteadyCurrentIsItsOwnBound) {
  SceneDef scene;
  scene.current.velocity_m_per_s = {-0.3, 0.4};
  EXPECT_EQ(drive_speed(scene), 0.5);
  EXPECT_EQ(closing_speed_bound(scene), 0.5);
  EXPECT_FALSE(has_wind(scene));
  EXPECT_FALSE(drive_schedule(scene).varies());
}

TEST(SceneDrive, ATurningCurrentIsBoundedOverItsWholeTurn) {
  const SceneDef scene = turning_scene();
  EXPECT_EQ(drive_speed(scene), 0.5);
  const VelocityBox box = drive_velocities(scene);
  EXPECT_NEAR(box.high.x, 0.5, 1e-15) << "in the middle, not at a row";
  EXPECT_NEAR(box.low.y, -0.5, 1e-15);
  EXPECT_NEAR(box.high.y, 0.5, 1e-15);
  EXPECT_NEAR(drive_at_start(scene).water.y, -0.5, 1e-15);
}

TEST(SceneDrive, TideAddsItsAmplitudes) {
  SceneDef scene = turning_scene();
  scene.drive.tide = {{4e4, 0.3, 0.0, 0.0, 0.0}, {8e4, 0.0, 0.0, -0.4, 0.0}};
  EXPECT_DOUBLE_EQ(drive_speed(scene), 1.0);
  EXPECT_NEAR(drive_velocities(scene).high.x, 0.8, 1e-15);
}

TEST(SceneDrive, WindDrivesNoFloeFasterThanTheBound) {
  SceneDef scene;
  scene.drive.wind_velocity = {{0.0, 0.0, 0.0}, {60.0, 0.0, 20.0}};
  scene.wind.form_coefficient = 0.8;
  const double bound = drive_speed(scene);
  EXPECT_LT(bound, 0.25 + 0.05 * 20.25);
  const Events e = make_events(scene, nullptr, 0.05, true);
  for (const double thickness : {0.1, 0.5, 3.0})
    for (const double area : {4.0, 400.0, 1e5}) {
      const double mass = scene.ice.density_kg_per_m3 * area * thickness, draft = thickness * (1.0 - e.freeboard);
      const double k =
          scene.water.density_kg_per_m3 / mass *
          (0.5 * scene.water.form_coefficient * std::sqrt(area) * draft + scene.water.skin_coefficient * area);
      FloeInEvents floe{mass, 1.0, area, thickness, k, 0.0, {}, {0.25, 0.0}, 0.0};
      const Drive drive{{0.25, 0.0}, {0.0, 20.0}};
      for (int step = 0; step < 20000; ++step)
        floe.velocity = floe_events(e, drive, floe, floe_drag(e, drive, floe)).velocity;
      EXPECT_GT(length(floe.velocity), 0.3);
      EXPECT_LT(length(floe.velocity), bound);
    }
}

TEST(SceneDrive, WindOnAMooredPlatformRaisesItsSpeedBound) {
  SceneDef scene;
  EXPECT_EQ(platform_speed_bound(scene), 0.0);
  scene.wind.velocity_m_per_s = {20.0, 0.0};
  EXPECT_EQ(platform_speed_bound(scene), 0.0);
  scene.wind.platform_area_m2 = 5000.0;
  EXPECT_NEAR(platform_speed_bound(scene), 1.3e6 / std::sqrt(5e5 * 1e8), 1e-12);
}

/// The bound against the motion of a platform under wind and a constant thrust against it.
TEST(SceneDrive, WindBeyondTheThrustRaisesTheSpeedBound) {
  SceneDef scene;
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.wind.velocity_m_per_s = {20.0, 0.0};
  scene.wind.platform_area_m2 = 5000.0;
  scene.run.duration_s = 600.0;
  scene.dp.thruster.resize(2);
  for (ThrusterDef& one : scene.dp.thruster) one.maximum_N = 1e6;
  const double springs = platform_speed_bound(scene);
  for (ThrusterDef& one : scene.dp.thruster) one.maximum_N = 1e5;
  const double rate = platform_wind_rate(scene.wind, scene.platform.mass_kg);
  double speed = 0.0;
  for (int step = 0; step < 600; ++step) speed += rate * (20.0 - speed) * (20.0 - speed) - 2e5 / scene.platform.mass_kg;
  EXPECT_GT(speed, 2.0 * springs);
  EXPECT_GT(platform_speed_bound(scene), speed);
}

TEST(SceneDrive, PiecesCountAsTheSmallestFloes) {
  SceneDef scene;
  scene.floes.source = FloeSource::listed;
  scene.floe.resize(1);
  scene.floe[0].outline_m = {{0.0, 0.0}, {40.0, 0.0}, {40.0, 40.0}, {0.0, 40.0}};
  EXPECT_NEAR(smallest_floe_width(scene), 40.0, 1e-9);
  scene.breakup.maximum_pieces = 10;
  scene.breakup.minimum_size_m = 5.0;
  EXPECT_EQ(smallest_floe_width(scene), 5.0);
}

}  // namespace
}  // namespace gem
