// The slide of a floe over one time step against its closed form.
#include "gem/events/slope.h"

#include <gtest/gtest.h>

namespace gem {
namespace {

TEST(Slope, FloeFallsAsTheClosedForm) {
  const SlopeDef slope{{1e-5, -2e-5}};
  const Vec2 start{0.1, 0.2};
  for (const double dt : {0.05, 100.0, 1e5}) {
    const SlopeSlide after = slide(slope, start, dt);
    EXPECT_NEAR(after.velocity.x, 0.1 - 9.81e-5 * dt, 1e-13);
    EXPECT_NEAR(after.velocity.y, 0.2 + 19.62e-5 * dt, 1e-13);
    const Vec2 path = after.path_correction + dt * after.velocity;
    EXPECT_NEAR(path.x, (0.1 - 0.5 * 9.81e-5 * dt) * dt, 1e-13 * dt);
    EXPECT_NEAR(path.y, (0.2 + 0.5 * 19.62e-5 * dt) * dt, 1e-13 * dt);
  }
}

TEST(Slope, SlopesInAnyDirection) {
  EXPECT_FALSE(slopes({}));
  EXPECT_TRUE(slopes({{0.0, -1e-6}}));
  EXPECT_TRUE(slopes({{1e-6, 0.0}}));
}

}  // namespace
}  // namespace gem
