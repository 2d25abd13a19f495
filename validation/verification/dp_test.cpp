// Dynamic positioning against closed form: step response, steady offset, allocation, limits: V80 to V84.
#include <algorithm>
#include <cmath>

#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Dp : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Dp, ::testing::ValuesIn(all_settings()), setting_name);

constexpr double ship_mass = 5e7, ship_inertia = 1e11, held_period = 60.0, held_damping = 0.4, ship_heading = 0.6;
const double held_omega = 2.0 * std::acos(-1.0) / held_period;

/// A ship with four azimuth thrusters at the corners of a rectangle, and nothing else that moves it.
SceneDef on_thrusters(double dt, double maximum = 1e9) {
  SceneDef scene = quiet_scene();
  scene.platform = {};
  scene.platform.mass_kg = ship_mass;
  scene.platform.inertia_kg_m2 = ship_inertia;
  scene.platform.start_yaw_rad = ship_heading;
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.dp.yaw_rad = ship_heading;
  scene.dp.surge_period_s = scene.dp.sway_period_s = scene.dp.yaw_period_s = held_period;
  scene.dp.damping_ratio = held_damping;
  for (const Vec2 place : {Vec2{40.0, 15.0}, Vec2{40.0, -15.0}, Vec2{-40.0, 15.0}, Vec2{-40.0, -15.0}})
    scene.dp.thruster.push_back({.position_m = place, .maximum_N = maximum});
  scene.numerics.time_step_s = dt;
  return scene;
}

/// Displacement of a damped oscillator let go from rest at 1.
double oscillator(double t) {
  const double rate = held_damping * held_omega, damped = held_omega * std::sqrt(1.0 - held_damping * held_damping);
  return std::exp(-rate * t) * (std::cos(damped * t) + rate / damped * std::sin(damped * t));
}

/// The same with the force held through each of `steps` time steps, exactly.
double held_oscillator(double dt, int steps) {
  double x = 1.0, v = 0.0;
  for (int k = 0; k < steps; ++k) {
    const double a = -held_omega * held_omega * x - 2.0 * held_damping * held_omega * v;
    x += dt * v + 0.5 * dt * dt * a;
    v += dt * a;
  }
  return x;
}

/// A start off the set point: 3 m and 2 m along the ship's axes, and `yaw`.
SceneDef off_set_point(double dt, double yaw = 0.0) {
  SceneDef scene = on_thrusters(dt);
  const Rotation q = strict::rotation_of_angle(ship_heading);
  scene.platform.start_offset_m = rotate(q, {3.0, 2.0});
  scene.platform.start_yaw_rad = ship_heading + yaw;
  return scene;
}

struct Offset {
  double along, across, yaw;
};
Offset offset_of(Simulation& run) {
  const Bodies& b = run.bodies();
  const Rotation set = strict::rotation_of_angle(ship_heading);
  const Vec2 e = to_ship(set, b.position[0]);
  return {e.x, e.y, strict::angle_of(b.rotation[0]) - ship_heading};
}

TEST_P(Dp, V80_step_response) {
  const double dt = 0.25;
  const int steps = 160;
  Simulation run = start(off_set_point(dt), setting());
  run.advance(steps);
  const Offset left = offset_of(run);
  const double held = held_oscillator(dt, steps);
  check_value("V80.held.surge", 3.0 * held, left.along, 1e-11, "m", where());
  check_value("V80.held.sway", 2.0 * held, left.across, 1e-11, "m", where());
  // a thrust that is held lags by dt / 2: of first order, about omega dt / 2
  const double exact = oscillator(dt * steps);
  check_value("V80.surge", 3.0 * exact, left.along, 3.0 * held_omega * dt, "m", where());
  expect_closed_books(run, 1e-11);
}

TEST_P(Dp, V80_step_of_the_yaw) {
  const double dt = 0.25;
  const int steps = 160;
  SceneDef scene = off_set_point(dt, 0.1);
  Simulation run = start(scene, setting());
  run.advance(steps);
  const Offset left = offset_of(run);
  check_value("V80.held.yaw", 0.1 * held_oscillator(dt, steps), left.yaw, 1e-11, "rad", where());
  // all have one period, so the offset goes straight to the set point while the ship turns; the two halves of a thrust
  // that turns with the ship differ by the yaw rate times dt, at most 0.1 omega dt of it
  check_value("V80.turning.surge", 3.0 * held_oscillator(dt, steps), left.along, 3.0 * 0.1 * held_omega * dt, "m",
              where());
  expect_closed_books(run, 1e-11);
}

TEST_P(Dp, V80_first_order) {
  const auto error = [&](double dt) {
    Simulation run = start(off_set_point(dt), setting());
    run.advance(std::llround(40.0 / dt));
    return std::fabs(offset_of(run).along - 3.0 * oscillator(40.0));
  };
  check_value("V80.order", 2.0, error(0.05) / error(0.025), 0.05, "1", where());
}

/// Force of the wind on the ship at rest [N].
constexpr double wind_area = 2000.0, wind_speed = 20.0, wind_force = 0.5 * 1.3 * wind_area * wind_speed * wind_speed;

/// The thrust acts in two halves with the wind between them: the ship meets it with up to F dt / 2 M, of which the
/// force feels twice over the wind's speed.
const double jerk = wind_force * 0.5 / (ship_mass * wind_speed);

SceneDef in_wind(double integral_time) {
  SceneDef scene = on_thrusters(0.5);
  scene.wind.velocity_m_per_s = {wind_speed, 0.0};
  scene.wind.platform_area_m2 = wind_area;
  scene.dp.damping_ratio = 0.9;
  scene.dp.integral_time_s = integral_time;
  return scene;
}

TEST_P(Dp, V81_steady_offset_without_integral) {
  Simulation run = start(in_wind(0.0), setting());
  run.advance(1200);
  const double expected = wind_force / (ship_mass * held_omega * held_omega);
  check_value("V81.offset", expected, run.bodies().position[0].x, jerk * expected, "m", where());
  check_value("V81.athwart", 0.0, run.bodies().position[0].y, 1e-11 * expected, "m", where());
}

TEST_P(Dp, V81_no_offset_with_integral) {
  Simulation run = start(in_wind(60.0), setting());
  run.advance(6000);
  check_value("V81.integral.x", 0.0, run.bodies().position[0].x, 1e-9, "m", where());
  check_value("V81.integral.y", 0.0, run.bodies().position[0].y, 1e-9, "m", where());
  const DpState& dp = run.log.dp.back();
  const Rotation q = run.bodies().rotation[0];
  const Vec2 thrust = rotate(q, {dp.given.surge, dp.given.sway});
  check_value("V81.thrust", -wind_force, thrust.x, jerk * wind_force, "N", where());
  expect_closed_books(run, 1e-11);
}

/// Thrust for a demand of surge, sway and yaw by four equal thrusters at (+-40, +-15): a quarter of the force each, and
/// of the moment N what is athwart the arm r: N (-y, x) / (4 r^2).
Vec2 quarter(const ShipForce& demand, Vec2 place) {
  const double share = demand.yaw / (4.0 * dot(place, place));
  return {0.25 * demand.surge - share * place.y, 0.25 * demand.sway + share * place.x};
}

TEST_P(Dp, V82_allocation) {
  const SceneDef scene = off_set_point(0.25);
  Simulation run = start(scene, setting());
  run.advance(60);
  const double scale = 3.0 * ship_mass * held_omega * held_omega, arm = 40.0;
  double apart = 0.0, missing = 0.0;
  for (const DpState& dp : run.log.dp) {
    for (std::size_t k = 0; k < 4; ++k)
      apart = std::max(apart, length(dp.thrust[k] - quarter(dp.demand, scene.dp.thruster[k].position_m)));
    missing = std::max({missing, std::fabs(dp.demand.surge - dp.given.surge), std::fabs(dp.demand.sway - dp.given.sway),
                        std::fabs(dp.demand.yaw - dp.given.yaw) / arm});
  }
  ASSERT_EQ(run.log.dp.size(), 60U);
  check_value("V82.thrust", 0.0, apart / scale, rounding, "1", where());
  check_value("V82.missing", 0.0, missing / scale, rounding, "1", where());
}

TEST_P(Dp, V83_saturated) {
  const double dt = 0.5, maximum = 4e5;
  SceneDef scene = on_thrusters(dt, maximum);
  scene.platform.start_offset_m = {500.0, 0.0};
  scene.dp.integral_time_s = 100.0;
  Simulation run = start(scene, setting());
  const int steps = 60;
  run.advance(steps);
  // all thrusters push to -x with all they have, and the integral does not grow
  const double acceleration = 4.0 * maximum / ship_mass, time = steps * dt;
  check_value("V83.v", -acceleration * time, run.bodies().velocity[0].x, 1e-12 * acceleration * time, "m/s", where());
  check_value("V83.x", 500.0 - 0.5 * acceleration * time * time, run.bodies().position[0].x, 1e-10, "m", where());
  const DpState& dp = run.log.dp.back();
  EXPECT_EQ(dp.at_limit, 15U);
  check_value("V83.integral", 0.0, length(dp.integral), 1e-9, "m s", where());
  expect_closed_books(run, 1e-11);
}

TEST_P(Dp, V84_rate_limit) {
  const double dt = 0.5, rate = 2e4;
  SceneDef scene = on_thrusters(dt);
  scene.platform.start_offset_m = {500.0, 0.0};
  for (ThrusterDef& thruster : scene.dp.thruster) thruster.rate_N_per_s = rate;
  Simulation run = start(scene, setting());
  const int steps = 40;
  run.advance(steps);
  // thrust k rate dt in time step k
  const double speed = 4.0 * rate * dt * dt * 0.5 * steps * (steps + 1) / ship_mass;
  check_value("V84.v", -speed, run.bodies().velocity[0].x, 1e-12 * speed, "m/s", where());
  check_value("V84.thrust", rate * dt * steps, length(run.log.dp.back().thrust[2]), 1e-6, "N", where());
  EXPECT_EQ(run.log.dp.back().at_limit, 15U);
}

TEST_P(Dp, A_run_that_goes_on_has_the_same_bits) {
  SceneDef scene = in_wind(60.0);
  scene.dp.filter_time_s = 4.0;
  for (ThrusterDef& thruster : scene.dp.thruster) thruster.rate_N_per_s = 3e4;
  Simulation whole = start(scene, setting()), part = start(scene, setting()), rest = start(scene, setting());
  whole.advance(60);
  part.advance(25);
  rest.engine->restore(part.engine->save());
  rest.advance(35);
  EXPECT_EQ(rest.engine->state_hash(), whole.engine->state_hash());
  EXPECT_NE(hash_of(60, whole.bodies(), 0), whole.engine->state_hash()) << "the control is a part of the state";
}

}  // namespace
}  // namespace gem::verification
