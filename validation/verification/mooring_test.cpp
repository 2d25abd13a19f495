// Moorings beyond the linear one against closed form: tables, yaw stiffness, lines and their failure: V67 to V71.
#include <algorithm>
#include <cmath>
#include <vector>

#include "gem/base/strict_math.h"
#include "validation/verification/crowd.h"
#include "validation/verification/expected.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Mooring : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Mooring, ::testing::ValuesIn(all_settings()), setting_name);

constexpr double barge_mass = 1e8;
/// Of the table with a slope of 5e5 N/m [rad/s].
const double swing_rate = std::sqrt(5e5 / barge_mass);

/// A single platform, 100 m wide, on a mooring of a table.
SceneDef on_table(std::vector<ForceRow> rows, double offset, double dt) {
  SceneDef scene = quiet_scene();
  scene.platform = {};
  scene.platform.start_offset_m = {offset, 0.0};
  scene.mooring.law = MooringLaw::table;
  scene.mooring_design.force = std::move(rows);
  scene.numerics.time_step_s = dt;
  return scene;
}

const std::vector<ForceRow> spring = {{0.0, 0.0}, {1.0, 5e5}};

Vec2 place_of(Simulation& run) { return run.bodies().position[0]; }

/// Mean period over `swings`, from the passages of the anchor. The platform passes it at constant speed to better than
/// the rounding of the interpolation.
double measured_period(Simulation& run, double dt, int swings) {
  std::vector<double> passages;
  while (passages.size() < static_cast<std::size_t>(swings) + 1 && run.engine->step() < 100000) {
    const double before = place_of(run).x;
    run.log.clear();
    run.advance(1);
    const double after = place_of(run).x;
    if (before > 0.0 && after <= 0.0)
      passages.push_back((static_cast<double>(run.engine->step()) - after / (after - before)) * dt);
  }
  return passages.size() < 2 ? 0.0 : (passages.back() - passages.front()) / static_cast<double>(passages.size() - 1);
}

TEST_P(Mooring, V67_time_steps_of_a_linear_table) {
  const double dt = 2.0;
  Simulation run = start(on_table(spring, 3.0, dt), setting());
  run.advance(500);
  // 1000 half steps whose rotation is sin(theta / 2) = omega dt / 4. Each rounds place and velocity a few
  // times.
  const double tolerance = 3.0 * 1000 * 4e-16 + 2e-14;
  check_absolute("V67.steps.x", place_of(run).x, tolerance, where());
  check_absolute("V67.steps.v", run.bodies().velocity[0].x, tolerance, where());
  expect_closed_books(run, 1e-11);
}

/// Distance from the exact swing after 100 s.
double error_after_100_s(double dt, const Setting& setting) {
  Simulation run = start(on_table(spring, 3.0, dt), setting);
  run.advance(std::llround(100.0 / dt));
  return std::fabs(place_of(run).x - 3.0 * std::cos(100.0 * swing_rate));
}

TEST_P(Mooring, V67_second_order) {
  // the next term of the error is of fourth order: (omega dt / 2)^2 / 12 of it, 0.04 % for the first pair
  check_value("V67.order", 4.0, error_after_100_s(2.0, setting()) / error_after_100_s(1.0, setting()), 0.02, "-",
              where());
  check_value("V67.order", 4.0, error_after_100_s(1.0, setting()) / error_after_100_s(0.5, setting()), 0.005, "-",
              where());
}

TEST_P(Mooring, V67_periods_of_slack_and_hardening_tables) {
  for (const double dt : {1.0, 0.5}) {
    // a linear swing is fast by (omega dt / 2)^2 / 24; four times that for the corners of the table
    Simulation slack = start(on_table({{2.0, 0.0}, {3.0, 5e5}}, 5.0, dt), setting());
    check("V67.slack.T", measured_period(slack, dt, 5), std::pow(swing_rate * dt, 2) / 24.0, where());
    Simulation hard = start(on_table({{0.0, 0.0}, {2.0, 1e6}, {4.0, 4e6}, {5.0, 9e6}}, 4.5, dt), setting());
    const double steepest = std::sqrt(5e6 / barge_mass);
    check("V67.table.T", measured_period(hard, dt, 5), std::pow(steepest * dt, 2) / 24.0, where());
    expect_closed_books(hard, 1e-11);
  }
}

TEST_P(Mooring, V67_no_energy_is_lost_or_won) {
  const double dt = 1.0, energy = 2e6 + 5e6 + 0.25 * (4e6 + 5e6 * 0.25);
  Simulation run = start(on_table({{0.0, 0.0}, {2.0, 1e6}, {4.0, 4e6}, {5.0, 9e6}}, 4.5, dt), setting());
  double least = 0.0, most = 0.0;
  for (int k = 0; k < 200; ++k) {
    run.log.clear();
    run.advance(30);
    const double error = run.engine->ledger()[Channel::mooring].energy;
    least = std::min(least, error);
    most = std::max(most, error);
  }
  // the energy that the time steps keep differs from the true one by (omega dt / 2)^2 / 4 of it, over 100 swings as
  // over one
  const double share = 5e6 / barge_mass * 0.25 * dt * dt / 4.0;
  check_value("V67.energy", 0.0, (most - least) / energy, 2.0 * share, "-", where());
  EXPECT_GT(most - least, 1e-6 * energy);
}

TEST_P(Mooring, V68_offset_in_the_wind) {
  SceneDef scene = on_table({}, 0.0, 0.1);
  for (const double angle : {0.0, 1.5, 3.1415926535897931, 4.5})
    for (const ForceRow row : {ForceRow{0.0, 0.0}, ForceRow{2.0, 5e5}, ForceRow{4.0, 5e5 + 2e6 * 1.4117647058823530}})
      scene.mooring_design.direction.push_back({angle, row[0], row[1]});
  scene.mooring.damping_N_s_per_m = 6e6;
  scene.wind.velocity_m_per_s = {-20.0, 0.0};
  scene.wind.platform_area_m2 = 5000.0;
  scene.water.drag_law = DragLaw::quadratic;
  Simulation run = start(scene, setting());
  run.advance(9000);
  // 1.3 MN: as in V65, with a time step of the order of (omega dt)^2
  const double order = 1.5e6 / barge_mass * 0.01;
  check("V68.offset", -place_of(run).x, order, where());
  check_value("V68.sway", 0.0, place_of(run).y, 1e-6, "m", where());
  expect_closed_books(run, 1e-11);
}

std::uint64_t hash_of_crowd(const SceneDef& scene, const Setting& setting) {
  Simulation run = start(scene, setting);
  run.advance(40);
  expect_closed_books(run, 1e-11);
  return run.engine->state_hash();
}

TEST_P(Mooring, V68_the_same_in_all_directions_changes_no_bit) {
  SceneDef scene = crowd(setting());
  scene.mooring = {.law = MooringLaw::table};
  scene.mooring_design.force = {{0.0, 0.0}, {1.0, 5e5}};
  const std::uint64_t radial = hash_of_crowd(scene, setting());
  scene.mooring_design.force.clear();
  for (const double angle : {0.0, 2.0, 4.0})
    scene.mooring_design.direction.insert(scene.mooring_design.direction.end(), {{angle, 0.0, 0.0}, {angle, 1.0, 5e5}});
  EXPECT_EQ(hash_of_crowd(scene, setting()), radial);
  for (DirectionRow& row : scene.mooring_design.direction) row[2] *= 2.0;
  EXPECT_NE(hash_of_crowd(scene, setting()), radial);
}

TEST_P(Mooring, V69_swing_of_the_yaw) {
  const double dt = 2.0, stiffness = 1e9;
  SceneDef scene = on_table(spring, 0.0, dt);
  scene.mooring.yaw_stiffness_N_m_per_rad = stiffness;
  scene.platform.start_yaw_rad = 0.05;
  Simulation run = start(scene, setting());
  const double rate = std::sqrt(stiffness / run.bodies().inertia[0]);
  run.advance(500);
  // half a kick, a turn, half a kick: sin(theta / 2) = omega dt / 2; the angle rounds to 1e-15 in each time step
  const double theta = 2.0 * std::asin(0.5 * rate * dt);
  check_value("V69.yaw", 0.05 * std::cos(500.0 * theta), strict::angle_of(run.bodies().rotation[0]), 500 * 2e-15, "rad",
              where());
  expect_closed_books(run, 1e-11);
}

TEST_P(Mooring, V69_decay) {
  const double dt = 1.0;
  SceneDef scene = on_table({}, 0.0, dt);
  scene.mooring = {.stiffness_N_per_m = 0.0, .damping_N_s_per_m = 1e6, .yaw_damping_N_m_s_per_rad = 1e9};
  scene.platform.start_velocity_m_per_s = {0.3, -0.1};
  scene.platform.start_spin_rad_per_s = 0.001;
  Simulation run = start(scene, setting());
  run.advance(100);
  const double decay = std::exp(-1e6 / barge_mass * 100.0);
  check_value("V69.surge", 0.3 * decay, run.bodies().velocity[0].x, 0.3 * 4e-14, "m/s", where());
  check_value("V69.spin", 0.001 * std::exp(-1e9 / run.bodies().inertia[0] * 100.0), run.bodies().spin[0], 0.001 * 4e-14,
              "rad/s", where());
  expect_closed_books(run, 1e-11);
}

/// Four chains of 600 m in 40 m of water, anchored 598.2 m from their fairleads.
SceneDef on_chains() {
  SceneDef scene = on_table({}, 0.0, 0.5);
  scene.mooring.law = MooringLaw::catenary;
  scene.mooring_design.line_height_m = 40.0;
  for (const Vec2 e : {Vec2{1.0, 0.0}, Vec2{0.0, 1.0}, Vec2{-1.0, 0.0}, Vec2{0.0, -1.0}})
    scene.mooring_design.lines.push_back({648.2 * e.x, 648.2 * e.y, 50.0 * e.x, 50.0 * e.y, 600.0, 1400.0, 7e8, 0.0});
  return scene;
}

TEST_P(Mooring, V70_four_lines) {
  constexpr double curve = 1e-6;
  SceneDef scene = on_chains();
  const MooringTables tables = mooring_tables(scene.mooring.law, scene.mooring_design);
  check("V70.T", line_tension(tables.view(), 2, {}, {}), curve, where());
  scene.platform.start_offset_m = {1.0, 0.0};
  const double dt = scene.numerics.time_step_s = 1e-3;
  Simulation run = start(scene, setting());
  run.advance(1);
  // it has moved by F dt^2 / (2 M), 1e-8 m
  check("V70.F", -run.log.platform.back().mooring_impulse.x / dt, curve, where());
  check_value("V70.N", 0.0, run.bodies().spin[0], 1e-15, "rad/s", where());
  run.advance(500);
  expect_closed_books(run, 1e-11);
}

TEST_P(Mooring, V70_lines_hold_the_yaw) {
  SceneDef scene = on_chains();
  scene.platform.start_yaw_rad = 0.1;
  Simulation run = start(scene, setting());
  run.advance(1);
  EXPECT_LT(run.bodies().spin[0], 0.0);
  run.advance(200);
  expect_closed_books(run, 1e-11);
}

/// The chains, of which that at -x breaks when the platform, pushed to +x, is 2 m from its anchor.
constexpr double break_at = 2.0, push = 0.4;

SceneDef on_weak_chains(double dt) {
  SceneDef scene = on_chains();
  scene.numerics.time_step_s = dt;
  scene.platform.start_velocity_m_per_s = {push, 0.0};
  const MooringTables tables = mooring_tables(scene.mooring.law, scene.mooring_design);
  const double strength = line_tension(tables.view(), 2, {break_at, 0.0}, {1.0, 0.0});
  for (LineRow& line : scene.mooring_design.lines) line[7] = strength;
  return scene;
}

constexpr LineSet line_at_minus_x = 4;

/// Energy of the chains with the platform at x on the axis [J].
double energy_at(const SceneDef& scene, double x, LineSet broken) {
  const MooringTables tables = mooring_tables(scene.mooring.law, scene.mooring_design);
  return lines_pull(tables.view(), {x, 0.0}, {1.0, 0.0}, broken).energy;
}

/// Time from the anchor to x without a break, from the energy of the chains, by Simpson's rule [s].
double time_to(const SceneDef& scene, double x) {
  constexpr int parts = 400;
  double sum = 0.0;
  for (int k = 0; k <= parts; ++k) {
    const double won = energy_at(scene, x * k / parts, 0) - energy_at(scene, 0.0, 0);
    sum += (k == 0 || k == parts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) / std::sqrt(push * push - 2.0 * won / barge_mass);
  }
  return sum * x / parts / 3.0;
}

TEST_P(Mooring, V71_a_line_breaks) {
  const double dt = 0.01;
  const SceneDef scene = on_weak_chains(dt);
  Simulation run = start(scene, setting());
  double before = 0.0;
  while (run.engine->broken_lines() == 0 && run.engine->step() < 2000) {
    before = run.engine->ledger()[Channel::mooring].energy;
    run.log.clear();
    run.advance(1);
  }
  EXPECT_EQ(run.engine->broken_lines(), line_at_minus_x);
  EXPECT_EQ(run.log.platform.back().broken, line_at_minus_x);
  const double x = place_of(run).x, speed = run.bodies().velocity[0].x;
  // it breaks at the end of the time step; the swing is fast by (omega dt)^2 / 24 with omega dt < 2e-3
  EXPECT_GE(x, break_at);
  EXPECT_LT(x - speed * dt, break_at + 1e-6);
  check_value("V71.time", time_to(scene, x), static_cast<double>(run.engine->step()) * dt, 1e-5, "s", where());
  // the books lose the energy of the line; the steps keep the energy of the swing to (omega dt)^2 / 4 of it
  const double lost = energy_at(scene, x, 0) - energy_at(scene, x, line_at_minus_x);
  check_value("V71.energy", -lost, run.engine->ledger()[Channel::mooring].energy - before, 1e-6 * lost, "J", where());
  run.advance(2000);
  EXPECT_EQ(run.engine->broken_lines(), line_at_minus_x);
  const double place = place_of(run).x;
  const double gain = energy_at(scene, x, line_at_minus_x) - energy_at(scene, place, line_at_minus_x);
  check_value("V71.speed", std::sqrt(speed * speed + 2.0 * gain / barge_mass), run.bodies().velocity[0].x, 1e-5, "m/s",
              where());
  EXPECT_GT(place, x + 5.0) << "the chain at +x pulls it away";
  expect_closed_books(run, 1e-11);
}

TEST_P(Mooring, V71_a_run_that_goes_on_keeps_its_broken_lines) {
  const SceneDef scene = on_weak_chains(0.5);
  Simulation whole = start(scene, setting()), part = start(scene, setting()), rest = start(scene, setting());
  whole.advance(40);
  part.advance(20);
  EXPECT_EQ(part.engine->broken_lines(), line_at_minus_x);
  rest.engine->restore(part.engine->save());
  rest.advance(20);
  EXPECT_EQ(rest.engine->state_hash(), whole.engine->state_hash());
  EXPECT_NE(hash_of(40, whole.bodies(), 0), whole.engine->state_hash()) << "broken lines are a part of the state";
  expect_closed_books(rest, 1e-11);
}

TEST_P(Mooring, A_run_that_goes_on_has_the_same_bits) {
  SceneDef scene = crowd(setting());
  scene.mooring = {.law = MooringLaw::table, .yaw_stiffness_N_m_per_rad = 1e8, .yaw_damping_N_m_s_per_rad = 1e7};
  scene.mooring_design.force = {{0.01, 0.0}, {1.0, 5e5}};
  expect_restart_changes_nothing(scene, setting());
}

}  // namespace
}  // namespace gem::verification
