// Added mass of a ship against closed form: V102, V103, V104.
#include <cmath>

#include "validation/verification/scenes.h"

namespace gem::verification::added_mass_cases {
namespace {

class AddedMassCase : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, AddedMassCase, ::testing::ValuesIn(all_settings()), setting_name);

constexpr double mass = 2e7, inertia = 4e10, yaw = 0.7, rounded = 1e-12;
constexpr AddedMassDef water{1e6, 1.6e7, 2e10, 0.0};
constexpr double surge_mass = mass + water.surge_kg, sway_mass = mass + water.sway_kg,
                 yaw_mass = inertia + water.yaw_kg_m2;

/// A box 200 m x 40 m in still water without drag.
SceneDef ship_in_water(double dt) {
  SceneDef scene = quiet_scene();
  scene.platform.present = true;
  scene.platform.outline = PlatformOutline::listed;
  scene.platform.outline_m = rectangle(200.0, 40.0);
  scene.platform.mass_kg = mass;
  scene.platform.inertia_kg_m2 = inertia;
  scene.platform.start_yaw_rad = yaw;
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.output.retire_x_m = 1e5;
  scene.added_mass = water;
  scene.numerics.time_step_s = dt;
  return scene;
}

/// A vector of the ship's axes in the world's.
Vec2 in_world(Vec2 v, double angle = yaw) { return rotate({std::cos(angle), std::sin(angle)}, v); }
Vec2 in_ship(Vec2 v) { return rotate({std::cos(yaw), -std::sin(yaw)}, v); }
double angle_of(const Bodies& b) { return std::atan2(b.rotation[0].sine, b.rotation[0].cosine) - yaw; }

/// A swing on a linear mooring along one axis of the ship, for about seven periods.
void check_swing(const std::string& name, Vec2 axis, double moved_mass, const Setting& setting, const Where& where) {
  constexpr double stiffness = 1e5, start_offset = 3.0, dt = 0.2, duration = 600.0;
  SceneDef scene = ship_in_water(dt);
  scene.mooring.stiffness_N_per_m = stiffness;
  scene.platform.start_offset_m = in_world(start_offset * axis);
  Simulation run = start(scene, setting);
  run.advance(std::lround(duration / dt));
  const double omega = std::sqrt(stiffness / moved_mass), half = 0.5 * omega * dt;
  const Vec2 offset = in_ship(run.bodies().position[0] - scene.platform.anchor_m);
  // The kicks of half time steps swing faster by (omega dt / 2)^2 / 24.
  const double error = start_offset * half * half / 24.0 * omega * duration + rounded;
  EXPECT_LT(error, 1e-3 * start_offset);
  check_value(name, start_offset * std::cos(omega * duration), dot(offset, axis), error, "m", where);
  check_value(name + ".across", 0.0, cross(axis, offset), 1e-9, "m", where);
  check_value(name + ".yaw", 0.0, angle_of(run.bodies()), 1e-9, "rad", where);
  Vec2 pull;
  for (const PlatformStep& one : run.log.platform) pull += one.mooring_impulse;
  const double momentum = -moved_mass * start_offset * omega * std::sin(omega * duration);
  check_value(name + ".pull", momentum, dot(in_ship(pull), axis), moved_mass * omega * error + 1e-3, "N s", where);
  expect_closed_books(run, 1e-12, mass * omega * start_offset);
}

TEST_P(AddedMassCase, V102_a_moored_ship_swings_with_the_mass_of_its_axis) {
  check_swing("V102.surge", {1.0, 0.0}, surge_mass, setting(), where());
  check_swing("V102.sway", {0.0, 1.0}, sway_mass, setting(), where());
}

TEST_P(AddedMassCase, V102_a_turn_has_the_inertia_of_the_water) {
  constexpr double stiffness = 1e8, turn = 0.05, dt = 0.2, duration = 600.0;
  SceneDef scene = ship_in_water(dt);
  scene.platform.start_yaw_rad = turn;
  scene.mooring.yaw_stiffness_N_m_per_rad = stiffness;
  Simulation run = start(scene, setting());
  run.advance(std::lround(duration / dt));
  const double omega = std::sqrt(stiffness / yaw_mass);
  // The yaw turns once in a time step, between its kicks.
  const double error = turn * (omega * dt) * (omega * dt) / 24.0 * omega * duration + 1e-9;
  check_value("V102.turn", turn * std::cos(omega * duration), angle_of(run.bodies()) + yaw, error, "rad", where());
  expect_closed_books(run, 1e-12);
}

TEST_P(AddedMassCase, V103_a_ship_that_drifts_broadside_swings_about_it) {
  constexpr double drift = 0.5, dt = 0.5, amplitude = 1e-3;
  const double momentum = sway_mass * drift;
  const double omega = momentum * std::sqrt((1.0 / surge_mass - 1.0 / sway_mass) / yaw_mass);
  SceneDef scene = ship_in_water(dt);
  scene.platform.start_velocity_m_per_s = in_world({0.0, drift});
  scene.platform.start_spin_rad_per_s = amplitude * omega;
  Simulation run = start(scene, setting());
  // a pendulum: its period depends on the square of the amplitude
  const double shared = (omega * dt) * (omega * dt) / 24.0 + amplitude * amplitude;
  for (int part = 1; part <= 6; ++part) {
    run.advance(300);
    const double phase = omega * 300.0 * dt * part;
    check_value("V103.yaw", amplitude * std::sin(phase), angle_of(run.bodies()), amplitude * shared * (1.0 + phase),
                "rad", where());
  }
  const Bodies& b = run.bodies();
  const double turned = angle_of(b) + yaw;
  const Vec2 v = rotate({std::cos(turned), -std::sin(turned)}, b.velocity[0]);
  const Vec2 kept = in_ship(in_world({surge_mass * v.x, sway_mass * v.y}, turned));
  check_value("V103.momentum", momentum, kept.y, rounded * momentum, "N s", where());
  check_value("V103.momentum.across", 0.0, kept.x, rounded * momentum, "N s", where());
  expect_closed_books(run, 1e-12, mass * drift);
}

TEST_P(AddedMassCase, V103_a_ship_that_drifts_bow_first_turns_broadside) {
  SceneDef scene = ship_in_water(0.5);
  scene.platform.start_velocity_m_per_s = in_world({0.5, 0.0});
  scene.platform.start_spin_rad_per_s = 1e-5;
  Simulation run = start(scene, setting());
  double farthest = 0.0;
  for (int i = 0; i < 40; ++i) {
    run.advance(200);
    farthest = std::max(farthest, std::fabs(angle_of(run.bodies())));
  }
  EXPECT_GT(farthest, 1.57);
  expect_closed_books(run, 1e-11, mass * 0.5);
}

TEST_P(AddedMassCase, V104_a_floe_meets_the_ship_and_then_its_water) {
  constexpr double floe = 45000.0, speed = 0.5, together = floe * mass / (floe + mass);
  SceneDef scene = ship_in_water(0.1);
  scene.platform.start_yaw_rad = 0.0;
  scene.floe = {square(scene.platform.anchor_m + Vec2{-105.0 + touch, 0.0}, {speed, 0.0})};
  Simulation run = start(scene, setting());
  run.advance(1);
  const double ship = together * speed / surge_mass;
  check_value("V104.ship", ship, run.bodies().velocity[0].x, 1e-9 * ship, "m/s", where());
  check_value("V104.floe", floe * speed / (floe + mass), run.bodies().velocity[1].x, 1e-9 * ship, "m/s", where());
  check_value("V104.ice", together * speed, run.log.platform[0].ice_impulse.x, 1e-9 * together * speed, "N s", where());
  run.advance(2);
  // Each further time step leaves m a / (M + m) (M + a) of the difference of the speeds.
  const double left = floe / (floe + mass) * water.surge_kg / surge_mass;
  const double common = floe * speed / (floe + surge_mass);
  check_value("V104.common", common, run.bodies().velocity[0].x, left * ship, "m/s", where());
  check_value("V104.common.floe", common, run.bodies().velocity[1].x, left * ship, "m/s", where());
  expect_closed_books(run, 1e-12, floe * speed);
}

}  // namespace
}  // namespace gem::verification::added_mass_cases
