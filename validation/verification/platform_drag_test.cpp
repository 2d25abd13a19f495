// Water drag on a ship by axis against closed form: V95, V96.
#include <cmath>

#include "validation/verification/scenes.h"

namespace gem::verification::ship_drag {
namespace {

class ShipDrag : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, ShipDrag, ::testing::ValuesIn(all_settings()), setting_name);

constexpr double mass = 7e7, inertia = 2e11, water_density = 1025.0, draft = 10.0, hull = 200.0, beam = 40.0;
constexpr double surge_rate = 0.5 * water_density * 0.2 * beam * draft / mass,
                 sway_rate = 0.5 * water_density * 0.7 * hull * draft / mass,
                 yaw_rate = water_density * 0.6 * draft * hull * hull * hull * hull / 64.0 / inertia;
constexpr Vec2 current{0.3, -0.2};

/// A ship 200 m x 40 m, free in a current. `slip`, in its axes, is its velocity through the water.
SceneDef ship_with_drag(Vec2 slip, double spin, double dt) {
  SceneDef scene = quiet_scene();
  scene.platform.present = true;
  scene.platform.outline = PlatformOutline::ship;
  scene.platform.length_m = hull;
  scene.platform.beam_m = beam;
  scene.platform.mass_kg = mass;
  scene.platform.inertia_kg_m2 = inertia;
  scene.platform.start_yaw_rad = 0.7;
  scene.platform.start_velocity_m_per_s = current + rotate({std::cos(0.7), std::sin(0.7)}, slip);
  scene.platform.start_spin_rad_per_s = spin;
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.output.retire_x_m = 1e5;
  scene.water.density_kg_per_m3 = water_density;
  scene.current.velocity_m_per_s = current;
  scene.platform_drag = {.present = true,
                         .draft_m = draft,
                         .water = DampingWater::current,
                         .law = PlatformDragLaw::by_axis,
                         .surge_coefficient = 0.2,
                         .sway_coefficient = 0.7,
                         .yaw_coefficient = 0.6};
  scene.numerics.time_step_s = dt;
  return scene;
}

/// The ship's velocity through the water, in its axes.
Vec2 slip_of(const Bodies& b) { return rotate({b.rotation[0].cosine, -b.rotation[0].sine}, b.velocity[0] - current); }

double angle_of(const Bodies& b) { return std::atan2(b.rotation[0].sine, b.rotation[0].cosine) - 0.7; }

double slowed_after(double rate, double start, double time) { return start / (1.0 + rate * start * time); }

/// Way, or turn, after `time`: the integral of the speed.
double way_after(double rate, double start, double time) { return std::log(1.0 + rate * start * time) / rate; }

constexpr double drag_step = 0.5, duration = 200.0;
constexpr int steps = 400;
// Each of the 800 half time steps turns the velocity into the axes and back: ten roundings of 1.1e-16.
constexpr double rounded = 2 * steps * 1.1e-15;

/// The middle of a time step stands for it: dt^2 / 24 of what the deceleration changes, b v^2 at most. Places at
/// 500 m are rounded to 1e-13 m a time step.
double way_error(double rate, double start) {
  return drag_step * drag_step / 24.0 * rate * start * start + steps * 1e-13;
}

TEST_P(ShipDrag, V95_surge_alone) {
  const Vec2 slip{-2.0, 0.0};
  Simulation run = start(ship_with_drag(slip, 0.0, drag_step), setting());
  const Vec2 before = run.bodies().position[0];
  run.advance(steps);
  const Vec2 left = slip_of(run.bodies());
  check_value("V95.surge", -slowed_after(surge_rate, 2.0, duration), left.x, 2.0 * rounded, "m/s", where());
  check_value("V95.surge.sway", 0.0, left.y, 2.0 * rounded, "m/s", where());
  const Vec2 way = run.bodies().position[0] - before - duration * current;
  check_value("V95.surge.way", way_after(surge_rate, 2.0, duration), length(way), way_error(surge_rate, 2.0), "m",
              where());
  EXPECT_EQ(run.bodies().spin[0], 0.0);
  expect_closed_books(run, 1e-12, mass * 2.4);
}

TEST_P(ShipDrag, V95_sway_alone) {
  Simulation run = start(ship_with_drag({0.0, 1.5}, 0.0, drag_step), setting());
  const Vec2 before = run.bodies().position[0];
  run.advance(steps);
  const Vec2 left = slip_of(run.bodies());
  EXPECT_LT(left.y, 0.5) << "most of it is lost";
  check_value("V95.sway", slowed_after(sway_rate, 1.5, duration), left.y, 1.5 * rounded, "m/s", where());
  check_value("V95.sway.surge", 0.0, left.x, 1.5 * rounded, "m/s", where());
  const Vec2 way = run.bodies().position[0] - before - duration * current;
  check_value("V95.sway.way", way_after(sway_rate, 1.5, duration), length(way), way_error(sway_rate, 1.5), "m",
              where());
  Vec2 impulse;
  for (const PlatformStep& one : run.log.platform) impulse += one.drag_impulse;
  const double lost = mass * (1.5 - slowed_after(sway_rate, 1.5, duration));
  check_value("V95.sway.impulse", lost, length(impulse), mass * 1.5 * rounded, "N s", where());
  expect_closed_books(run, 1e-12, mass * 1.9);
}

TEST_P(ShipDrag, V95_yaw_alone) {
  constexpr double spin = 0.01;
  Simulation run = start(ship_with_drag({}, -spin, drag_step), setting());
  run.advance(steps);
  const double left = slowed_after(yaw_rate, spin, duration);
  EXPECT_LT(left, 0.5 * spin);
  check_value("V95.yaw", -left, run.bodies().spin[0], spin * rounded, "rad/s", where());
  check_value("V95.yaw.turn", -way_after(yaw_rate, spin, duration), angle_of(run.bodies()),
              drag_step * drag_step / 24.0 * yaw_rate * spin * spin + steps * 2.2e-16, "rad", where());
  const double work = run.engine->ledger()[Channel::platform_drag].energy;
  check_value("V95.yaw.work", -0.5 * inertia * (spin * spin - left * left), work, inertia * spin * spin * rounded, "J",
              where());
  expect_closed_books(run, 1e-12);
}

TEST_P(ShipDrag, V95_a_locked_yaw_is_not_dragged) {
  SceneDef scene = ship_with_drag({0.0, 1.5}, 0.0, drag_step);
  scene.platform.yaw = Yaw::locked;
  scene.platform.inertia_kg_m2 = 0.0;
  Simulation run = start(scene, setting());
  const Rotation before = run.bodies().rotation[0];
  run.advance(steps);
  check_value("V95.locked", slowed_after(sway_rate, 1.5, duration), slip_of(run.bodies()).y, 1.5 * rounded, "m/s",
              where());
  EXPECT_EQ(run.bodies().rotation[0].sine, before.sine);
  EXPECT_EQ(run.bodies().spin[0], 0.0);
}

/// Speeds of a ship that drifts and turns, in its axes.
struct Drift {
  double surge, sway, spin;
};

/// Their rates of change: the drag, and the axes that turn under the velocity.
Drift rate_of(const Drift& d) {
  return {d.spin * d.sway - surge_rate * std::fabs(d.surge) * d.surge,
          -d.spin * d.surge - sway_rate * std::fabs(d.sway) * d.sway, -yaw_rate * std::fabs(d.spin) * d.spin};
}

Drift plus(const Drift& d, double h, const Drift& rate) {
  return {d.surge + h * rate.surge, d.sway + h * rate.sway, d.spin + h * rate.spin};
}

/// By Runge and Kutta of fourth order, in steps of 0.01 s: its error is far below 1e-10.
Drift drifted(Drift d, double time) {
  constexpr double h = 0.01;
  for (int i = 0; i < std::lround(time / h); ++i) {
    const Drift a = rate_of(d), b = rate_of(plus(d, 0.5 * h, a)), c = rate_of(plus(d, 0.5 * h, b)),
                e = rate_of(plus(d, h, c));
    d = plus(plus(plus(plus(d, h / 6.0, a), h / 3.0, b), h / 3.0, c), h / 6.0, e);
  }
  return d;
}

constexpr Drift drift_start{-1.0, 1.5, 0.01};

/// Difference from the drift after 200 s.
Vec2 drift_error(double dt, const Setting& setting) {
  SceneDef scene = ship_with_drag({drift_start.surge, drift_start.sway}, drift_start.spin, dt);
  Simulation run = start(scene, setting);
  run.advance(std::lround(duration / dt));
  expect_closed_books(run, 1e-12, mass * 2.2);
  const Drift exact = drifted(drift_start, duration);
  EXPECT_GT(std::fabs(angle_of(run.bodies())), 1.0) << "it turns far";
  EXPECT_NEAR(run.bodies().spin[0], exact.spin, 1e-11) << "the drift does not change the yaw";
  return slip_of(run.bodies()) - Vec2{exact.surge, exact.sway};
}

TEST_P(ShipDrag, V96_drift_and_turn_at_once) {
  // Drag at both ends of a time step is the rule of trapezia for a force whose axes turn: dt^2 / 12 of what its
  // rate of change changes. That rate is at most (2 b v + 2 r) b v^2 at the start, and little at the end.
  const double speed = std::hypot(drift_start.surge, drift_start.sway), force = sway_rate * speed * speed;
  const double bound = drag_step * drag_step / 12.0 * (2.0 * sway_rate * speed + 2.0 * drift_start.spin) * force;
  const Vec2 coarse = drift_error(2.0 * drag_step, setting()), fine = drift_error(drag_step, setting());
  check_value("V96.surge", 0.0, fine.x, bound, "m/s", where());
  check_value("V96.sway", 0.0, fine.y, bound, "m/s", where());
  // Second order: half the time step gives a quarter of the error.
  check_value("V96.order", 4.0, length(coarse) / length(fine), 0.1, "-", where());
}

}  // namespace
}  // namespace gem::verification::ship_drag
