// A ship in transit that runs free against closed form: in open water, behind a floe, against thick ice: V87, V88, V89.
#include <algorithm>
#include <cmath>

#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Thrust : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Thrust, ::testing::ValuesIn(all_settings()), setting_name);
class ThrustInIce : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, ThrustInIce, ::testing::ValuesIn(coupled_settings()), setting_name);

constexpr double pushed_mass = 45e3;
constexpr double mass = 1.5e7, bollard = 1e6, open_water = 6.0, step = 0.05;
constexpr double time_scale = mass * open_water / bollard;

/// A ship with a flat bow 50 m ahead of its centre, alone, on its way to -x from rest.
SceneDef free_ship() {
  SceneDef scene = quiet_scene();
  scene.platform = {};
  scene.platform.outline = PlatformOutline::ship;
  scene.platform.length_m = 100.0;
  scene.platform.beam_m = 20.0;
  scene.platform.bow_length_m = 0.0;
  scene.platform.stern_length_m = 0.0;
  scene.platform.mass_kg = mass;
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.output.retire_x_m = 1e5;
  scene.transit.bollard_thrust_N = bollard;
  scene.transit.open_water_speed_m_per_s = open_water;
  scene.numerics.time_step_s = step;
  return scene;
}

double y_of(double share) { return (1.0 - share) / (1.0 + 2.0 / 3.0 * share); }

/// Speed after `time` from the speed `start` [m/s].
double speed_after(double time, double start) {
  const double y = y_of(start / open_water) * std::exp(-5.0 / 3.0 * time / time_scale);
  return open_water * y_of(y);  // the function is its own inverse
}

/// Way from rest after `time`: the integral of the speed [m].
double way_after(double time) {
  const double s = time / time_scale, y = std::exp(-5.0 / 3.0 * s);
  return open_water * time_scale * (s - 1.5 * std::log((5.0 / 3.0) / (1.0 + 2.0 / 3.0 * y)));
}

// Each of the 4800 half time steps rounds the speed by a few units of its last digit.
constexpr double speed_rounding = 4800 * 1e-15;
// The place takes the speed in the middle of a time step: dt^2 / 24 of what the acceleration changes.
constexpr double place_error = step * step / 24.0 * bollard / mass;

TEST_P(Thrust, V87_open_water) {
  Simulation run = start(free_ship(), setting());
  run.advance(2400);
  const double time = 2400 * step, speed = speed_after(time, 0.0);
  EXPECT_GT(speed, 0.8 * open_water) << "far along the curve";
  check_value("V87.speed", -speed, run.bodies().velocity[0].x, speed_rounding, "m/s", where());
  check_value("V87.way", -way_after(time), run.bodies().position[0].x, place_error, "m", where());
  EXPECT_NEAR(run.bodies().position[0].y, 0.0, 1e-9);
  Vec2 thrust;
  for (const PlatformStep& one : run.log.platform) thrust += one.mooring_impulse;
  check_value("V87.impulse", -mass * speed, thrust.x, mass * speed_rounding, "N s", where());
  const double work = run.engine->ledger()[Channel::mooring].energy;
  check_value("V87.work", 0.5 * mass * speed * speed, work, mass * speed * speed_rounding, "J", where());
  expect_closed_books(run, 1e-12, mass * speed);
}

TEST_P(Thrust, V87_in_a_current) {
  SceneDef scene = free_ship();
  scene.current.velocity_m_per_s = {0.5, 0.3};
  scene.transit.speed_m_per_s = 1.0;
  Simulation run = start(scene, setting());
  run.advance(2400);
  // it makes 1.5 m/s through the water at the start, and the water takes 0.5 m/s of its way over the ground
  const double speed = speed_after(2400 * step, 1.5) - 0.5;
  check_value("V87.against", -speed, run.bodies().velocity[0].x, speed_rounding, "m/s", where());
  EXPECT_NEAR(run.bodies().velocity[0].y, 0.0, 1e-12) << "it keeps to its course";
}

TEST_P(Thrust, V87_the_water_overtakes_the_ship) {
  SceneDef scene = free_ship();
  scene.current.velocity_m_per_s = {-1.01, 0.0};
  Simulation run = start(scene, setting());
  run.advance(1000);
  // bollard thrust until the ship goes with the water, within a time step; then as from rest
  const double astern = 1.01 * mass / bollard, speed = 1.01 + speed_after(1000 * step - astern, 0.0);
  check_value("V87.astern", -speed, run.bodies().velocity[0].x, speed_rounding, "m/s", where());
}

TEST_P(Thrust, V88_a_floe_ahead_of_the_bow) {
  constexpr double light = 1e6, thrust = 5e4, fastest = 2.0, short_step = 0.01;
  SceneDef scene = free_ship();
  scene.platform.mass_kg = light;
  scene.transit.bollard_thrust_N = thrust;
  scene.transit.open_water_speed_m_per_s = fastest;
  scene.numerics.time_step_s = short_step;
  scene.water.drag_law = DragLaw::quadratic;
  scene.water.form_coefficient = 6.0;
  scene.water.skin_coefficient = 0.0;
  scene.floe = {square({-55.0 - 1.0, 0.0})};
  Simulation run = start(scene, setting());
  run.advance(15000);
  run.log = {};
  run.advance(1000);
  // 45 t on 100 m2: draft m / (rho_w A), and the drag 1/2 rho_w C W T v^2 takes what the thrust leaves
  const double drag = 0.5 * 6.0 * 10.0 * (pushed_mass / 100.0);
  const double c = drag * fastest * fastest / thrust;
  const double share = (std::sqrt(1.0 / 9.0 + 4.0 * (2.0 / 3.0 + c)) - 1.0 / 3.0) / (2.0 * (2.0 / 3.0 + c));
  EXPECT_LT(share, 0.8) << "the floe slows the ship down";
  const double speed = share * fastest, force = drag * speed * speed;
  // within a time step the thrust makes T dt / M of speed, half of it before the contact and half after it
  const double kick = force * short_step / light;
  // the water slows the floe down for a time step before the ship pushes it again: its drag is short by z of itself
  const double z = drag / pushed_mass * speed * short_step;
  const double off = z * force + 2.0 * drag * speed * kick;
  check_value("V88.speed", -speed, run.bodies().velocity[0].x, 0.5 * z * speed + kick, "m/s", where());
  Vec2 ice, pushed;
  for (const PlatformStep& one : run.log.platform) ice += one.ice_impulse, pushed += one.mooring_impulse;
  const double time = 1000 * short_step;
  check_value("V88.ice", force, ice.x / time, off, "N", where());
  check_value("V88.thrust", -force, pushed.x / time, off, "N", where());
  expect_closed_books(run, 1e-12, light * speed);
}

TEST_P(ThrustInIce, V89_thick_ice_stops_the_ship) {
  SceneDef scene = free_ship();
  scene.transit.speed_m_per_s = 2.0;
  scene.numerics.repair_share = SceneDef{}.numerics.repair_share;
  // a floe 5 m ahead, and a wall 5 m behind it
  scene.floe = {square({-60.0, 0.0})};
  scene.fixed = {{{{-90.0, -40.0}, {-70.0, -40.0}, {-70.0, 40.0}, {-90.0, 40.0}}}};
  Simulation run = start(scene, setting());
  run.advance(400);
  const Vec2 stopped = run.bodies().position[0];
  EXPECT_NEAR(stopped.x, -10.0, 0.11) << "within the way of one time step";
  run.log = {};
  double ahead = 0.0, astern = 0.0;
  Vec2 ice;
  for (int second = 0; second < 60; ++second) {
    run.advance(20);
    for (const PlatformStep& one : run.log.platform) {
      ahead = std::max(ahead, -one.velocity.x);
      astern = std::max(astern, one.velocity.x);
      ice += one.ice_impulse;
    }
    run.log = {};
  }
  // the thrust after the contact gives T dt / 2 M, which the next contact takes again
  const double kick = 0.5 * bollard * step / mass;
  check_value("V89.ahead", kick, ahead, 1e-6, "m/s", where());
  check_value("V89.astern", 0.0, astern, 1e-6, "m/s", where());
  check_value("V89.creep", 0.0, length(run.bodies().position[0] - stopped), 1e-3, "m", where());
  // each contact takes what the thrust gives a ship at rest in a time step: a little less than T_b dt
  const double force = mass * speed_after(step, 0.0) / step;
  EXPECT_NEAR(force, bollard, 1e-4 * bollard);
  check_value("V89.ice", force, ice.x / 60.0, 1e-6 * bollard, "N", where());
  EXPECT_NEAR(run.bodies().velocity[1].x, 0.0, 1e-6);
}

}  // namespace
}  // namespace gem::verification
