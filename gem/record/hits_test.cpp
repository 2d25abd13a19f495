// Rows of time steps joined to hits.
#include "gem/record/hits.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/engine/testing/test_scenes.h"

namespace gem {
namespace {

constexpr double dt = 0.1;
constexpr HitRule rule{3.0, 0.01};

ContactEvent row(std::int64_t step, std::int32_t body, double closing_speed = 0.2) {
  ContactEvent event;
  event.time = static_cast<double>(step) * dt;
  event.body_b = body;
  event.closing_speed = closing_speed;
  event.impulse_normal = 2.0;
  event.impulse_tangential = -1.0;
  event.depth = 1e-3 * static_cast<double>(step);
  event.largest_force = step == 6 ? 7e3 : 5e3;
  return event;
}

std::vector<Hit> hits_of(const std::vector<ContactEvent>& rows, std::int64_t steps, HitRule with = rule) {
  Hits hits(with, dt);
  std::vector<Hit> ended;
  hits.add(rows, steps, ended);
  hits.end_all(ended);
  return ended;
}

TEST(Hits, OneHitLastsUntilRelease) {
  const std::vector<Hit> hits = hits_of({row(5, 3), row(6, 3, 1e-4), row(20, 3, 0.9)}, 100);
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_DOUBLE_EQ(hits[0].first.time, 0.5);
  EXPECT_EQ(hits[0].first.closing_speed, 0.2);
  EXPECT_EQ(hits[0].impulse_normal, 6.0);
  EXPECT_EQ(hits[0].impulse_tangential, -3.0);
  EXPECT_EQ(hits[0].depth, 20e-3);
  EXPECT_EQ(hits[0].largest_force, 7e3);
  EXPECT_DOUBLE_EQ(hits[0].duration, 1.6);
}

TEST(Hits, AFloeThatWasReleasedHitsAnew) {
  // the time step that ends at 0.6 s is the last that presses
  EXPECT_EQ(hits_of({row(5, 3), row(35, 3)}, 100).size(), 1u) << "2.9 s later";
  EXPECT_EQ(hits_of({row(5, 3), row(36, 3)}, 100).size(), 2u) << "3 s later";
}

TEST(Hits, WithoutReleaseEveryTimeStepIsAHit) {
  EXPECT_EQ(hits_of({row(5, 3), row(6, 3), row(7, 3)}, 100, {0.0, 0.01}).size(), 3u);
}

/// A floe that presses in every time step of [0, 60), hardest in steps 40 to 43.
std::vector<ContactEvent> long_hit() {
  std::vector<ContactEvent> rows;
  for (std::int64_t step = 0; step < 60; ++step) {
    rows.push_back(row(step, 3));
    if (step >= 40 && step < 44) rows.back().impulse_normal = 50.0;
  }
  return rows;
}

TEST(Hits, TheHardestForceWindowIsKept) {
  const std::vector<Hit> hits = hits_of(long_hit(), 100, {3.0, 0.01, 0.4});
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_DOUBLE_EQ(hits[0].window_impulse, 200.0);
  EXPECT_DOUBLE_EQ(hits[0].window_end, 4.4);
  EXPECT_DOUBLE_EQ(hits[0].impulse_normal, 200.0 + 56 * 2.0);
}

TEST(Hits, ALongForceWindowMovesInParts) {
  // 40 steps in parts of 3: 14 parts, 42 steps
  const std::vector<Hit> hits = hits_of(long_hit(), 100, {3.0, 0.01, 4.0});
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_DOUBLE_EQ(hits[0].window_impulse, 200.0 + 38 * 2.0);
  EXPECT_GE(hits[0].window_end, 4.4);
}

TEST(Hits, AForceWindowIsOfOneHit) {
  std::vector<ContactEvent> rows = {row(5, 3), row(36, 3), row(37, 4)};
  rows[0].impulse_normal = 9.0;
  const std::vector<Hit> hits = hits_of(rows, 100, {3.0, 0.01, 5.0});
  ASSERT_EQ(hits.size(), 3u);
  EXPECT_DOUBLE_EQ(hits[0].window_impulse, 9.0);
  EXPECT_DOUBLE_EQ(hits[1].window_impulse, 2.0);
  EXPECT_DOUBLE_EQ(hits[2].window_impulse, 2.0);
}

TEST(Hits, AGentleFirstTouchIsNoHit) {
  EXPECT_TRUE(hits_of({row(5, 3, 0.01), row(6, 3, 0.5)}, 100).empty());
  EXPECT_EQ(hits_of({row(5, 3, 0.0101)}, 100).size(), 1u);
}

TEST(Hits, BlocksOfTimeStepsChangeNothing) {
  SceneDef scene = test::busy_scene(8);
  scene.output.hit_release_s = 0.5;
  const auto engine = test::busy_engine(scene, "cpu");
  StepLog log;
  constexpr std::int64_t steps = 400;
  engine->advance(steps, log);
  const double step_length = scene.numerics.time_step_s;
  const auto joined = [&](std::int64_t block) {
    Hits hits({scene.output.hit_release_s, 0.0}, step_length);
    std::vector<Hit> ended;
    for (std::int64_t done = block; done <= steps; done += block) {
      std::vector<ContactEvent> rows;
      for (const ContactEvent& event : log.events) {
        const std::int64_t step = std::llround(event.time / step_length);
        if (step >= done - block && step < done) rows.push_back(event);
      }
      hits.add(rows, done, ended);
    }
    hits.end_all(ended);
    return ended;
  };
  const std::vector<Hit> whole = joined(steps), single = joined(1);
  ASSERT_GT(whole.size(), 2u);
  EXPECT_LT(whole.size(), log.events.size());
  ASSERT_EQ(whole.size(), single.size());
  for (std::size_t k = 0; k < whole.size(); ++k) {
    EXPECT_EQ(whole[k].first.time, single[k].first.time) << k;
    EXPECT_EQ(whole[k].first.body_b, single[k].first.body_b) << k;
    EXPECT_EQ(whole[k].impulse_normal, single[k].impulse_normal) << k;
    EXPECT_EQ(whole[k].duration, single[k].duration) << k;
  }
}

}  // namespace
}  // namespace gem
