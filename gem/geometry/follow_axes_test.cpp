// Separating axes that are updated across time steps equal those of a new search.
#include <gtest/gtest.h>

#include "gem/geometry/test_shapes.h"

namespace gem {
namespace {

TEST(FollowAxes, GiveTheAxisOfAFreshLook) {
  RandomSequence random(Random(61, 0));
  constexpr double limit = 0.01;
  int touching = 0, spared = 0;
  for (int pair = 0; pair < 300; ++pair) {
    const test::Shape a = test::random_shape(random), b = test::random_shape(random);
    Vec2 offset{random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0)};
    SeparatingAxes axes = find_axes(a.outline(), b.outline(), offset);
    for (int round = 0; round < 200; ++round) {
      const Vec2 step{random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05)};
      offset += step;
      const double others = axes.others;
      follow_axes(axes, a.outline(), b.outline(), offset, length(step) + 1e-9, limit);
      if (axes.others > others) ++spared;
      const Separation fresh = test::separation_of(a, b, offset);
      // beyond the limit, any axis that separates the outlines is enough
      if (!(fresh.distance < limit)) {
        ASSERT_LE(axes.first.distance, fresh.distance + 1e-12);
        continue;
      }
      ++touching;
      ASSERT_EQ(axes.first.distance, fresh.distance) << pair << " round " << round;
      ASSERT_EQ(axes.first.edge, fresh.edge) << pair << " round " << round;
      ASSERT_EQ(axes.first.edge_of_b, fresh.edge_of_b) << pair << " round " << round;
    }
  }
  EXPECT_GT(touching, 5000);
  EXPECT_GT(spared, 5000);
}

}  // namespace
}  // namespace gem
