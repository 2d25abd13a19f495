// Floes held by walls: sliding and resting under drag, notches and pegs (V30 to V32, V35 to V37).
#include <algorithm>
#include <cmath>

#include "gem/base/strict_math.h"
#include "validation/verification/expected.h"
#include "validation/verification/pressed.h"

namespace gem::verification {
namespace {

class Sustained : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Sustained, ::testing::ValuesIn(all_settings()), setting_name);

TEST_P(Sustained, V30_rest_and_slide_on_a_wall) {
  const double dt = 0.05, k = 0.00569444444444;
  const auto on_wall = [&](double friction, double speed) {
    SceneDef scene = pressed_scene({0.3, -0.4}, skin, friction, dt);
    scene.fixed = {long_floor(0.0)};
    scene.floe = {on_floor(square({-1000.0, 0.0}, {speed, 0.0}))};
    return start(scene, setting());
  };
  Simulation rest = on_wall(0.8, 0.0);
  rest.advance(200);
  const Vec2 held = force_of_fixed(rest, 200, dt);
  check("V30.N_rest", held.y, drag_shortfall(k, 0.5, dt), where());
  check("V30.T_rest", -held.x, drag_shortfall(k, 0.5, dt), where());
  check_value("V30.rest", 0.0, length(rest.bodies().velocity[2]), rounding, "m/s", where());
  EXPECT_GT(rest.log.quality.back().contacts, 0);
  expect_held_books(rest, 1000.0);

  for (const auto& [key, friction] : {std::pair<std::string, double>{"V30.mu02", 0.2}, {"V30.mu05", 0.5}}) {
    // Drag and friction act along the slip, so the steady speed is exact. It is reached to 1e-12 after 30 / (k U_y) =
    // 13,000 s, or at once if it is the start speed.
    Simulation slide = on_wall(friction, value_of(key + ".v"));
    slide.advance(2000);
    check(key + ".v", slide.bodies().velocity[2].x, 1e-11, where());
    const double slip = 0.4 * std::sqrt(1.0 + friction * friction);
    check(key + ".N", force_of_fixed(slide, 200, dt).y, drag_shortfall(k, slip, dt), where());
    expect_held_books(slide, 1000.0);
    // From rest the same speed is approached: half of the difference is gone after at most ln 2 / (k U_y sqrt(1 +
    // mu^2)).
    Simulation begin = on_wall(friction, 0.0);
    begin.advance(static_cast<std::int64_t>(std::log(2.0) / (k * slip) / dt));
    EXPECT_GT(begin.bodies().velocity[2].x, 0.5 * value_of(key + ".v"));
    EXPECT_LT(begin.bodies().velocity[2].x, value_of(key + ".v"));
  }
  // Smallest friction that holds, by bisection: after a time step the held floe has only the speed left by the sweeps.
  double slips = 0.7, sticks = 0.8;
  while (sticks - slips > 1e-7) {
    const double friction = 0.5 * (slips + sticks);
    Simulation run = on_wall(friction, 0.0);
    run.advance(1);
    (std::fabs(run.bodies().velocity[2].x) > 1e-10 ? slips : sticks) = friction;
  }
  // If the friction is x too low, the floe moves at x k |w| U_y dt = 5.7e-5 x after one time step.
  check("V30.mu_static", sticks, 1e-5, where());
}

TEST_P(Sustained, V31_slides_to_a_stop_and_stays) {
  const double dt = 0.05;
  SceneDef scene = pressed_scene({0.0, -0.4}, 0.0, 0.3, dt);
  scene.water.drag_law = DragLaw::linear;
  scene.water.linear_time_s = 100.0;
  scene.fixed = {long_floor(0.0)};
  scene.floe = {on_floor(square({}, {0.5, 0.0}))};
  Simulation run = start(scene, setting());
  run.advance(1000);
  check("V31.v50", run.bodies().velocity[2].x, 1e-11, where());
  while (run.bodies().velocity[2].x > 1e-9 && run.engine->step() < 10000) run.advance(1);
  check_absolute("V31.t", static_cast<double>(run.engine->step()) * dt, dt, where());
  // The path sums time steps at their last speed: too short by dt / 2 of the 0.5 m/s that are lost.
  check_absolute("V31.x", run.bodies().position[2].x, 0.5 * dt * 0.5 * 1.01, where());
  const double stopped = run.bodies().position[2].x;
  run.advance(4000);
  check_value("V31.creep", 0.0, run.bodies().position[2].x - stopped, 1e-12, "m", where());
  expect_held_books(run, 100.0);
}

TEST_P(Sustained, V32_along_a_barrier) {
  const double dt = 0.05, k = 0.05, speed = 0.25;
  const auto slide = [&](const std::string& key, double angle, double friction, double at_first) {
    SceneDef scene = pressed_scene({speed, 0.0}, skin_for(k), friction, dt);
    scene.fixed = {long_floor(angle)};
    const Rotation turn = strict::rotation_of_angle(angle);
    FloeDef floe = square({}, rotate(turn, {at_first, 0.0}), angle);
    floe.position_m = rotate(turn, {-1000.0, 5.0 - touch});
    scene.floe = {floe};
    Simulation run = start(scene, setting());
    // The initial difference falls by a factor e in 1 / (k U sin angle): 30 of these, or none.
    const double away = std::fabs(at_first - value_of(key + ".v"));
    const double settling = away > 0.0 ? 30.0 / (k * speed * std::sin(angle)) : 100.0;
    run.advance(static_cast<std::int64_t>(settling / dt));
    EXPECT_GT(run.log.quality.back().contacts + run.log.quality.back().iterations, 0);
    // The normal of the floor is accurate to 1e-16, and the floe does not leave the floor.
    check(key + ".v", dot(run.bodies().velocity[2], rotate(turn, {1.0, 0.0})), 1e-10, where());
    const double slip = speed * std::sin(angle) * std::sqrt(1.0 + friction * friction);
    const Vec2 force = force_of_fixed(run, 400, dt);
    check(key + ".N", dot(force, rotate(turn, {0.0, 1.0})), drag_shortfall(k, slip, dt) + 1e-6, where());
    expect_held_books(run, 1000.0);
  };
  slide("V32.b30.mu0", degrees(30.0), 0.0, 0.2);
  slide("V32.b30.mu03", degrees(30.0), 0.3, 0.15);
  const double taper = std::atan(50.0 / 1500.0);
  check("V32.seed.angle", taper / degrees(1.0), rounding, where());
  slide("V32.seed.mu0", taper, 0.0, value_of("V32.seed.mu0.v"));
}

TEST_P(Sustained, V35_held_in_a_notch) {
  const double alpha = degrees(35.0), dt = 0.01;
  SceneDef scene = pressed_scene({0.0, -0.5}, skin_for(0.05), 0.0, dt);
  scene.fixed = {notch_side(alpha, 1.0), notch_side(alpha, -1.0)};
  scene.floe = {square({0.0, 5.0 + 5.0 / std::tan(alpha) - touch})};
  Simulation run = start(scene, setting());
  run.advance(2000);
  // By symmetry the walls share the push. Independent: each wall answers alone and the answers are added, so the floe
  // is thrown back by up to a time step's push d dt / m, and the drag changes by 2 / U of it.
  const Vec2 force = force_of_fixed(run, 1000, dt);
  const double jitter = setting().coupled() ? 1e-6 : 2.0 * (562.5 * dt / 45000.0) / 0.5 * 2.0;
  check("V35.mu0", 0.5 * force.y / std::sin(alpha), drag_shortfall(0.05, 0.5, dt) + jitter, where());
  check_value("V35.speed", 0.0, length(run.bodies().velocity[3]), 0.5 * 0.05 * 0.5 * dt, "m/s", where());
  if (setting().coupled()) {
    const EngineState state = run.engine->save();
    ASSERT_EQ(state.impulse_value.size(), 2u);
    for (const PointMemory& point : state.impulse_value)
      check("V35.mu0", point.impulse.normal / dt, drag_shortfall(0.05, 0.5, dt) + 1e-6, where());
  }
  expect_held_books(run, 10.0);
}

TEST_P(Sustained, V36_two_pegs) {
  const double dt = 0.001;
  SceneDef scene = pressed_scene({0.0, -0.5}, skin_for(0.05), 0.0, dt);
  for (const double x : {-3.0, 5.0}) scene.fixed.push_back({{{x, 0.0}, {x - 1.0, -2.0}, {x + 1.0, -2.0}}});
  FloeDef floe = square({});
  floe.outline_m = rectangle(20.0, 5.0);
  scene.floe = {on_floor(floe)};
  Simulation run = start(scene, setting());
  run.advance(1000);
  const Ledger before = run.engine->ledger();
  run.advance(4000);
  const Ledger after = run.engine->ledger();
  const double time = 4000 * dt;
  const double sum = (after[Channel::impact].momentum.y - before[Channel::impact].momentum.y) / time;
  const double twist = (after[Channel::impact].angular_momentum - before[Channel::impact].angular_momentum) / time;
  // N1 + N2 = sum and 5 N2 - 3 N1 = twist. Independent: each peg answers alone, so the floe rocks, but over many time
  // steps it is held. The error is its momentum at both ends, one time step's push.
  const double tolerance = drag_shortfall(0.05, 0.5, dt) + (setting().coupled() ? 1e-6 : 2.0 * dt / time * 5.0);
  check("V36.N1", (5.0 * sum - twist) / 8.0, tolerance, where());
  check("V36.N2", (3.0 * sum + twist) / 8.0, tolerance, where());
  expect_held_books(run, 10.0);
}

TEST(SustainedLaw, V35_sliding_in) {
  // Rigid walls stop a floe at once: nothing slides in, so there is nothing to lock.
  for (const char* what : {"in", "lock"}) not_offered("V35." + std::string(what));
}

TEST(SustainedLaw, V37_janssen_strip) {
  // Needs friction at the walls and none between floes; a scene has one friction for both.
  for (const char* what : {"lambda", "Finf", "F1", "F5", "F10", "F20"}) not_offered("V37." + std::string(what));
}

}  // namespace
}  // namespace gem::verification
