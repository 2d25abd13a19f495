// Floes that split against closed form: V90 to V94.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gem/base/random.h"
#include "gem/engine/testing/same_bits.h"
#include "gem/engine/testing/test_scenes.h"
#include "gem/field/field.h"
#include "gem/field/floe_reserve.h"
#include "gem/field/split_floes.h"
#include "validation/verification/scenes.h"

namespace gem::verification {
namespace {

class Breakup : public OnEngines {};
INSTANTIATE_TEST_SUITE_P(Engines, Breakup, ::testing::ValuesIn(all_settings()), setting_name);

/// A floe 80 m x 80 m x 0.5 m of 2592 t that touches the floor or comes down on it.
FloeDef large_floe(double x, double gap, double speed) {
  FloeDef floe;
  floe.outline_m = rectangle(80.0, 80.0);
  floe.position_m = {x, 40.0 + gap};
  floe.velocity_m_per_s = {0.0, -speed};
  floe.thickness_m = 0.5;
  return floe;
}

SceneDef breakup_scene(std::int64_t pieces) {
  SceneDef scene = quiet_scene();
  scene.breakup.maximum_pieces = pieces;
  return scene;
}

std::int64_t splits_of(const StepLog& log) { return test::splits_in(log); }

/// A steady current with a linear drag presses the floe on the floor with m U (1 - exp(-dt / tau)) / dt.
struct Press {
  SceneDef scene = breakup_scene(2);
  double bears, force;

  explicit Press(double load) {
    constexpr double tau = 10.0;
    scene.numerics.time_step_s = 0.01;
    scene.fixed = {{{{-100.0, -10.0}, {100.0, -10.0}, {100.0, 0.0}, {-100.0, 0.0}}}};
    scene.floe = {large_floe(0.0, -touch, 0.0)};
    scene.water.drag_law = DragLaw::linear;
    scene.water.linear_time_s = tau;
    bears = 2.0 * 0.22541976777957312 * 0.5 * 115e3 * std::sqrt(80.0);
    force = load * bears;
    const double mass = scene.ice.density_kg_per_m3 * 6400.0 * 0.5, dt = 0.01;
    scene.current.velocity_m_per_s = {0.0, -force * dt / (mass * (1.0 - std::exp(-dt / tau)))};
  }
};

TEST_P(Breakup, V90_a_pressed_floe_splits_at_the_force_of_the_closed_form) {
  const Press below(0.999), above(1.001);
  Simulation whole = start(below.scene, setting()), split = start(above.scene, setting());
  whole.advance(300);
  split.advance(300);
  check_value("V90.whole", 0.0, double(splits_of(whole.log)), 0.0, "-", where());
  ASSERT_EQ(splits_of(split.log), 1);
  const SplitEvent& event = split.log.splits.front();
  check_value("V90.bears", above.bears, event.splitting_force, rounding * above.bears, "N", where());
  // the first time step closes the contact within the solver's tolerance
  check_value("V90.force", above.force, event.force, 1e-4 * above.force, "N", where());
  check_value("V90.length", 80.0, event.split.length, 1e-9, "m", where());
  check_value("V90.energy", 115e3 * 115e3 / 5e9 * 0.5 * 80.0, event.energy, 1e-9, "J", where());
  const Bodies& b = split.bodies();
  const auto left = static_cast<std::size_t>(event.split.piece[0]);
  EXPECT_FALSE(b.active[static_cast<std::size_t>(event.split.floe)]);
  EXPECT_NEAR(b.area[left], 3200.0, 1e-6);
  EXPECT_NEAR(b.area[left + 1], 3200.0, 1e-6);
  expect_closed_books(split, 1e-12);
}

/// Totals of all active bodies.
struct Totals {
  double mass = 0.0, angular = 0.0, energy = 0.0;
  Vec2 momentum;
  explicit Totals(const Bodies& b) {
    for (std::size_t i = 0; i < b.count(); ++i) {
      if (!b.active[i]) continue;
      const Quantity q = quantity_of(b.mass[i], b.inertia[i], b.position[i], b.velocity[i], b.spin[i]);
      mass += b.mass[i];
      momentum += q.momentum;
      angular += q.angular_momentum;
      energy += q.energy;
    }
  }
};

/// Cracks at random angles through every floe, again and again, until `splits` are made.
struct ManySplits {
  SceneDef scene;
  Bodies bodies;
  std::int64_t made = 0;

  explicit ManySplits(std::int64_t splits) : scene(breakup_scene(2 * splits)) {
    scene.breakup.minimum_size_m = 0.5;
    RandomSequence random(Random(9, 0));
    for (int k = 0; k < 400; ++k) {
      FloeDef floe = large_floe(200.0 * (k % 20), 200.0 * (k / 20), 0.0);
      floe.velocity_m_per_s = {random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)};
      floe.spin_rad_per_s = random.uniform(-0.1, 0.1);
      scene.floe.push_back(floe);
    }
    bodies = make_field(scene);
  }
  void split_all() {
    RandomSequence random(Random(10, 0));
    while (first_unborn(bodies) < bodies.count()) {
      std::vector<FloeCrack> cracks;
      for (std::size_t i = 1; i < first_unborn(bodies); ++i) {
        if (!bodies.active[i]) continue;
        const double angle = 2.0 * std::numbers::pi * random.uniform();
        cracks.push_back({static_cast<std::int32_t>(i), {}, {std::cos(angle), std::sin(angle)}});
      }
      const std::int64_t before = made;
      for (const FloeSplit& split : split_floes(bodies, scene, cracks))
        made += split.result == FloeSplit::Result::split;
      ASSERT_GT(made, before);
    }
  }
};

void check_totals(const std::string& key, std::int64_t splits) {
  ManySplits many(splits);
  const Totals before(many.bodies);
  const std::size_t rows = many.bodies.count();
  many.split_all();
  const Totals after(many.bodies);
  check_value(key + ".splits", double(splits), double(many.made), 0.0, "-");
  check_value(key + ".mass", 0.0, after.mass / before.mass - 1.0, 1e-12, "-");
  const double momentum = before.mass * std::sqrt(2.0 * before.energy / before.mass);
  check_value(key + ".momentum", 0.0, length(after.momentum - before.momentum) / momentum, 1e-12, "-");
  check_value(key + ".angular", 0.0, (after.angular - before.angular) / (4000.0 * momentum), 1e-12, "-");
  check_value(key + ".energy", 0.0, after.energy / before.energy - 1.0, 1e-12, "-");
  // nothing grows beyond the rows that were set aside
  EXPECT_EQ(many.bodies.count(), rows);
  EXPECT_LE(many.bodies.vertex.size(), 400 * 4 + piece_corners_maximum(many.scene));
}

TEST(SplitFloes, V91_pieces_keep_mass_momentum_and_energy) { check_totals("V91", 2000); }

TEST(SplitFloes, V92_a_hundred_thousand_splits_in_the_rows_set_aside) { check_totals("V92", 100000); }

TEST(SplitFloes, V93_any_number_of_threads_and_a_run_in_two_parts_make_the_same_pieces) {
  const SceneDef scene = test::breaking_scene(5);
  const Bodies field = test::busy_field(scene);
  const auto run = [&](int threads, std::int64_t first) {
    EngineOptions options;
    options.threads = threads;
    StepLog log;
    auto engine = make_engine(scene, field, options);
    engine->advance(first, log);
    if (first < 403) {  // within a half load time
      const EngineState state = engine->save();
      engine = make_engine(scene, state.bodies, options);
      engine->restore(state);
      engine->advance(403 - first, log);
    }
    EXPECT_GT(splits_of(log), 4);
    return engine->state_hash();
  };
  const std::uint64_t whole = run(1, 403);
  check_value("V93.threads", 0.0, double(whole != run(2, 403)) + double(whole != run(3, 403)), 0.0, "differ");
  check_value("V93.parts", 0.0, double(whole != run(1, 201)) + double(whole != run(2, 203)), 0.0, "differ");
}

TEST_P(Breakup, CracksHaveAnEntryInTheBooks) {
  const SceneDef scene = test::breaking_scene(5);
  auto engine = test::busy_engine(scene, setting().engine, 1);
  StepLog log;
  double cracks = 0.0;
  for (int k = 0; k < 40; ++k) {
    log.clear();
    engine->advance(10, log);
    for (const SplitEvent& one : log.splits) cracks += one.energy;
    const Ledger books = engine->ledger();
    EXPECT_NEAR(books.crack_energy, -cracks, 1e-12 * cracks);
    EXPECT_LE(residual(books).energy, 1e-12);
  }
  EXPECT_GT(cracks, 0.0);
}

/// In a time step with a split the forces name the pieces, which take part; the floe does not.
TEST_P(Breakup, ForcesOfATimeStepWithASplitNameThePieces) {
  const SceneDef scene = test::breaking_scene(5);
  auto engine = test::busy_engine(scene, setting().engine, 1);
  StepLog log;
  std::size_t with_forces = 0;
  for (int k = 0; k < 400; ++k) {
    log.clear();
    engine->advance(1, log);
    const std::vector<ContactForce> forces = engine->contact_forces();
    const Bodies& b = engine->bodies();
    for (std::size_t i = 0; i < forces.size(); ++i) {
      EXPECT_TRUE(b.active[static_cast<std::size_t>(forces[i].a)] && b.active[static_cast<std::size_t>(forces[i].b)]);
      EXPECT_LT(forces[i].a, forces[i].b);
      if (i > 0) {
        EXPECT_LE(forces[i - 1].a, forces[i].a);
      }
    }
    with_forces += splits_of(log) > 0 && !forces.empty();
  }
  EXPECT_GT(with_forces, 0u);
}

/// Without room for the corners of pieces one row says so, and no floe splits any more.
TEST_P(Breakup, NoRoomIsSaidOnce) {
  SceneDef scene = test::breaking_scene(5);
  scene.breakup.maximum_pieces = 6;
  Bodies field = test::busy_field(scene);
  auto engine = make_engine(scene, field, {setting().engine, 1});
  EngineState state = engine->save();
  // fills the corners: a piece with all of them, as after many splits of floes with many corners
  const std::size_t first = first_piece(state.bodies, scene);
  for (std::size_t k = 0; k + 3 < piece_corners_maximum(scene); ++k) state.bodies.vertex.push_back({});
  for (std::size_t i = first + 1; i < state.bodies.vertex_begin.size(); ++i)
    state.bodies.vertex_begin[i] = static_cast<std::int32_t>(state.bodies.vertex.size());
  engine = make_engine(scene, state.bodies, {setting().engine, 1});
  StepLog log;
  engine->advance(400, log);
  EXPECT_EQ(splits_of(log), 0);
  ASSERT_FALSE(log.splits.empty());
  for (const SplitEvent& one : log.splits) EXPECT_EQ(one.time, log.splits.front().time);
}

/// Eighty floes come down side by side with 2 mm/s, 4 mm/s and so on; those faster than F_split T / m split.
TEST_P(Breakup, V94_the_number_of_splits_does_not_depend_on_the_time_step) {
  for (const double dt : {0.1, 0.05, 0.025, 0.0125}) {
    SceneDef scene = breakup_scene(400);
    scene.numerics.time_step_s = dt;
    scene.fixed = {{{{-200.0, -10.0}, {17000.0, -10.0}, {17000.0, 0.0}, {-200.0, 0.0}}}};
    RandomSequence random(Random(11, 0));
    for (int k = 1; k <= 80; ++k)
      scene.floe.push_back(large_floe(200.0 * k, (0.002 * k) * random.uniform(0.0, 5.0), 0.002 * k));
    Simulation run = start(scene, setting());
    run.advance(std::llround(8.0 / dt));
    const double mass = scene.ice.density_kg_per_m3 * 6400.0 * 0.5;
    const double least = 2.0 * 0.22541976777957312 * 0.5 * 115e3 * std::sqrt(80.0) * 1.0 / mass;
    const double expected = 80.0 - std::floor(least / 0.002);
    check_value("V94.splits", expected, double(splits_of(run.log)), 0.0, "-", where());
    expect_closed_books(run, 1e-12);
  }
}

}  // namespace
}  // namespace gem::verification
