// Iterations by operator splitting: a row at a wall, islands, a crowd.
#include "bench/splitting/splitting_engine.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "gem/engine/testing/test_scenes.h"

namespace gem::bench {
namespace {

constexpr double mass = 2e4, inertia = 1e5, speed = 0.5;

/// A row of bodies that runs into a wall on its left, each with one point towards its left neighbour.
struct Row {
  std::vector<IslandBody> bodies;
  std::vector<PointGeometry<double>> geometry;
  std::vector<PointImpulse<double>> impulse;

  Row(int count, double offset) : geometry(count), impulse(count) {
    for (int i = 0; i < count; ++i)
      bodies.push_back({{offset + i, 0.0}, {-speed, 0.1 * speed}, 0.0, 1.0 / mass, 1.0 / inertia});
    for (PointGeometry<double>& g : geometry) {
      g.normal_x = 1.0;
      g.friction = 0.3;
      g.cap = 1e30;
    }
  }

  void add_to(SplitIteration& iteration, std::int32_t body, std::int32_t point) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const auto k = static_cast<std::int32_t>(i);
      iteration.set_body(body + k, bodies[i]);
      iteration.set_point(point + k,
                          {k == 0 ? SplitIteration::fixed : body + k - 1, body + k, &geometry[i], &impulse[i]});
    }
  }
};

const IslandControl tight{PointFriction::coulomb, 2e-5, 0.2, 2000};

TEST(SplitIteration, StopsARowAtAWall) {
  constexpr int count = 100;
  Row row(count, 0.0);
  SplitIteration iteration;
  iteration.begin(count, count);
  row.add_to(iteration, 0, 0);
  const IslandResult result = iteration.iterate(tight);
  EXPECT_LE(result.error, tight.tolerance);
  // The estimate compares neighbours. Body k may be off by k + 1 times the tolerance, and the wall stops all of them.
  const double bound = 0.5 * count * (count + 1) * mass * tight.tolerance;
  for (int i = 0; i < count; ++i) {
    // each point stops all bodies behind it; the slip along the wall takes the impulse that it needs, within the cone
    EXPECT_NEAR(row.impulse[i].normal, (count - i) * mass * speed, bound);
    EXPECT_NEAR(row.impulse[i].tangential, -(count - i) * mass * 0.1 * speed, bound);
  }
}

TEST(SplitIteration, AnIslandDependsOnItselfAlone) {
  Row alone(30, 0.0), here(30, 0.0), far(70, 5000.0);
  SplitIteration one, two;
  one.begin(30, 30);
  alone.add_to(one, 0, 0);
  one.iterate(tight);
  two.begin(100, 100);
  far.add_to(two, 0, 0);
  here.add_to(two, 70, 70);
  two.iterate(tight);
  for (int i = 0; i < 30; ++i) {
    ASSERT_GT(alone.impulse[i].normal, 0.0);
    EXPECT_EQ(alone.impulse[i].normal, here.impulse[i].normal);
    EXPECT_EQ(alone.impulse[i].tangential, here.impulse[i].tangential);
  }
}

TEST(SplittingEngine, OfACrowdReachesItsTolerance) {
  const SceneDef scene = test::busy_scene(4);
  constexpr double tolerance = 1e-3;
  SplittingEngine engine(scene, test::busy_field(scene), tolerance, 2000);
  StepLog log;
  engine.advance(300, log);
  int contacts = 0;
  for (const StepQuality& quality : log.quality) {
    contacts = std::max(contacts, quality.contacts);
    EXPECT_EQ(quality.cone_excess, 0.0);
  }
  for (const IslandResult& result : engine.results()) EXPECT_LE(result.error, tolerance);
  EXPECT_GT(contacts, 50);
}

}  // namespace
}  // namespace gem::bench
