// Water drag on floes against closed form: V22 to V29.
#include <cmath>

#include "gem/base/strict_math.h"
#include "gem/events/events.h"
#include "gem/field/drag_coefficients.h"
#include "gem/field/field.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Drag : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Drag, ::testing::ValuesIn(all_settings()), setting_name);

constexpr std::size_t floe_id = 1;

/// The C_d of the closed forms is 2 C_s here: F = rho_w C_s A |w| w.
constexpr double skin = 0.5 * 0.005;

/// Skin coefficient that gives a floe 0.5 m thick the rate k: rho_w C_s A / (rho_i A h) = k.
double skin_for(double k) { return k * 900.0 * 0.5 / 1025.0; }

/// One square floe at the origin in a current, with drag on its area only.
SceneDef drifting(Vec2 current, double skin_coefficient, double dt) {
  SceneDef scene = quiet_scene();
  scene.current.velocity_m_per_s = current;
  scene.water.drag_law = DragLaw::quadratic;
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = skin_coefficient;
  scene.numerics.time_step_s = dt;
  scene.floe = {square({})};
  return scene;
}

/// The update is exact, so n time steps add n roundings of the velocity and the path: 2e-16 n relative each.
double exact_flow(std::int64_t steps) { return rounding + 4e-16 * static_cast<double>(steps); }

void check_from_rest(const std::string& key, double skin_coefficient, const Setting& setting) {
  const std::int64_t blocks = 2000;
  const double tolerance = exact_flow(10 * blocks);
  Simulation run = start(drifting({0.25, 0.0}, skin_coefficient, 0.05), setting);
  run.advance(blocks);
  check(key + ".v100", run.bodies().velocity[floe_id].x, tolerance, setting.where());
  check(key + ".x100", run.bodies().position[floe_id].x, tolerance, setting.where());
  run.advance(9 * blocks);
  check(key + ".v1000", run.bodies().velocity[floe_id].x, tolerance, setting.where());
  check(key + ".x1000", run.bodies().position[floe_id].x, tolerance, setting.where());
  // Nine tenths of the current are reached at t90. The time is given; the speed is judged, by t = v / (k U (U - v)).
  const double t90 = value_of(key + ".t90");
  Simulation slow = start(drifting({0.25, 0.0}, skin_coefficient, t90 / 1000.0), setting);
  slow.advance(1000);
  const double v = slow.bodies().velocity[floe_id].x, k = slow.bodies().drag[floe_id];
  check(key + ".t90", v / (k * 0.25 * (0.25 - v)), 10.0 * exact_flow(1000), setting.where());
  check(key + ".x90", slow.bodies().position[floe_id].x, exact_flow(1000), setting.where());
}

TEST_P(Drag, V22_from_rest) {
  check("V22.k_skin", make_field(drifting({0.25, 0.0}, skin, 1.0)).drag[floe_id], rounding, where());
  check_from_rest("V22.skin", skin, setting());
  check_from_rest("V22.k05", skin_for(0.05), setting());
}

/// Displacement of a floe in one time step minus its new velocity x dt [m]. Another floe follows `gap` behind at the
/// same speed, so the two drift side by side without pressing.
double way_beside_velocity(double gap, const Setting& setting) {
  SceneDef scene = drifting({0.25, 0.0}, skin, 0.05);
  scene.floe.push_back(square({-(10.0 + gap), 0.0}));
  Simulation run = start(scene, setting);
  run.advance(200);
  const Vec2 before = run.bodies().position[floe_id];
  run.advance(1);
  return run.bodies().position[floe_id].x - before.x - 0.05 * run.bodies().velocity[floe_id].x;
}

TEST_P(Drag, A_floe_within_reach_leaves_the_path_of_its_drag_whatever_presses) {
  const double reach = 1.5 * 0.25 * 0.05, rounded = 1e-15;
  EXPECT_LT(way_beside_velocity(1.01 * reach, setting()), -1e-8) << "on its exact path it gets less far";
  if (setting().coupled())
    EXPECT_NEAR(way_beside_velocity(0.99 * reach, setting()), 0.0, rounded);
  else
    EXPECT_LT(way_beside_velocity(0.99 * reach, setting()), -1e-8);
}

TEST_P(Drag, V23_oblique) {
  SceneDef scene = drifting({0.5, 0.0}, skin_for(0.05), 0.05);
  scene.floe[0].velocity_m_per_s = {-0.1, 0.8};
  Simulation run = start(scene, setting());
  run.advance(1200);
  check("V23.vx", run.bodies().velocity[floe_id].x, exact_flow(1200), where());
  check("V23.vy", run.bodies().velocity[floe_id].y, exact_flow(1200), where());
  check("V23.x", run.bodies().position[floe_id].x, exact_flow(1200), where());
  check("V23.y", run.bodies().position[floe_id].y, exact_flow(1200), where());
}

TEST_P(Drag, V24_linear_law) {
  for (const double dt : {1.0, 10.0}) {
    SceneDef scene = drifting({0.25, 0.0}, 0.0, dt);
    scene.water.drag_law = DragLaw::linear;
    scene.water.linear_time_s = 100.0;
    Simulation run = start(scene, setting());
    run.advance(static_cast<std::int64_t>(250.0 / dt));
    check("V24.v", run.bodies().velocity[floe_id].x, exact_flow(250), where());
    check("V24.x", run.bodies().position[floe_id].x, exact_flow(250), where());
  }
}

TEST(DragLaw, V24_recurrences_of_euler) {
  // The program solves the linear law exactly, so the recurrences of explicit and implicit Euler do not apply.
  for (const char* what : {"expl_dt1", "impl_dt1", "expl_dt10", "impl_dt10"}) not_offered("V24." + std::string(what));
}

TEST(DragLaw, V25_spin_coefficients) {
  check("V25.r3", integral_r3(rectangle(10.0, 10.0)), rounding);
  check("V25.kw", make_field(drifting({0.25, 0.0}, skin, 1.0)).spin_drag[floe_id], rounding);
  // A disc as a polygon with n sides: r3 / I differs by less than (pi / n)^2.
  constexpr int sides = 4096;
  Bodies bodies;
  BodyDef disc;
  for (int i = 0; i < sides; ++i)
    disc.outline.push_back(rotate(strict::rotation_of_turns(static_cast<double>(i) / sides), {5.0, 0.0}));
  append(bodies, disc);
  set_drag(bodies, drifting({0.25, 0.0}, skin, 1.0));
  check("V25.kw_disc5", bodies.spin_drag[0], (M_PI / sides) * (M_PI / sides));
}

TEST_P(Drag, V25_spin_down) {
  const double dt = 0.5, spin = 0.05;
  SceneDef scene = drifting({0.0, 0.0}, skin, dt);
  scene.floe[0].spin_rad_per_s = spin;
  Simulation run = start(scene, setting());
  double angle = 0.0;
  const std::int64_t steps = 2000;
  for (std::int64_t i = 0; i < steps; ++i) {
    const Rotation before = run.bodies().rotation[floe_id];
    run.advance(1);
    const Rotation after = run.bodies().rotation[floe_id];
    angle += std::atan2(before.cosine * after.sine - before.sine * after.cosine,
                        before.cosine * after.cosine + before.sine * after.sine);
  }
  check("V25.omega", run.bodies().spin[floe_id], exact_flow(steps), where());
  // The series of each turn is exact to 17/315 p^7, p = spin dt / 2 (motion.h), and rounded to 2e-16 rad.
  const double turn = 17.0 / 315.0 * std::pow(0.5 * spin * dt, 7.0) + 2.2e-16;
  check_absolute("V25.angle", angle, static_cast<double>(steps) * turn + 32.0 * exact_flow(steps), where());
}

void check_stop_at_wall(const std::string& key, double skin_coefficient, const Setting& setting) {
  const double dt = 0.01, current = 0.25;
  SceneDef scene = drifting({current, 0.0}, skin_coefficient, dt);
  scene.floe[0].position_m.y = 3.0;  // off the line through the origin, so that angular momentum has a scale
  scene.fixed = {{{{25.0, -16.0}, {57.0, -16.0}, {57.0, 16.0}, {25.0, 16.0}}}};
  Simulation run = start(scene, setting);
  run.log.wants_events = false;
  const std::size_t floe = 2;
  double speed = 0.0, given = 0.0;
  while (given == 0.0 && run.engine->step() < 100000) {
    speed = run.bodies().velocity[floe].x;
    run.advance(1);
    given = -run.engine->ledger()[Channel::impact].momentum.x;
  }
  const double hit = static_cast<double>(run.engine->step()) * dt;
  EXPECT_GT(given, 0.0) << "the floe never met the wall";
  run.advance(2);  // coupled closes the gap exactly in the first step, then stops
  given = -run.engine->ledger()[Channel::impact].momentum.x;
  // An overlap is seen up to one time step late, and the end of the time step is recorded: 2 dt. The speed changes by
  // less than k U^2 per second. The wall also takes the drag of the 4 time steps around the event.
  const double k = run.bodies().drag[floe], pull = k * current * current;
  check_absolute(key + ".t", hit, 2.0 * dt, setting.where());
  check_absolute(key + ".v", speed, 2.0 * dt * pull, setting.where());
  check_absolute(key + ".J", given, 4.0 * dt * pull * run.bodies().mass[floe], setting.where());
  expect_closed_books(run, 1e-11);
}

TEST_P(Drag, V26_stop_at_a_wall) {
  check_stop_at_wall("V26.k05", skin_for(0.05), setting());
  check_stop_at_wall("V26.skin", skin, setting());
}

TEST(DragLaw, V27_steady_push) {
  // Push and drag alternate in steps of 1 s. The geometric mean of the slips before and after the drag is exactly
  // sqrt(F / (m k)).
  const double k = 0.05, dt = 1.0, push = 200.0 / 45000.0;
  Vec2 after{};
  double before = 0.0;
  for (int i = 0; i < 2000; ++i) {
    before = after.x + push * dt;
    after = drag_quadratic(k, {before, 0.0}, before, dt).slip;
  }
  check("V27.slip", std::sqrt(before * after.x), rounding);
}

/// Two touching square floes in line, starting from rest, with the current from behind.
SceneDef pushed_pair(double front_thickness, double dt) {
  SceneDef scene = drifting({0.5, 0.0}, skin, dt);
  scene.floe.push_back(square({10.0 - touch, 0.0}));
  scene.floe[1].thickness_m = front_thickness;
  return scene;
}

/// Force of the rear floe on the front floe in the next time step: the gain of the front floe beyond its own drag.
double force_between(Simulation& run, double dt) {
  const Bodies before = run.bodies();
  run.advance(1);
  EXPECT_GT(run.log.quality.back().contacts, 0);
  const double slip = 0.5 - before.velocity[2].x;
  const double alone = 0.5 - drag_quadratic(before.drag[2], {slip, 0.0}, slip, dt).slip.x;
  return before.mass[2] * (run.bodies().velocity[2].x - alone) / dt;
}

TEST_P(Drag, V28_pushed_pair) {
  const double dt = 0.05, k = 0.005694, current = 0.5;
  Simulation same = start(pushed_pair(0.5, dt), setting());
  check_value("V28.F_same_at_0", 0.0, force_between(same, dt), 0.0, "N", where());
  same.advance(2000);
  check_value("V28.F_same_at_100", 0.0, force_between(same, dt), 0.0, "N", where());

  Simulation run = start(pushed_pair(1.2, dt), setting());
  const Bodies& b = run.bodies();
  const double drag_force = b.drag[1] * b.mass[1] * current * current;
  check("V28.d", drag_force, rounding, where());
  check("V28.kbar", 2.0 * drag_force / (current * current) / (b.mass[1] + b.mass[2]), rounding, where());
  // Drag and contact alternate, an error of first order: the drag changes by 2 k U dt within a time step.
  const double turns = 2.0 * k * current * dt;
  check("V28.F0", force_between(run, dt), turns, where());
  run.advance(12000 - 1);
  check("V28.v600", run.bodies().velocity[1].x, turns, where());
  check("V28.v600", run.bodies().velocity[2].x, turns, where());
  check("V28.F600", force_between(run, dt), 2.0 * turns, where());
  expect_closed_books(run, 1e-11);
}

TEST(DragLaw, V29_one_long_step) {
  for (const auto& [key, k] : {std::pair{"V22.skin", value_of("V22.k_skin")}, std::pair{"V22.k05", 0.05}}) {
    const DragSolution drag = drag_quadratic(k, {0.25, 0.0}, 0.25, 1000.0);
    const double path = drag.slip.x * 1000.0 + drag.path_correction.x;
    const std::string name = "V29." + std::string(key).substr(4);
    check_value(name + ".v1000", value_of(std::string(key) + ".v1000"), 0.25 - drag.slip.x, rounding, "m/s");
    check_value(name + ".x1000", value_of(std::string(key) + ".x1000"), 0.25 * 1000.0 - path, 250.0 * rounding, "m");
  }
  const Vec2 slip{0.6, -0.8};
  const DragSolution oblique = drag_quadratic(0.05, slip, 1.0, 60.0);
  check_value("V29.oblique.vy", value_of("V23.vy"), -oblique.slip.y, rounding, "m/s");
}

}  // namespace
}  // namespace gem::verification
