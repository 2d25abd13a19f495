// A ship in transit against closed form: its path, the force of the tow, a row of hits: V85, V86.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "gem/scene/scene_drive.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Transit : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Transit, ::testing::ValuesIn(all_settings()), setting_name);

constexpr double towed_mass = 4e8, towed_speed = 2.0, towed_step = 0.05;

/// A ship with a flat bow, alone, on its way to -x.
SceneDef under_way() {
  SceneDef scene = quiet_scene();
  scene.platform = {};
  scene.platform.outline = PlatformOutline::ship;
  scene.platform.length_m = 100.0;
  scene.platform.beam_m = 20.0;
  scene.platform.bow_length_m = 0.0;
  scene.platform.stern_length_m = 0.0;
  scene.platform.mass_kg = towed_mass;
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.output.retire_x_m = 1e5;
  scene.transit.speed_m_per_s = towed_speed;
  scene.numerics.time_step_s = towed_step;
  return scene;
}

TEST_P(Transit, V85_the_ship_keeps_to_its_path) {
  SceneDef scene = under_way();
  // a quarter turn to the left of radius 50 m that begins after 50 m
  scene.transit.way_point_m = {{-100.0, 0.0}, {-100.0, -200.0}};
  scene.transit.turn_radius_m = 50.0;
  Simulation run = start(scene, setting());
  const double arc = 50.0 * 0.5 * std::acos(-1.0);
  // a chord cuts the arc by (v dt)^2 / 8 R, and the ends of the time steps lie on it
  const double place = 1e-11;
  run.advance(500);
  check_value("V85.straight.x", -50.0, run.bodies().position[0].x, place, "m", where());
  EXPECT_EQ(run.bodies().rotation[0].sine, 0.0);
  run.advance(500);
  const double turned = 50.0 / 50.0;  // [rad]
  // the ship enters the arc with the velocity of the chord, and its yaw with the yaw rate
  check_value("V85.arc.x", -50.0 - 50.0 * std::sin(turned), run.bodies().position[0].x, place, "m", where());
  check_value("V85.arc.y", -50.0 * (1.0 - std::cos(turned)), run.bodies().position[0].y, place, "m", where());
  check_value("V85.arc.yaw", turned, strict::angle_of(run.bodies().rotation[0]), place, "rad", where());
  run.advance(500);
  check_value("V85.after.x", -100.0, run.bodies().position[0].x, place, "m", where());
  check_value("V85.after.y", -50.0 - (100.0 - arc), run.bodies().position[0].y, place, "m", where());
  check_value("V85.after.yaw", 0.5 * std::acos(-1.0), strict::angle_of(run.bodies().rotation[0]), place, "rad",
              where());
  expect_closed_books(run, 1e-12, towed_mass * towed_speed);
}

TEST_P(Transit, V85_the_tow_takes_the_drag_of_the_water) {
  SceneDef scene = under_way();
  scene.platform_drag.present = true;
  scene.platform_drag.coefficient = 0.5;
  scene.platform_drag.draft_m = 8.0;
  Simulation run = start(scene, setting());
  run.advance(800);
  const double force = 0.5 * scene.water.density_kg_per_m3 * 0.5 * 20.0 * 8.0 * towed_speed * towed_speed;
  const double rate = force / (towed_mass * towed_speed * towed_speed);
  const PlatformStep& last = run.log.platform.back();
  // the water slows the ship down within a time step by b v dt of its speed
  check_value("V85.drag", -force, last.mooring_impulse.x / towed_step, 2.0 * force * rate * towed_speed * towed_step,
              "N", where());
  // it lags by F dt T / 2 M with T = 1 s
  const double lag = 0.5 * force * towed_step / towed_mass;
  check_value("V85.lag", lag, run.bodies().position[0].x + 40.0 * towed_speed, 0.01 * lag, "m", where());
  expect_closed_books(run, 1e-12, towed_mass * towed_speed);
}

constexpr double floe_mass = 45e3, floe_spacing = 15.0;

/// Square floes at rest ahead of the bow, their faces 5 m apart.
SceneDef row_ahead(int floes) {
  SceneDef scene = under_way();
  for (int k = 0; k < floes; ++k) scene.floe.push_back(square({-62.0 - k * floe_spacing, 0.0}));
  return scene;
}

TEST_P(Transit, V86_a_row_of_floes) {
  // pairs that are solved alone hand a hit on along the row by one floe in a time step only
  const int floes = setting().coupled() ? 12 : 1;
  Simulation run = start(row_ahead(floes), setting());
  // the bow meets the first floe after 7 m, and each floe comes to all before it; then 10 s to make up the last lag
  const int steps = static_cast<int>(std::lround((7.0 + 5.0 * floes) / (towed_speed * towed_step))) + 200;
  run.advance(steps);
  const Bodies& b = run.bodies();
  double momentum = 0.0;
  for (std::size_t i = 0; i < b.count(); ++i)
    if (b.kind[i] == BodyKind::floe) momentum += b.mass[i] * b.velocity[i].x;
  Vec2 ice, tow;
  for (const PlatformStep& step : run.log.platform) ice += step.ice_impulse, tow += step.mooring_impulse;
  const double all = floes * floe_mass * towed_speed;
  // a hit slows the ship by m / M of its speed, all floes together by less than N m / M
  const double share = floes * floe_mass / towed_mass;
  check_value("V86.momentum", -all, momentum, all * share, "N s", where());
  check_value("V86.impulse", all, ice.x, all * share, "N s", where());
  const double time = steps * towed_step;
  check_value("V86.force", floes * floe_mass * towed_speed / time, ice.x / time, all * share / time, "N", where());
  const Ledger books = run.engine->ledger();
  // the tow's work is m v^2 for each floe: half of it moves the floe, half is lost in the hit
  check_value("V86.work", all * towed_speed, books[Channel::mooring].energy, all * towed_speed * 2.0 * share, "J",
              where());
  double lost = 0.0;
  for (const Channel c : {Channel::impact, Channel::friction, Channel::elastic}) lost -= books[c].energy;
  check_value("V86.lost", 0.5 * all * towed_speed, lost, all * towed_speed * share, "J", where());
  // the ship is on its path again, but for what the last time steps took
  check_value("V86.place", -towed_speed * time, b.position[0].x, share * towed_speed, "m", where());
  expect_closed_books(run, 1e-12, towed_mass * towed_speed);
}

TEST_P(Transit, V86_locked_yaw_gives_the_same_row) {
  SceneDef scene = row_ahead(3);
  scene.platform.yaw = Yaw::locked;
  Simulation run = start(scene, setting()), free = start(row_ahead(3), setting());
  run.advance(600);
  free.advance(600);
  EXPECT_NEAR(run.bodies().position[0].x, free.bodies().position[0].x, 1e-9);
  EXPECT_EQ(run.bodies().spin[0], 0.0);
}

}  // namespace
}  // namespace gem::verification
