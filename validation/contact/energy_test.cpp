// Hits create no energy, whatever the masses, levers and substeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/base/random.h"
#include "validation/contact/scenes.h"

namespace gem::hits {
namespace {

/// A convex outline of 3 to 7 corners within `radius` [m].
std::vector<Vec2> random_outline(RandomSequence& numbers, double radius) {
  const int sides = 3 + static_cast<int>(numbers.below(5));
  std::vector<Vec2> outline;
  for (int k = 0; k < sides; ++k) {
    const double angle = 2.0 * M_PI * (k + numbers.uniform(0.0, 0.7)) / sides;
    outline.push_back({radius * std::cos(angle), radius * std::sin(angle)});
  }
  return outline;
}

/// Size ratio 1 to 100 and thickness ratio 1 to 100: masses differ by up to 1e6.
FloeDef random_floe(RandomSequence& numbers) {
  const double radius = 5.0 * std::pow(10.0, -2.0 * numbers.uniform());
  FloeDef floe = floe_of(random_outline(numbers, radius), {});
  if (numbers.below(4) == 0)
    floe.outline_m = turned_by(rectangle(2.0 * radius, 0.2 * radius), numbers.uniform(0.0, 6.0));
  floe.thickness_m = 2.0 * std::pow(10.0, -2.0 * numbers.uniform());
  floe.velocity_m_per_s = {numbers.uniform(-1.0, 1.0), numbers.uniform(-1.0, 1.0)};
  floe.spin_rad_per_s = numbers.uniform(-1.0, 1.0) * std::min(0.5, 0.5 / radius);
  return floe;
}

double radius_of(const FloeDef& floe) {
  double radius = 0.0;
  for (const Vec2 corner : floe.outline_m) radius = std::max(radius, length(corner));
  return radius;
}

/// Two to four floes on a line with little room between, the outer ones closing; sometimes with a wall behind.
SceneDef random_chain(RandomSequence& numbers, int most) {
  SceneDef scene = open_scene();
  scene.ice.friction_ice = numbers.below(3) ? numbers.uniform() : 0.0;
  scene.contact.crushing_limit = numbers.below(3) > 0;
  scene.contact.damping_ratio = numbers.uniform(0.1, 1.0);
  scene.numerics.time_step_s = numbers.below(2) ? 0.1 : 0.02;
  scene.numerics.substeps = 1 + static_cast<std::int64_t>(numbers.below(32));
  const int count = 2 + static_cast<int>(numbers.below(static_cast<std::size_t>(most - 1)));
  double edge = 0.0;
  for (int k = 0; k < count; ++k) {
    FloeDef floe = random_floe(numbers);
    const double radius = radius_of(floe);
    floe.position_m = {edge - radius - 1e-3 - 0.05 * numbers.uniform(), 0.3 * radius * numbers.uniform(-1.0, 1.0)};
    floe.velocity_m_per_s.x = k == count - 1 ? numbers.uniform(0.2, 1.0) : k == 0 ? numbers.uniform(-1.0, 0.1) : 0.0;
    edge = floe.position_m.x - radius;
    scene.floe.push_back(floe);
  }
  if (numbers.below(2)) scene.fixed = {wall_body()};
  return scene;
}

/// Largest kinetic energy of a run over that of its start.
double largest_gain(const SceneDef& scene, double time) {
  Trial run(scene);
  run.log.wants_events = false;
  const double start = kinetic(run.bodies());
  double most = 0.0;
  for (double t = 0.0; t < time; t += scene.numerics.time_step_s) {
    run.advance();
    most = std::max(most, kinetic(run.bodies()) / start - 1.0);
  }
  return most;
}

/// Number of chains of up to `most` floes that gain energy.
int gains(int hits, int most, std::uint64_t seed) {
  RandomSequence numbers(Random(seed, 1));
  int gained = 0;
  double worst = 0.0;
  for (int k = 0; k < hits; ++k) {
    const double gain = largest_gain(random_chain(numbers, most), 3.0);
    worst = std::max(worst, gain);
    gained += gain > 1e-9;
  }
  EXPECT_LE(worst, 1e-9) << "largest gain, of the energy before";
  return gained;
}

TEST(ContactEnergy, single_hits_gain_none) { EXPECT_EQ(gains(500, 2, 3), 0); }
TEST(ContactEnergy, short_chains_gain_none) { EXPECT_EQ(gains(300, 4, 4), 0); }
TEST(LongContactEnergy, single_hits_gain_none) { EXPECT_EQ(gains(100000, 2, 5), 0); }
TEST(LongContactEnergy, short_chains_gain_none) { EXPECT_EQ(gains(20000, 4, 6), 0); }

/// One to four floes thrown into a notch of three pieces.
SceneDef random_notch(RandomSequence& numbers) {
  SceneDef scene = random_chain(numbers, 4);
  scene.fixed.clear();
  scene.ice.friction_structure = numbers.uniform();
  scene.platform.present = true;
  scene.platform.fixed = true;
  scene.platform.outline = PlatformOutline::pieces;
  const double tilt = numbers.uniform(-1.5, 1.5);
  scene.platform.piece = {{{{0.0, -8.0}, {4.0, -8.0}, {4.0, 8.0}, {0.0, 8.0}}},
                          {{{-8.0, 4.0}, {0.0, 4.0 + tilt}, {0.0, 8.0}, {-8.0, 8.0}}},
                          {{{-8.0, -8.0}, {0.0, -8.0}, {0.0, -4.0 - tilt}, {-8.0, -4.0}}}};
  double edge = -9.0;
  for (FloeDef& floe : scene.floe) {
    const double radius = radius_of(floe);
    floe.position_m = {edge - radius, numbers.uniform(-2.0, 2.0)};
    floe.velocity_m_per_s = {numbers.uniform(0.5, 1.5), numbers.uniform(-0.5, 0.5)};
    edge -= 2.0 * radius + 0.02;
  }
  return scene;
}

int notch_gains(int scenes, std::uint64_t seed) {
  RandomSequence numbers(Random(seed, 1));
  int gained = 0;
  for (int k = 0; k < scenes; ++k) gained += largest_gain(random_notch(numbers), 12.0) > 1e-9;
  return gained;
}

TEST(ContactEnergy, floes_in_a_notch_gain_none) { EXPECT_EQ(notch_gains(200, 9), 0); }
TEST(LongContactEnergy, floes_in_a_notch_gain_none) { EXPECT_EQ(notch_gains(10000, 10), 0); }

/// A floe with twelve sides among twelve slivers and twelve triangles that close on it, before a wall.
SceneDef dense_scene(RandomSequence& numbers) {
  SceneDef scene = open_scene();
  scene.ice.friction_ice = numbers.uniform();
  if (numbers.below(2)) {
    scene.water = {};
    scene.current.velocity_m_per_s = {numbers.uniform(0.2, 1.0), 0.0};
  }
  if (numbers.below(2)) scene.numerics.substeps = 4 + static_cast<std::int64_t>(numbers.below(60));
  if (numbers.below(2)) scene.fixed = {{{{4.5, -20.0}, {9.0, -20.0}, {9.0, 20.0}, {4.5, 20.0}}}};
  scene.floe.push_back(floe_of(regular(12, 2.0), {}, {}, numbers.uniform(-0.2, 0.2)));
  const auto around = [&](double radius, int k, std::vector<Vec2> outline) {
    const double angle = 2.0 * M_PI * (k + 0.5) / 12.0;
    const Vec2 out{std::cos(angle), std::sin(angle)};
    FloeDef floe =
        floe_of(turned_by(outline, angle), radius * out, -numbers.uniform(0.1, 1.0) * out, numbers.uniform(-0.3, 0.3));
    floe.thickness_m = std::pow(10.0, -2.0 * numbers.uniform());
    scene.floe.push_back(floe);
  };
  for (int k = 0; k < 12; ++k) around(2.25, k, rectangle(0.04 + 0.1 * numbers.uniform(), 0.9));
  for (int k = 0; k < 12; ++k) around(3.2, k, regular(3, 0.6));
  return scene;
}

/// Largest energy that the contacts of dense scenes give, over the energy at the start and the work of the loads.
double dense_gain(int scenes, std::uint64_t seed) {
  RandomSequence numbers(Random(seed, 1));
  double worst = -1.0;
  for (int k = 0; k < scenes; ++k) {
    const SceneDef scene = dense_scene(numbers);
    Trial run(scene);
    run.log.wants_events = false;
    const double start = kinetic(run.bodies());
    double gain = -1.0;
    for (int step = 0; step < 100; ++step) {
      run.advance();
      const Ledger ledger = run.engine->ledger();
      const double given = start + std::max(0.0, ledger[Channel::drag].energy);
      gain = std::max(gain, (ledger.contact.work + ledger.contact.stored) / given);
    }
    worst = std::max(worst, gain);
  }
  return worst;
}

TEST(ContactEnergy, dense_scenes_gain_none) { EXPECT_LE(dense_gain(30, 7), 0.01); }
TEST(LongContactEnergy, dense_scenes_gain_none) { EXPECT_LE(dense_gain(1000, 8), 0.01); }

/// Floes of 10 m in a row with 2 mm between; the first hits the rest, which are reached within one time step. Every
/// other one is `aside` [m]; 0: their corners are exactly in line.
void expect_row_is_hit(double aside) {
  SceneDef scene = open_scene();
  for (int k = 0; k < 4; ++k) scene.floe.push_back(floe_of(rectangle(10.0, 10.0), {-10.002 * k, aside * (k % 2)}));
  scene.floe.back().velocity_m_per_s = {1.0, 0.0};
  Trial run(scene);
  const double start = kinetic(run.bodies());
  double most = 0.0, deepest = 0.0;
  for (int k = 0; k < 50; ++k) {
    run.advance();
    most = std::max(most, kinetic(run.bodies()) / start - 1.0);
    deepest = std::max(deepest, run.log.quality.back().maximum_overlap);
  }
  EXPECT_LE(most, 1e-9);
  EXPECT_GT(run.bodies().velocity[first_floe(run.bodies())].x, 0.3) << "the hit goes through the row";
  const double spring = std::sqrt(0.5 * run.bodies().mass[first_floe(run.bodies())] / scene.contact.face_stiffness_Pa);
  // v sqrt(m / (2 K)) for the first pair, with v = 1 m/s and ice of 1 m
  EXPECT_GT(deepest, 0.5 * spring);
  EXPECT_LT(deepest, 1.2 * spring);
}

TEST(ContactEnergy, hits_that_follow_within_a_time_step_are_found) {
  for (const double aside : {0.0, 1e-12, 1e-10, 1e-9, 1e-8, 1e-6, 1e-3, 0.1, 5.0}) {
    SCOPED_TRACE(aside);
    expect_row_is_hit(aside);
  }
}

/// A platform of 1e8 kg squeezes a floe of 2 m on a wall: a corner of the platform lies deep in its face, and the
/// floe's corners between two sides of the platform.
TEST(ContactEnergy, squeezed_floe_gives_no_more_than_its_spring_held) {
  SceneDef scene = open_scene();
  scene.ice.friction_ice = 0.35;
  scene.ice.friction_structure = 0.1;
  scene.platform.present = true;
  scene.platform.anchor_m = {-52.1, 0.0};
  scene.platform.start_velocity_m_per_s = {0.1, 0.0};
  scene.mooring.stiffness_N_per_m = 0.0;
  scene.numerics.time_step_s = 0.05;
  scene.fixed = {wall_body()};
  scene.floe = {floe_of(rectangle(2.0, 2.0), {-1.0, 0.0})};
  scene.floe[0].thickness_m = 0.5;
  Trial run(scene);
  run.log.wants_events = false;
  const auto energy = [&] { return run.engine->ledger().now.energy; };
  const double start = energy();
  double least = start, held = 0.0;
  for (int k = 0; k < 400; ++k) {
    run.advance();
    const ContactEnergy books = run.engine->ledger().contact;
    EXPECT_LT(std::fabs(books.left()), 1e-3 * start) << k;
    if (energy() < least) least = energy(), held = books.stored;
  }
  EXPECT_LT(least, 0.01 * start);
  EXPECT_LT(energy(), least + 1.01 * held);
}

}  // namespace
}  // namespace gem::hits
