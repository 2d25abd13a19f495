// Current that changes in time, wind, the turned drag and the Coriolis force against closed form: V60 to V66.
#include <algorithm>
#include <cmath>

#include "gem/field/field.h"
#include "validation/verification/crowd.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Driving : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Driving, ::testing::ValuesIn(all_settings()), setting_name);

constexpr std::size_t driven_id = 1;
/// Of the current that turns by 90 degrees in an hour [rad/s].
constexpr double turning_rate = 0.5 * M_PI / 3600.0;

/// One square floe at the origin in still water, far from the line where floes retire.
SceneDef one_floe(DragLaw law, double dt) {
  SceneDef scene = quiet_scene();
  scene.water.drag_law = law;
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = 0.005;
  scene.water.linear_time_s = 100.0;
  scene.numerics.time_step_s = dt;
  scene.output.retire_x_m = 1e6;
  scene.floe = {square({})};
  return scene;
}

SceneDef in_turning_current(DragLaw law, double dt) {
  SceneDef scene = one_floe(law, dt);
  scene.drive.current_direction = {{0.0, 0.25, 0.0}, {7200.0, 0.25, 7200.0 * turning_rate}};
  return scene;
}

/// The linear law with a current that is held over each time step: off by (Omega dt)^2 / 24, and in its lag Omega tau
/// by (dt / tau)^2 / 12. n time steps add n roundings.
double held(double rate, double dt, std::int64_t steps) {
  constexpr double tau = 100.0;
  return rate * dt * dt * (rate / 24.0 + 1.0 / (12.0 * tau)) + rounding + 4e-16 * static_cast<double>(steps);
}

TEST_P(Driving, V60_turning_current_linear_drag) {
  const double dt = 0.5;
  Simulation run = start(in_turning_current(DragLaw::linear, dt), setting());
  run.advance(7200);
  const Vec2 v = run.bodies().velocity[driven_id], x = run.bodies().position[driven_id];
  // vx is a 23rd of the speed, and x of the order of y
  const double tolerance = held(turning_rate, dt, 7200);
  check_absolute("V60.linear.vx", v.x, 0.25 * tolerance, where());
  check_absolute("V60.linear.vy", v.y, 0.25 * tolerance, where());
  check_absolute("V60.linear.x", x.x, 900.0 * tolerance, where());
  check_absolute("V60.linear.y", x.y, 900.0 * tolerance, where());
  expect_closed_books(run, 1e-11);
}

TEST_P(Driving, V60_turning_current_quadratic_drag) {
  const double dt = 1.0, end = 7200.0;
  SceneDef scene = in_turning_current(DragLaw::quadratic, dt);
  scene.water.skin_coefficient = 0.05 * 900.0 * 0.5 / 1025.0;  // k = 0.05
  Simulation run = start(scene, setting());
  run.advance(static_cast<std::int64_t>(end / dt));
  const Vec2 v = run.bodies().velocity[driven_id];
  const double angle = end * turning_rate;
  const Vec2 water = {0.25 * std::cos(angle), 0.25 * std::sin(angle)};
  // the slip changes by 2 k |w| dt within a time step, an error of second order
  const double slip = value_of("V60.quadratic.slip"), order = 0.05 * slip * dt;
  check("V60.quadratic.slip", length(water - v), order * order, where());
  check("V60.quadratic.speed", length(v), order * order, where());
  check("V60.quadratic.lag", std::atan2(cross(v, water), dot(v, water)), order * order, where());
}

TEST_P(Driving, V61_wind_drift) {
  const double dt = 0.5;
  SceneDef scene = one_floe(DragLaw::quadratic, dt);
  scene.wind.velocity_m_per_s = {6.0, -8.0};
  Simulation run = start(scene, setting());
  run.advance(12000);
  const Vec2 v = run.bodies().velocity[driven_id];
  // wind and water act in turn, half the wind before and half after: an error of second order in k v dt
  const double order = run.bodies().drag[driven_id] * value_of("V61.v") * dt;
  check("V61.v", length(v), order * order, where());
  check("V61.factor", 0.1 * length(v), order * order, where());
  check_value("V61.direction", 0.0, cross(v, {0.6, -0.8}) / length(v), rounding, "-", where());
  EXPECT_NEAR(length(v) / 10.0, 0.02, 0.003) << "Nansen's rule";
  expect_closed_books(run, 1e-11);
}

TEST_P(Driving, V62_inertial_circle) {
  const double f = 1.4e-4, dt = 1.0;
  for (const Vec2 water : {Vec2{0.0, 0.0}, Vec2{0.1, 0.05}}) {
    SceneDef scene = one_floe(DragLaw::none, dt);
    scene.current.velocity_m_per_s = water;
    scene.coriolis.parameter_per_s = f;
    scene.floe[0].velocity_m_per_s = water + Vec2{0.3, 0.0};
    Simulation run = start(scene, setting());
    run.advance(12000);
    const double t = 12000.0 * dt;
    const Vec2 v = run.bodies().velocity[driven_id] - water, x = run.bodies().position[driven_id] - t * water;
    // the turn is exact; each time step goes v dt along its chord: a circle that is larger by (f dt)^2 / 24 and passes
    // through the same start
    const double turn = rounding + 4e-16 * 12000, path = turn + f * f * dt * dt / 12.0;
    check_absolute("V62.vx", v.x, turn, where());
    check_absolute("V62.vy", v.y, turn, where());
    check_absolute("V62.x", x.x, 4000.0 * path, where());
    check_absolute("V62.y", x.y, 4000.0 * path, where());
    check("V62.radius", length(x - Vec2{0.0, -0.3 / f}), path, where());
  }
}

TEST_P(Driving, V63_free_drift) {
  const double dt = 0.5;
  SceneDef scene = one_floe(DragLaw::quadratic, dt);
  scene.wind.velocity_m_per_s = {10.0, 0.0};
  scene.water.turning_rad = 0.4;
  scene.coriolis.parameter_per_s = 1.4e-4;
  Simulation run = start(scene, setting());
  run.advance(14000);
  const Vec2 v = run.bodies().velocity[driven_id];
  const double order = run.bodies().drag[driven_id] * value_of("V63.speed") * dt;
  check("V63.speed", length(v), order * order, where());
  check("V63.right", -std::atan2(v.y, v.x), order * order, where());
}

TEST_P(Driving, V64_tide) {
  const double dt = 0.5, period = 44714.0;
  SceneDef scene = one_floe(DragLaw::linear, dt);
  scene.drive.tide = {{period, 0.3, 0.0, 0.1, 1.5}};
  Simulation run = start(scene, setting());
  run.advance(20000);
  const Vec2 v = run.bodies().velocity[driven_id], x = run.bodies().position[driven_id];
  const double tolerance = held(2.0 * M_PI / period, dt, 20000);
  check_absolute("V64.vx", v.x, 0.3 * tolerance, where());
  check_absolute("V64.vy", v.y, 0.3 * tolerance, where());
  check_absolute("V64.x", x.x, 3000.0 * tolerance, where());
  check_absolute("V64.y", x.y, 3000.0 * tolerance, where());
}

TEST_P(Driving, V65_platform_in_wind) {
  SceneDef scene = quiet_scene();
  scene.platform = {};
  scene.mooring.damping_ratio = 0.3;
  scene.wind.velocity_m_per_s = {-20.0, 0.0};
  scene.wind.platform_area_m2 = 5000.0;
  scene.water.drag_law = DragLaw::quadratic;
  const double dt = scene.numerics.time_step_s = 0.1;
  Simulation run = start(scene, setting());
  run.advance(18000);
  // at rest the wind acts in four parts of a time step, the mooring between them: second order in omega dt
  const double order = std::sqrt(5e5 / 1e8) * dt;
  check("V65.offset", -run.bodies().position[0].x, order * order, where());
  check("V65.force", -run.log.platform.back().drag_impulse.x / dt, order * order, where());
  expect_closed_books(run, 1e-11);
}

/// The bits of a crowd of floes after a second.
std::uint64_t hash_after(const SceneDef& scene, const Setting& setting) {
  Simulation run = start(scene, setting);
  run.advance(20);
  return run.engine->state_hash();
}

TEST_P(Driving, A_run_that_goes_on_takes_its_place_in_the_tables) {
  SceneDef scene = crowd(setting());
  scene.drive.current_direction = {{0.0, 0.5, 0.0}, {3.0, 0.7, 1.5}};
  scene.drive.tide = {{60.0, 0.1, 0.5, 0.2, 0.0}};
  expect_restart_changes_nothing(scene, setting());
}

TEST_P(Driving, V66_a_table_of_one_velocity_changes_no_bit) {
  SceneDef scene = crowd(setting());
  const std::uint64_t steady = hash_after(scene, setting());
  const Vec2 water = scene.current.velocity_m_per_s;
  scene.drive.current_velocity = {{0.0, water.x, water.y}, {10.0, water.x, water.y}};
  check_value("V66.hashes", 0.0, hash_after(scene, setting()) == steady ? 0.0 : 1.0, 0.0, "differ", where());
  scene.drive.current_velocity.back()[1] += 0.5;
  EXPECT_NE(hash_after(scene, setting()), steady);
}

}  // namespace
}  // namespace gem::verification
