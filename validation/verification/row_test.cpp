// Rows of floes: columns pressed against a wall or the platform, and jams that grow floe by floe (V33, V34, V38, V47).
#include <algorithm>
#include <cmath>

#include "gem/field/check_field.h"
#include "validation/verification/expected.h"
#include "validation/verification/pressed.h"

namespace gem::verification {
namespace {

class Row : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Row, ::testing::ValuesIn(all_settings()), setting_name);

/// V33 and V34 for independent without elastic stress. In each time step a contact transmits M_e times its closing
/// speed. So the row creeps at the speed at which the closing speeds carry the push: contact j from the wall closes at
/// 2 (sum of the pushes behind it) dt / m, the contact at the wall at half of that. The drag follows the creep.
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

/// V33 and V34: `count` touching squares, each pushed along x by 562.5 N.
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

TEST_P(Row, V33_column_on_a_wall) {
  const double dt = 0.01, k = 0.05, speed = 0.5;
  for (const int count : {1, 10}) {
    SceneDef scene = column(count, dt);
    scene.fixed = {{{{-touch, -20.0}, {5.0, -20.0}, {5.0, 20.0}, {-touch, 20.0}}}};
    Simulation run = start(scene, setting());
    run.advance(5900);
    const double force = -force_of_fixed(run, 100, dt).x;
    const std::string key = count == 1 ? "V33.d" : "V33.F10";
    if (setting().coupled() || count == 1) {
      // The push of every floe falls short by the same share.
      check(key, force, drag_shortfall(k, speed, dt) + 1e-6, where());
      check_value(key + ".overlap", 0.0, total_overlap(run.bodies()), 1e-3, "m", where());
    } else {
      // The row still loses speed where it creeps together: 1 % of the 3 % that the creep costs.
      const double creeping = creeping_force(count, dt);
      check_value("V33.F10.creeping", creeping, force, 1e-3 * creeping, "N", where());
      EXPECT_GT(total_overlap(run.bodies()), 1e-3) << "independent holds the column as well";
    }
    expect_held_books(run, 100.0);
  }
}

TEST_P(Row, V34_column_on_the_moored_platform) {
  const double dt = 0.05;
  SceneDef scene = column(10, dt);
  scene.numerics.residual_tolerance = 1e-9;
  scene.platform.present = true;
  scene.platform.anchor_m = {50.0 - touch, 0.0};
  scene.mooring.damping_ratio = 0.5;
  Simulation run = start(scene, setting());
  run.log.wants_events = false;
  // Half of critical damping: e^-14 of the oscillation is left after 400 s.
  run.advance(8000);
  EXPECT_GT(run.log.platform.back().contacts, 0);
  if (setting().coupled()) {
    check("V34.offset", run.bodies().position[0].x - 50.0, drag_shortfall(0.05, 0.5, dt) + 2e-6, where());
  } else {
    const double creeping = creeping_force(10, dt) / scene.mooring.stiffness_N_per_m;
    check_value("V34.offset.creeping", creeping, run.bodies().position[0].x - 50.0, 1e-2 * creeping, "m", where());
  }
}

/// A row that drifts onto a wall: when its floes are hit, and the impulse on the wall.
struct Jam {
  double first = 0.0, last = 0.0;  // times at which the first and the last floe are hit [s]
  double impulse = 0.0;            // on the wall by all impacts but the first [N s]
  double strays = 0.0;             // speed left at the end [m/s]
};

Jam jam_in_a_row(double pitch, int count, const Setting& setting) {
  const double dt = 0.02, speed = 0.25;
  SceneDef scene = quiet_scene();
  scene.numerics.time_step_s = dt;
  scene.fixed = {{{{0.0, -20.0}, {5.0, -20.0}, {5.0, 20.0}, {0.0, 20.0}}}};
  for (int i = 0; i < count; ++i) scene.floe.push_back(square({10.0 - (i + 1) * pitch, 0.0}, {speed, 0.0}));
  Simulation run = start(scene, setting);
  run.log.wants_events = false;
  Jam jam;
  const auto steps = static_cast<std::int64_t>((count + 1) * (pitch - 10.0) / speed / dt) + 4000;
  for (std::int64_t i = 0; i < steps; ++i) {
    run.advance(1);
    const double now = static_cast<double>(run.engine->step()) * dt;
    if (jam.first == 0.0 && run.bodies().velocity[2].x < speed) jam.first = now;
    if (jam.last == 0.0 && run.bodies().velocity[static_cast<std::size_t>(count) + 1].x < speed) jam.last = now;
  }
  // All impacts are equal; the first one opens the observed time and is not counted.
  jam.impulse = -run.engine->ledger()[Channel::impact].momentum.x * (count - 1) / count;
  for (std::size_t i = 2; i < run.bodies().count(); ++i)
    jam.strays = std::max(jam.strays, length(run.bodies().velocity[i]));
  expect_closed_books(run, 1e-12);
  return jam;
}

TEST_P(Row, V38_one_dimensional_jam) {
  const int count = 10;
  const Jam jam = jam_in_a_row(25.0, count, setting());
  const double time = jam.last - jam.first;
  // Each hit is seen up to one time step late. Independent: a row that is hit takes row x dt / (1 - cos(pi / (row +
  // 1))) to transmit its momentum, and creeps at up to 1 / row of the speed meanwhile.
  double late = 2.0 * 0.02;
  if (!setting().coupled())
    for (int row = 2; row <= count; ++row) late += 0.02 / (1.0 - std::cos(M_PI / (row + 1)));
  check("V38.front", 10.0 * (count - 1) / time, late / time, where());
  check("V38.Fmean", jam.impulse / time, late / time, where());
  check_value("V38.rest", 0.0, jam.strays, 1e-6, "m/s", where());
}

TEST_P(Row, V47_a_plug_that_jams_at_nine_tenths) {
  // Squares of 10 m in lanes of 11.1 m: touching, they cover 0.9 of their lane; at a pitch of 22.5 m, 0.4.
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
