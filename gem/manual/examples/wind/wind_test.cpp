// The push of the wind over one time step against its closed form.
#include "gem/events/wind.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gem {
namespace {

constexpr WindDef breeze{{6.0, -8.0}, 1.5e-3};  // 10 m/s
constexpr double area = 80.0, mass = 36000.0;
constexpr double rate = air_density * 1.5e-3 * area / mass;  // [1/m]

TEST(Wind, FloeAtRestFollowsTheClosedForm) {
  for (const double dt : {0.05, 100.0, 1e5}) {
    const WindPush push = wind_push(breeze, area, mass, {}, dt);
    const double z = rate * 10.0 * dt;
    EXPECT_NEAR(push.velocity.x, 6.0 * z / (1.0 + z), 1e-14);
    EXPECT_NEAR(push.velocity.y, -8.0 * z / (1.0 + z), 1e-14);
    const Vec2 path = push.path_correction + dt * push.velocity;
    const double length_of_path = 10.0 * dt - std::log1p(z) / rate;
    EXPECT_NEAR(path.x, 0.6 * length_of_path, 1e-14 * dt);
    EXPECT_NEAR(path.y, -0.8 * length_of_path, 1e-14 * dt);
  }
}

TEST(Wind, ShortTimeStepGivesTheStress) {
  const double dt = 1e-3;
  const Vec2 velocity{2.0, 1.0}, felt = breeze.velocity_m_per_s - velocity;
  const WindPush push = wind_push(breeze, area, mass, velocity, dt);
  const Vec2 force = air_density * 1.5e-3 * area * length(felt) * felt;
  EXPECT_NEAR(mass * (push.velocity.x - velocity.x) / dt, force.x, 1e-4 * std::fabs(force.x));
  EXPECT_NEAR(mass * (push.velocity.y - velocity.y) / dt, force.y, 1e-4 * std::fabs(force.y));
}

TEST(Wind, FloeAsFastAsTheWindFeelsNone) {
  const WindPush push = wind_push(breeze, area, mass, breeze.velocity_m_per_s, 10.0);
  EXPECT_EQ(push.velocity.x, 6.0);
  EXPECT_EQ(push.velocity.y, -8.0);
  EXPECT_EQ(push.path_correction.x, 0.0);
}

TEST(Wind, BlowsInAnyDirection) {
  EXPECT_FALSE(blows({}));
  EXPECT_TRUE(blows({{0.0, -0.1}, 2e-3}));
  EXPECT_TRUE(blows({{0.1, 0.0}, 2e-3}));
}

}  // namespace
}  // namespace gem
