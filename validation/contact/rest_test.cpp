// Contacts that last: friction on a wall, loads that vary, rows, wedges and unequal masses.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "validation/contact/scenes.h"

namespace gem::hits {
namespace {

double degrees(double angle) { return angle * M_PI / 180.0; }

/// The open scene with a current and the drag of the defaults.
SceneDef pressed_scene(Vec2 current) {
  SceneDef scene = open_scene();
  scene.water = {};
  scene.current.velocity_m_per_s = current;
  return scene;
}

/// Mean force of the fixed bodies on all floes over `time` [N].
double force_of_fixed(Trial& run, const SceneDef& scene, double time) {
  const auto given = [&] {
    const Ledger ledger = run.engine->ledger();
    return ledger[Channel::impact].momentum + ledger[Channel::friction].momentum;
  };
  const Vec2 before = given();
  run.advance_for(scene, time);
  return -(given() - before).x / time;
}

/// Sum of the drag on all floes, if they rest [N].
double drags(const Bodies& bodies, double speed) {
  double sum = 0.0;
  for (std::size_t i = first_floe(bodies); i < bodies.count(); ++i) sum += drag_of(bodies, i, speed);
  return sum;
}

/// Angle of friction on a wall: the current presses a square with its face on the wall, `angle` from the normal.
/// Returns how far it has moved along the wall in 600 s, and what the closed form says [m].
struct Slid {
  double moved = 0.0, expected = 0.0;
};
Slid slide(double angle) {
  constexpr double speed = 0.5, friction = 0.35, time = 600.0;
  SceneDef scene = pressed_scene({speed * std::cos(degrees(angle)), speed * std::sin(degrees(angle))});
  scene.ice.friction_ice = friction;
  scene.fixed = {wall_body()};
  scene.floe = {floe_of(rectangle(10.0, 10.0), {-5.0 - 1e-6, 0.0})};
  Trial run(scene);
  run.log.wants_events = false;
  run.advance_for(scene, 20.0);
  const std::size_t floe = first_floe(run.bodies());
  const double k = run.bodies().drag[floe], from = run.bodies().position[floe].y;
  double v = run.bodies().velocity[floe].y;
  run.advance_for(scene, time);
  // v' = k |w| w_y - mu k |w| w_x with the slip w = U - v, which has no part across the wall but U_x
  const Vec2 current = scene.current.velocity_m_per_s;
  double expected = 0.0;
  constexpr double dt = 0.01;
  for (double t = 0.0; t < time; t += dt) {
    const Vec2 slip{current.x, current.y - v};
    v = std::max(0.0, v + dt * k * length(slip) * (slip.y - friction * slip.x));
    expected += dt * v;
  }
  return {run.bodies().position[floe].y - from, expected};
}

TEST(ContactRest, below_the_angle_of_friction_a_floe_stays) { EXPECT_LT(std::fabs(slide(19.2).moved), 1e-3); }

TEST(ContactRest, above_the_angle_of_friction_a_floe_slides) {
  for (const double angle : {19.4, 20.0}) {
    const Slid slid = slide(angle);
    EXPECT_NEAR(slid.moved, slid.expected, 0.01 * slid.expected) << angle;
  }
}

/// A corner on the wall under 20 kN that vary by `share` at 1 Hz: the current drags a large floe. It rises slowly, so
/// that the ice is no more crushed than by this load. Returns the drift of the floe [m/h].
double drift_of_corner(double share, double time) {
  SceneDef scene = pressed_scene({1.0, 0.0});
  scene.fixed = {wall_body()};
  scene.floe = {floe_of(rhombus(40.0, 0.5 * M_PI), {-40.0 * std::sqrt(0.5) - 1e-6, 0.0})};
  {
    const Trial probe(scene);
    const Bodies& b = probe.engine->bodies();
    const double speed = std::sqrt(20e3 / drag_of(b, first_floe(b), 1.0));
    scene.drive.current_velocity = {{0.0, 0.01, 0.0}, {500.0, speed, 0.0}};
    // force goes as the square of the speed
    if (share > 0.0) scene.drive.tide = {{1.0, 0.5 * share * speed, 0.0, 0.0, 0.0}};
  }
  Trial run(scene);
  run.log.wants_events = false;
  run.advance_for(scene, 600.0);
  for (const CornerMemory& corner : run.engine->save().corner_value)
    EXPECT_NEAR(corner.normal, 20e3, 1.5 * 20e3 * share + 200.0);  // 1 Hz is half of its natural frequency
  const std::size_t floe = first_floe(run.bodies());
  const double from = run.bodies().position[floe].x;
  run.advance_for(scene, time);
  return (run.bodies().position[floe].x - from) * 3600.0 / time;
}

TEST(ContactRest, corner_under_a_load_that_varies_creeps_less_than_1_mm_an_hour) {
  EXPECT_LT(std::fabs(drift_of_corner(0.0, 1000.0)), 1e-3);
  EXPECT_LT(std::fabs(drift_of_corner(0.2, 1000.0)), 1e-3);
}

/// Ten floes pressed on a wall by the current, while light floes drift along the row, touching it.
double drift_beside_light_floes(bool light, double time) {
  SceneDef scene = pressed_scene({0.5, 0.0});
  scene.ice.friction_ice = 0.1;
  scene.fixed = {wall_body(),
                 {{{-200.0, -12.0}, {0.0, -12.0}, {0.0, -6.0}, {-200.0, -6.0}}},
                 {{{-200.0, 7.0}, {0.0, 7.0}, {0.0, 12.0}, {-200.0, 12.0}}}};
  for (int k = 0; k < 10; ++k) {
    FloeDef floe = floe_of(rectangle(10.0, 10.0 + 0.1 * (k % 3)), {-5.0 - 10.001 * k, 0.03 * (k % 4)});
    floe.outline_m[1].x -= 0.2 * (k % 2);
    scene.floe.push_back(floe);
  }
  for (int k = 0; light && k < 30; ++k) {
    FloeDef floe = floe_of(regular(5, 0.3), {-120.0 - 0.9 * k, 6.0 + 0.15 * (k % 4)}, {0.5, 0.0}, 0.3);
    floe.thickness_m = 0.1;
    scene.floe.push_back(floe);
  }
  Trial run(scene);
  run.log.wants_events = false;
  run.advance_for(scene, 200.0);
  const std::size_t first = first_floe(run.bodies());
  std::vector<double> from;
  for (int k = 0; k < 10; ++k) from.push_back(run.bodies().position[first + k].x);
  run.advance_for(scene, time);
  double farthest = 0.0;
  for (int k = 0; k < 10; ++k) farthest = std::max(farthest, run.bodies().position[first + k].x - from[k]);
  return farthest * 3600.0 / time;
}

TEST(ContactRest, light_floes_that_pass_do_not_push_a_row_into_the_ice) {
  EXPECT_LT(drift_beside_light_floes(true, 3600.0), 1e-3);
}

TEST(ContactRest, row_of_60_presses_with_all_its_drag) {
  constexpr double speed = 0.3;
  SceneDef scene = pressed_scene({speed, 0.0});
  scene.fixed = {wall_body()};
  double edge = 0.0;
  for (int k = 0; k < 60; ++k) {
    const double length = 4.0 + (7 * k % 11), width = 6.0 + (5 * k % 9);
    FloeDef floe = floe_of(rectangle(length, width), {edge - 0.5 * length - 1e-3, 0.0});
    floe.thickness_m = 0.4 + 0.1 * (k % 10);
    edge -= length + 1e-3;
    scene.floe.push_back(floe);
  }
  Trial run(scene);
  run.log.wants_events = false;
  run.advance_for(scene, 250.0);
  const double all = drags(run.bodies(), speed);
  EXPECT_NEAR(force_of_fixed(run, scene, 10.0), all, 0.005 * all);
}

/// A wedge of the half angle `degrees_` between two walls, at rest. Returns N sin(a) over half of the drag.
double wedge_force(double half_angle, double time) {
  constexpr double speed = 0.5;
  const double t = std::tan(degrees(half_angle));
  SceneDef scene = pressed_scene({speed, 0.0});
  scene.numerics.time_step_s = 0.05;
  const double front = 6.0 - 10.0 * t;
  scene.floe = {floe_of({{-5.0, -6.0}, {5.0, -front}, {5.0, front}, {-5.0, 6.0}}, {-0.2, 0.0})};
  const auto high = [&](double x) { return 6.0 - (x + 5.0) * t; };
  scene.fixed = {{{{-60.0, high(-60.0)}, {40.0, high(40.0)}, {40.0, 60.0}, {-60.0, 60.0}}},
                 {{{-60.0, -60.0}, {40.0, -60.0}, {40.0, -high(40.0)}, {-60.0, -high(-60.0)}}}};
  Trial run(scene);
  run.log.wants_forces = true;
  run.advance_for(scene, time);
  run.log.clear();
  run.advance_for(scene, 10.0);
  double sum = 0.0;
  for (const StepForce& force : run.log.forces) sum += length(force.force.force);
  const double normal = 0.5 * sum * scene.numerics.time_step_s / 10.0;
  return normal * 2.0 * std::sin(degrees(half_angle)) / drags(run.bodies(), speed);
}

TEST(ContactRest, wedge_of_5_degrees) { EXPECT_NEAR(wedge_force(5.0, 400.0), 1.0, 0.01); }
TEST(ContactRest, wedge_of_1_degree) { EXPECT_NEAR(wedge_force(1.0, 600.0), 1.0, 0.01); }

TEST(ContactRest, light_floe_before_a_heavy_one) {
  constexpr double speed = 0.2;
  SceneDef scene = pressed_scene({speed, 0.0});
  scene.ice.friction_ice = 0.35;
  scene.fixed = {wall_body()};
  scene.floe = {floe_of(rectangle(1.0, 1.0), {-0.5, 0.0}), floe_of(rectangle(31.6, 31.6), {-16.8, 0.0})};
  scene.floe[0].thickness_m = 0.1;
  Trial run(scene);
  run.log.wants_events = false;
  run.advance_for(scene, 450.0);
  const double all = drags(run.bodies(), speed);
  EXPECT_NEAR(force_of_fixed(run, scene, 60.0), all, 0.03 * all);
}

}  // namespace
}  // namespace gem::hits
