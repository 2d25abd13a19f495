// Contacts that last: sliding and resting under drag, columns, notches and pegs, jams in a row (V30 to V38, V47).
#include <algorithm>
#include <cmath>

#include "gem/base/strict_math.h"
#include "gem/field/check_field.h"
#include "gem/field/field.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Sustained : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Sustained, ::testing::ValuesIn(all_settings()), setting_name);

/// The closed forms call C_d what is 2 C_s here.
constexpr double skin = 0.5 * 0.005;

/// Skin coefficient that gives a floe 0.5 m thick the rate k [1/m].
double skin_for(double k) { return k * 900.0 * 0.5 / 1025.0; }

SceneDef pressed_scene(Vec2 current, double skin_coefficient, double friction, double dt) {
  SceneDef scene = quiet_scene();
  scene.current.velocity_m_per_s = current;
  scene.water.drag_law = DragLaw::quadratic;
  scene.water.form_coefficient = 0.0;
  scene.water.skin_coefficient = skin_coefficient;
  scene.ice.friction_ice = friction;
  scene.numerics.moment_s = dt;
  return scene;
}

/// A floor 4 km long, turned about the origin.
FixedDef long_floor(double angle) {
  FixedDef floor{{{-2000.0, -16.0}, {2000.0, -16.0}, {2000.0, 0.0}, {-2000.0, 0.0}}};
  for (Vec2& p : floor.outline_m) p = rotate(strict::rotation_of_angle(angle), p);
  return floor;
}

/// Force of the fixed bodies on the floes over the next moments [N].
Vec2 force_of_fixed(Simulation& run, std::int64_t moments, double dt) {
  const Ledger before = run.engine->ledger();
  run.advance(moments);
  const Ledger after = run.engine->ledger();
  Vec2 given;
  for (const Channel c : {Channel::impact, Channel::friction, Channel::elastic})
    given += after[c].momentum - before[c].momentum;
  return (1.0 / (static_cast<double>(moments) * dt)) * given;
}

/// A floe held by a wall is let go by the drag for one moment at a time, so that its drag falls short by k |w| dt.
double let_go(double k, double slip, double dt) { return 1.01 * k * slip * dt; }

/// The books of a scene within `reach` metres of the origin. Twists of a held floe cancel, so the ledger's own scale of
/// angular momentum may be next to nothing.
void expect_held_books(Simulation& run, double reach) {
  const Ledger now = run.engine->ledger();
  const LedgerResidual left = residual(now);
  const double momentum = std::max(now.momentum_scale, 45000.0 * length({0.5, 0.0}));
  EXPECT_LE(left.momentum * now.momentum_scale, 1e-11 * momentum);
  EXPECT_LE(left.angular_momentum * now.angular_scale, 1e-11 * momentum * reach);
  EXPECT_LE(left.energy, 1e-10);
}

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
  check("V30.N_rest", held.y, let_go(k, 0.5, dt), where());
  check("V30.T_rest", -held.x, let_go(k, 0.5, dt), where());
  check_value("V30.rest", 0.0, length(rest.bodies().velocity[2]), rounding, "m/s", where());
  EXPECT_GT(rest.log.quality.back().contacts, 0);
  expect_held_books(rest, 1000.0);

  for (const auto& [key, friction] : {std::pair<std::string, double>{"V30.mu02", 0.2}, {"V30.mu05", 0.5}}) {
    // drag and friction share the direction of the slip, so the speed they settle at is exact; it is reached within
    // 1e-12 after 30 / (k U_y) = 13,000 s, or at once if it is the speed at the start
    Simulation slide = on_wall(friction, value_of(key + ".v"));
    slide.advance(2000);
    check(key + ".v", slide.bodies().velocity[2].x, 1e-11, where());
    const double slip = 0.4 * std::sqrt(1.0 + friction * friction);
    check(key + ".N", force_of_fixed(slide, 200, dt).y, let_go(k, slip, dt), where());
    expect_held_books(slide, 1000.0);
    // from a standstill the same speed is neared: half the difference is gone after ln 2 / (k U_y sqrt(1 + mu^2)),
    // at the latest
    Simulation begin = on_wall(friction, 0.0);
    begin.advance(static_cast<std::int64_t>(std::log(2.0) / (k * slip) / dt));
    EXPECT_GT(begin.bodies().velocity[2].x, 0.5 * value_of(key + ".v"));
    EXPECT_LT(begin.bodies().velocity[2].x, value_of(key + ".v"));
  }
  // least friction that holds, by bisection: after a moment the held floe has no speed but what sweeps leave
  double slips = 0.7, sticks = 0.8;
  while (sticks - slips > 1e-7) {
    const double friction = 0.5 * (slips + sticks);
    Simulation run = on_wall(friction, 0.0);
    run.advance(1);
    (std::fabs(run.bodies().velocity[2].x) > 1e-10 ? slips : sticks) = friction;
  }
  // friction that is short by x lets the floe go by x k |w| U_y dt = 5.7e-5 x in a moment
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
  while (run.bodies().velocity[2].x > 1e-9 && run.engine->moment() < 10000) run.advance(1);
  check_absolute("V31.t", static_cast<double>(run.engine->moment()) * dt, dt, where());
  // a path of moments at their last speed: short by dt / 2 of the 0.5 m/s that are lost
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
    // what is missing at first falls by e in 1 / (k U sin angle): 30 of these, or none
    const double away = std::fabs(at_first - value_of(key + ".v"));
    const double settling = away > 0.0 ? 30.0 / (k * speed * std::sin(angle)) : 100.0;
    run.advance(static_cast<std::int64_t>(settling / dt));
    EXPECT_GT(run.log.quality.back().contacts + run.log.quality.back().iterations, 0);
    // the floor's normal is known to 1e-16, and the floe leaves it by nothing
    check(key + ".v", dot(run.bodies().velocity[2], rotate(turn, {1.0, 0.0})), 1e-10, where());
    const double slip = speed * std::sin(angle) * std::sqrt(1.0 + friction * friction);
    const Vec2 force = force_of_fixed(run, 400, dt);
    check(key + ".N", dot(force, rotate(turn, {0.0, 1.0})), let_go(k, slip, dt) + 1e-6, where());
    expect_held_books(run, 1000.0);
  };
  slide("V32.b30.mu0", degrees(30.0), 0.0, 0.2);
  slide("V32.b30.mu03", degrees(30.0), 0.3, 0.15);
  const double taper = std::atan(50.0 / 1500.0);
  check("V32.seed.angle", taper / degrees(1.0), rounding, where());
  slide("V32.seed.mu0", taper, 0.0, value_of("V32.seed.mu0.v"));
}

/// V33 and V34 as independent has them, without elastic stress: each moment a contact passes on M_e times its closing
/// speed, so the row creeps just fast enough that the closing speeds carry the push: contact j from the wall closes at
/// 2 (sum of the pushes behind it) dt / m, the one at the wall at half of that. The drag follows the creep.
double creeping_force(int count, double dt) {
  const double mass = 45000.0, k = 0.05, speed = 0.5;
  std::vector<double> creep(static_cast<std::size_t>(count), 0.0);
  double total = 0.0;
  for (int pass = 0; pass < 200; ++pass) {
    std::vector<double> push;
    total = 0.0;
    for (const double u : creep) {
      push.push_back(mass * k * (speed - u) * (speed - u) / (1.0 + k * (speed - u) * dt));
      total += push.back();
    }
    double behind = total, at = total * dt / mass;
    for (std::size_t j = 0; j < creep.size(); ++j) {
      creep[j] = at;
      behind -= push[j];
      at += 2.0 * behind * dt / mass;
    }
  }
  return total;
}

/// V33 and V34: `count` squares in touch, pushed along x by 562.5 N each.
SceneDef column(int count, double dt) {
  SceneDef scene = pressed_scene({0.5, 0.0}, skin_for(0.05), 0.0, dt);
  for (int i = 0; i < count; ++i) scene.floe.push_back(square({-5.0 - (10.0 - touch) * i, 0.0}));
  return scene;
}

double total_overlap(const Bodies& bodies) {
  double sum = 0.0;
  for (const NearPair& pair : near_pairs(bodies, 0.0)) sum += std::max(0.0, -pair.separation);
  return sum;
}

TEST_P(Sustained, V33_column_on_a_wall) {
  const double dt = 0.01, k = 0.05, speed = 0.5;
  for (const int count : {1, 10}) {
    SceneDef scene = column(count, dt);
    scene.fixed = {{{{-touch, -20.0}, {5.0, -20.0}, {5.0, 20.0}, {-touch, 20.0}}}};
    Simulation run = start(scene, setting());
    run.advance(5900);
    const double force = -force_of_fixed(run, 100, dt).x;
    const std::string key = count == 1 ? "V33.d" : "V33.F10";
    if (setting().coupled() || count == 1) {
      // every floe's push falls short alike
      check(key, force, let_go(k, speed, dt) + 1e-6, where());
      check_value(key + ".overlap", 0.0, total_overlap(run.bodies()), 1e-3, "m", where());
    } else {
      // the row still loses speed where it creeps together: 1 % of the 3 % that the creep costs
      const double creeping = creeping_force(count, dt);
      check_value("V33.F10.creeping", creeping, force, 1e-3 * creeping, "N", where());
      EXPECT_GT(total_overlap(run.bodies()), 1e-3) << "independent holds the column as well";
    }
    expect_held_books(run, 100.0);
  }
}

TEST_P(Sustained, V34_column_on_the_moored_platform) {
  const double dt = 0.05;
  SceneDef scene = column(10, dt);
  scene.numerics.residual_tolerance = 1e-9;
  scene.platform.present = true;
  scene.platform.anchor_m = {50.0 - touch, 0.0};
  scene.mooring.damping_ratio = 0.5;
  Simulation run = start(scene, setting());
  run.log.wants_events = false;
  // half the critical damping: e^-14 of the swing is left after 400 s
  run.advance(8000);
  EXPECT_GT(run.log.platform.back().contacts, 0);
  if (setting().coupled()) {
    check("V34.offset", run.bodies().position[0].x - 50.0, let_go(0.05, 0.5, dt) + 2e-6, where());
  } else {
    const double creeping = creeping_force(10, dt) / scene.mooring.stiffness_N_per_m;
    check_value("V34.offset.creeping", creeping, run.bodies().position[0].x - 50.0, 1e-2 * creeping, "m", where());
  }
}

/// One side of a notch that opens upwards, `angle` from the vertical.
FixedDef notch_side(double angle, double side) {
  const Vec2 along{side * std::sin(angle), std::cos(angle)}, out{side * std::cos(angle), -std::sin(angle)};
  std::vector<Vec2> corners = {1.0 * along, 1.0 * along + 8.0 * out, 40.0 * along + 8.0 * out, 40.0 * along};
  if (side < 0.0) corners = {corners[3], corners[2], corners[1], corners[0]};
  return {corners};
}

TEST_P(Sustained, V35_held_in_a_notch) {
  const double alpha = degrees(35.0), dt = 0.01;
  SceneDef scene = pressed_scene({0.0, -0.5}, skin_for(0.05), 0.0, dt);
  scene.fixed = {notch_side(alpha, 1.0), notch_side(alpha, -1.0)};
  scene.floe = {square({0.0, 5.0 + 5.0 / std::tan(alpha) - touch})};
  Simulation run = start(scene, setting());
  run.advance(2000);
  // by symmetry the walls share the push. Independent: each wall answers alone and the answers are added, so the floe
  // is thrown back by as much as a moment's push d dt / m, and the drag follows by 2 / U of it
  const Vec2 force = force_of_fixed(run, 1000, dt);
  const double jitter = setting().coupled() ? 1e-6 : 2.0 * (562.5 * dt / 45000.0) / 0.5 * 2.0;
  check("V35.mu0", 0.5 * force.y / std::sin(alpha), let_go(0.05, 0.5, dt) + jitter, where());
  check_value("V35.speed", 0.0, length(run.bodies().velocity[3]), 0.5 * 0.05 * 0.5 * dt, "m/s", where());
  if (setting().coupled()) {
    const EngineState state = run.engine->save();
    ASSERT_EQ(state.impulse_value.size(), 2u);
    for (const PointImpulse<double>& impulse : state.impulse_value)
      check("V35.mu0", impulse.normal / dt, let_go(0.05, 0.5, dt) + 1e-6, where());
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
  // N1 + N2 = sum and 5 N2 - 3 N1 = twist. Independent: each peg answers alone, so the floe rocks, but over many
  // moments it is held; what is left is its momentum at both ends, a moment's push
  const double tolerance = let_go(0.05, 0.5, dt) + (setting().coupled() ? 1e-6 : 2.0 * dt / time * 5.0);
  check("V36.N1", (5.0 * sum - twist) / 8.0, tolerance, where());
  check("V36.N2", (3.0 * sum + twist) / 8.0, tolerance, where());
  expect_held_books(run, 10.0);
}

TEST(SustainedLaw, V35_sliding_in) {
  // rigid walls stop a floe dead: nothing slides in, and the lock has nothing to hold
  for (const char* what : {"in", "lock"}) not_offered("V35." + std::string(what));
}

TEST(SustainedLaw, V37_janssen_strip) {
  // friction at the walls and none between floes: a scene has one friction for both
  for (const char* what : {"lambda", "Finf", "F1", "F5", "F10", "F20"}) not_offered("V37." + std::string(what));
}

/// What a row that drifts onto a wall does: when its floes are struck, and what the wall gets.
struct Jam {
  double first = 0.0, last = 0.0;  // times at which the first and the last floe are struck [s]
  double impulse = 0.0;            // on the wall by all impacts but the first [N s]
  double strays = 0.0;             // speed left at the end [m/s]
};

Jam jam_in_a_row(double pitch, int count, const Setting& setting) {
  const double dt = 0.02, speed = 0.25;
  SceneDef scene = quiet_scene();
  scene.numerics.moment_s = dt;
  scene.fixed = {{{{0.0, -20.0}, {5.0, -20.0}, {5.0, 20.0}, {0.0, 20.0}}}};
  for (int i = 0; i < count; ++i) scene.floe.push_back(square({10.0 - (i + 1) * pitch, 0.0}, {speed, 0.0}));
  Simulation run = start(scene, setting);
  run.log.wants_events = false;
  Jam jam;
  const auto moments = static_cast<std::int64_t>((count + 1) * (pitch - 10.0) / speed / dt) + 4000;
  for (std::int64_t i = 0; i < moments; ++i) {
    run.advance(1);
    const double now = static_cast<double>(run.engine->moment()) * dt;
    if (jam.first == 0.0 && run.bodies().velocity[2].x < speed) jam.first = now;
    if (jam.last == 0.0 && run.bodies().velocity[static_cast<std::size_t>(count) + 1].x < speed) jam.last = now;
  }
  // equal impacts, the first of which opens the time that is looked at
  jam.impulse = -run.engine->ledger()[Channel::impact].momentum.x * (count - 1) / count;
  for (std::size_t i = 2; i < run.bodies().count(); ++i)
    jam.strays = std::max(jam.strays, length(run.bodies().velocity[i]));
  expect_closed_books(run, 1e-12);
  return jam;
}

TEST_P(Sustained, V38_one_dimensional_jam) {
  const int count = 10;
  const Jam jam = jam_in_a_row(25.0, count, setting());
  const double time = jam.last - jam.first;
  // each strike is seen up to a moment late. Independent: a row that is struck takes row x dt / (1 - cos(pi / (row +
  // 1))) to give its momentum away, and creeps on meanwhile at up to a share 1 / row of the speed
  double late = 2.0 * 0.02;
  if (!setting().coupled())
    for (int row = 2; row <= count; ++row) late += 0.02 / (1.0 - std::cos(M_PI / (row + 1)));
  check("V38.front", 10.0 * (count - 1) / time, late / time, where());
  check("V38.Fmean", jam.impulse / time, late / time, where());
  check_value("V38.rest", 0.0, jam.strays, 1e-6, "m/s", where());
}

TEST_P(Sustained, V47_a_plug_that_jams_at_nine_tenths) {
  // squares of 10 m in lanes of 11.1 m: in touch they cover 0.9 of their lane, at a pitch of 22.5 m 0.4
  const int count = 10, lanes = 9;
  const Jam jam = jam_in_a_row(22.5, count, setting());
  const double time = jam.last - jam.first;
  double late = 2.0 * 0.02;
  if (!setting().coupled())
    for (int row = 2; row <= count; ++row) late += 0.02 / (1.0 - std::cos(M_PI / (row + 1)));
  check("V47.plug09", lanes * jam.impulse / time, late / time, where());
}

}  // namespace
}  // namespace gem::verification
