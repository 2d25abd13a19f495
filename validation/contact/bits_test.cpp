// The same bits for any number of threads, after a restart, with and without records, and whatever moves far away.
#include <gtest/gtest.h>

#include <cmath>

#include "gem/base/random.h"
#include "validation/contact/scenes.h"

namespace gem::hits {
namespace {

/// Floes of several shapes that the current drives on a moored platform between walls.
SceneDef small_crowd(int count, std::uint64_t seed = 1) {
  SceneDef scene = open_scene();
  scene.water = {};
  scene.current.velocity_m_per_s = {0.5, 0.05};
  scene.ice.friction_ice = 0.35;
  scene.ice.friction_structure = 0.1;
  scene.platform.present = true;
  scene.platform.diameter_m = 24.0;
  scene.platform.mass_kg = 1e6;
  scene.mooring.stiffness_N_per_m = 5e4;
  scene.fixed = {{{{-96.0, 20.0}, {32.0, 19.0}, {32.0, 40.0}, {-96.0, 40.0}}},
                 {{{-96.0, -40.0}, {32.0, -40.0}, {32.0, -19.0}, {-96.0, -20.0}}}};
  RandomSequence numbers(Random(seed, 2));
  for (int k = 0; k < count; ++k) {
    const int sides = 4 + static_cast<int>(numbers.below(4));
    const double x = -18.0 - 9.0 * (k / 4), y = -13.0 + 8.7 * (k % 4);
    FloeDef floe =
        floe_of(turned_by(regular(sides, numbers.uniform(2.5, 4.2)), numbers.uniform(0.0, 6.0)), {x, y},
                {0.4 * numbers.uniform(), 0.1 * numbers.uniform(-1.0, 1.0)}, 0.05 * numbers.uniform(-1.0, 1.0));
    floe.thickness_m = numbers.uniform(0.4, 1.2);
    scene.floe.push_back(floe);
  }
  return scene;
}

std::uint64_t hash_after(Trial& run, std::int64_t steps) {
  run.advance(steps);
  EXPECT_GT(run.engine->ledger().contact.load, 0.0);
  return run.engine->state_hash();
}

TEST(ContactBits, threads_change_none) {
  const SceneDef scene = small_crowd(24);
  Trial one(scene, 1), two(scene, 2);
  EXPECT_EQ(hash_after(one, 200), hash_after(two, 200));
}

TEST(ContactBits, records_change_none) {
  const SceneDef scene = small_crowd(24);
  Trial quiet(scene), told(scene);
  quiet.log.wants_events = false;
  told.log.wants_forces = true;
  EXPECT_EQ(hash_after(quiet, 600), hash_after(told, 600));
}

TEST(ContactBits, save_and_ledger_change_none) {
  const SceneDef scene = small_crowd(24);
  Trial quiet(scene), read(scene);
  for (int k = 0; k < 300; ++k) {
    read.advance();
    read.engine->ledger();
    read.engine->save();
  }
  EXPECT_EQ(hash_after(quiet, 300), hash_after(read, 0));
}

/// Restarts at every of `count` time steps from `first` on, and compares at the end.
void expect_restarts(const SceneDef& scene, int first, int count, int end) {
  Trial whole(scene);
  whole.advance(first);
  std::vector<EngineState> states;
  for (int k = 0; k < count; ++k) {
    states.push_back(whole.engine->save());
    whole.advance();
  }
  whole.advance(end - first - count);
  const ContactEnergy books = whole.engine->ledger().contact;
  for (int k = 0; k < count; ++k) {
    Trial rest(scene);
    rest.engine->restore(states[k]);
    rest.advance(end - first - k);
    EXPECT_EQ(rest.engine->state_hash(), whole.engine->state_hash()) << "restart at time step " << first + k;
    EXPECT_EQ(rest.engine->ledger().contact.crushed, books.crushed);
    EXPECT_EQ(rest.engine->ledger().contact.stored, books.stored);
  }
}

TEST(ContactBits, restart_in_the_middle_of_a_hit) {
  SceneDef scene = open_scene();
  add_wall(scene);
  scene.ice.friction_structure = 0.1;
  scene.floe = {floe_of(rhombus(10.0, 0.5 * M_PI), {-7.1, 1.0}, {0.5, 0.1}, 0.05)};
  scene.numerics.time_step_s = 0.02;
  expect_restarts(scene, 0, 30, 60);
}

TEST(ContactBits, restart_in_a_crowd) { expect_restarts(small_crowd(24), 300, 10, 400); }

TEST(ContactBits, a_distant_body_changes_none) {
  SceneDef scene = small_crowd(16);
  scene.numerics.substeps = 64;
  const FloeDef far = floe_of(rectangle(8.0, 8.0), {-90.0, 80.0}, {0.1, 0.0}, 0.02);
  const auto bits_with = [&](Vec2 moved) {
    SceneDef moved_scene = scene;
    moved_scene.floe.push_back(far);
    moved_scene.floe.back().position_m += moved;
    return std::make_unique<Trial>(moved_scene);
  };
  const auto here = bits_with({}), there = bits_with({-3.0, 17.0});
  here->advance(600);
  there->advance(600);
  EXPECT_GT(here->engine->ledger().contact.load, 0.0);
  const std::size_t first = first_floe(here->bodies());
  for (std::size_t i = 0; i + 1 < here->bodies().count(); ++i)
    EXPECT_TRUE(same_bits(here->bodies(), i, there->bodies(), i)) << i << " of floes from " << first;
}

TEST(ContactBits, corner_that_hits_after_another_has_left_meets_fresh_ice) {
  SceneDef scene = open_scene();
  scene.water = {};
  scene.current.velocity_m_per_s = {0.5, 0.0};
  add_wall(scene);
  scene.floe = {floe_of(turned_by(rectangle(10.0, 10.0), 0.5), {-7.2, 0.0}, {0.5, 0.0}, 0.2)};
  Trial run(scene);
  while (!(run.engine->ledger().contact.load > 0.0)) run.advance();
  while (!run.engine->save().corner_key.empty()) run.advance();
  const double load = run.engine->ledger().contact.load;
  Trial fresh(scene);
  EngineState start = fresh.engine->save();
  start.bodies = run.engine->save().bodies;
  fresh.engine->restore(start);
  run.log.clear();
  run.advance(600);
  fresh.advance(600);
  EXPECT_GT(run.engine->ledger().contact.load, load) << "the next corner hits";
  EXPECT_TRUE(same_bits(run.bodies(), first_floe(run.bodies()), fresh.bodies(), first_floe(fresh.bodies())));
  EXPECT_EQ(peak_of(run.log).force, peak_of(fresh.log).force);
}

/// What the books leave, as a share of what the contacts took, after 60 s of a small crowd.
double left_share(std::int64_t substeps, std::uint64_t seed) {
  SceneDef scene = small_crowd(24, seed);
  scene.numerics.substeps = substeps;
  Trial run(scene);
  run.log.wants_events = false;
  run.advance_for(scene, 60.0);
  const ContactEnergy books = run.engine->ledger().contact;
  EXPECT_GT(books.crushed, 0.0);
  return books.left() / (books.crushed + books.damped + books.friction);
}

TEST(ContactBooks, left_below_1_percent_in_a_small_crowd) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) EXPECT_LT(std::fabs(left_share(0, seed)), 0.01) << seed;
}

TEST(ContactBooks, left_falls_at_least_in_proportion_to_the_substep) {
  const double coarse = std::fabs(left_share(64, 1)), fine = std::fabs(left_share(256, 1));
  EXPECT_LT(fine, coarse / 4.0);
}

TEST(ContactBooks, a_thin_row_at_rest_leaves_nothing) {
  SceneDef scene = open_scene();
  scene.water = {};
  scene.current.velocity_m_per_s = {0.5, 0.0};
  scene.fixed = {wall_body()};
  for (int k = 0; k < 4; ++k) scene.floe.push_back(floe_of(rectangle(10.0, 10.0), {-5.0 - 10.0001 * k, 0.1 * (k % 2)}));
  for (FloeDef& floe : scene.floe) floe.thickness_m = 0.02;
  Trial run(scene);
  run.log.wants_events = false;
  run.advance_for(scene, 60.0);
  const ContactEnergy before = run.engine->ledger().contact;
  run.advance_for(scene, 240.0);
  const ContactEnergy after = run.engine->ledger().contact;
  EXPECT_LT(std::fabs(after.left() - before.left()), 0.01 * (after.stored + after.damped));
}

}  // namespace
}  // namespace gem::hits
