// Events of the platform and free motion: mooring, water drag, elastic stress, rotation without trigonometry.
#include <gtest/gtest.h>

#include <cmath>

#include "gem/events/elastic_contact.h"
#include "gem/events/motion.h"
#include "gem/events/platform/mooring.h"
#include "gem/events/platform/platform_drag.h"

namespace gem {
namespace {

constexpr double mass = 1e8, stiffness = 5e5;

TEST(Mooring, TwoHalvesAreOneStretch) {
  for (const double damping : {0.0, 0.05, 0.9})
    for (const double duration : {0.05, 3.0, 40.0}) {
      const MooringFlow whole = mooring_flow(stiffness, mass, damping, duration);
      const MooringFlow half = mooring_flow(stiffness, mass, damping, 0.5 * duration);
      Vec2 x{0.3, -0.1}, v{0.01, 0.02}, y = x, w = v;
      apply(whole, x, v);
      apply(half, y, w);
      apply(half, y, w);
      EXPECT_NEAR(x.x, y.x, 1e-15);
      EXPECT_NEAR(x.y, y.y, 1e-15);
      EXPECT_NEAR(v.x, w.x, 1e-16);
      EXPECT_NEAR(v.y, w.y, 1e-16);
      // the area in phase space shrinks by e^(-2 rate t) exactly
      const double rate = damping * std::sqrt(stiffness / mass);
      EXPECT_NEAR(whole.xx * whole.vv - whole.xv * whole.vx, std::exp(-2.0 * rate * duration), 1e-14);
    }
}

TEST(Mooring, PeriodAndEnergyOfTheFreePlatform) {
  const double period = natural_period(stiffness, mass);
  EXPECT_NEAR(period, 88.8577, 1e-4);
  const MooringFlow flow = mooring_flow(stiffness, mass, 0.0, period / 4096.0);
  Vec2 x{0.5, 0.0}, v{};
  for (int i = 0; i < 4096; ++i) apply(flow, x, v);
  EXPECT_NEAR(x.x, 0.5, 1e-12);
  EXPECT_NEAR(v.x, 0.0, 1e-13);
  EXPECT_NEAR((0.5 * mass * v.x * v.x + 0.5 * stiffness * x.x * x.x) / 62500.0, 1.0, 1e-12);
}

TEST(Mooring, WithoutSpringItDrifts) {
  const MooringFlow flow = mooring_flow(0.0, mass, 0.0, 7.0);
  Vec2 x{1.0, 2.0}, v{0.1, -0.2};
  apply(flow, x, v);
  EXPECT_DOUBLE_EQ(x.x, 1.7);
  EXPECT_DOUBLE_EQ(x.y, 0.6);
  EXPECT_EQ(v.x, 0.1);
}

TEST(PlatformDrag, ExactAndRelativeToTheWater) {
  const double rate = platform_drag_rate(1025.0, 0.8, 100.0, 12.42, mass);
  EXPECT_NEAR(rate * mass, 0.5 * 1025.0 * 0.8 * 1242.0, 1e-9);
  const Vec2 water{0.25, 0.0}, velocity{-0.05, 0.1};
  const double slip = std::hypot(-0.3, 0.1);
  const Vec2 one = platform_drag(rate, velocity, water, 100.0);
  EXPECT_NEAR((one.x - 0.25) / -0.3, 1.0 / (1.0 + rate * slip * 100.0), 1e-15);
  const Vec2 two = platform_drag(rate, platform_drag(rate, velocity, water, 50.0), water, 50.0);
  EXPECT_NEAR(two.x, one.x, 1e-15);
  EXPECT_NEAR(two.y, one.y, 1e-15);
  const Vec2 same = platform_drag(rate, water, water, 100.0);
  EXPECT_EQ(same.x, water.x);
  EXPECT_EQ(same.y, water.y);
}

TEST(PlatformDrag, ByAxisEachSpeedFallsOnItsOwn) {
  constexpr double length = 200.0, beam = 40.0, draft = 10.0;
  const AxisDrag drag{platform_drag_rate(1025.0, 0.1, beam, draft, mass),
                      platform_drag_rate(1025.0, 0.7, length, draft, mass), 0.0};
  EXPECT_NEAR(drag.sway / drag.surge, 0.7 * length / (0.1 * beam), 1e-12);
  const Rotation q{0.6, 0.8};
  const Vec2 water{0.25, -0.1};
  for (const Vec2 slip : {Vec2{2.0, 0.0}, Vec2{0.0, -1.5}, Vec2{-2.0, 1.5}}) {
    const Vec2 after = platform_drag(drag, q, water + rotate(q, slip), water, 100.0);
    const Vec2 left = rotate({q.cosine, -q.sine}, after - water);
    EXPECT_NEAR(left.x, slip.x / (1.0 + drag.surge * std::fabs(slip.x) * 100.0), 1e-15);
    EXPECT_NEAR(left.y, slip.y / (1.0 + drag.sway * std::fabs(slip.y) * 100.0), 1e-15);
    const Vec2 half = platform_drag(drag, q, water + rotate(q, slip), water, 50.0);
    const Vec2 halves = platform_drag(drag, q, half, water, 50.0);
    EXPECT_NEAR(halves.x, after.x, 1e-15);
    EXPECT_NEAR(halves.y, after.y, 1e-15);
  }
}

TEST(PlatformDrag, TheYawRateIsThatOfTheStrips) {
  constexpr double length = 200.0, draft = 10.0, coefficient = 0.7, inertia = 2e11, spin = 0.004;
  constexpr int strips = 2000;
  double moment = 0.0;
  for (int i = 0; i < strips; ++i) {
    const double x = length * ((i + 0.5) / strips - 0.5), speed = spin * x;
    moment -= 0.5 * 1025.0 * coefficient * draft * std::fabs(speed) * speed * x * (length / strips);
  }
  const double rate = yaw_drag_rate(1025.0, coefficient, length, draft, inertia);
  // the rule of middles of |x|^3 is short by 2 / strips^2
  EXPECT_NEAR(-rate * inertia * spin * spin / moment, 1.0, 2.1 / (strips * double{strips}));
  EXPECT_EQ(slowed(rate, -spin, 500.0), -slowed(rate, spin, 500.0));
  EXPECT_NEAR(slowed(rate, spin, 500.0), spin / (1.0 + rate * spin * 500.0), 1e-18);
  EXPECT_NEAR(slowed(rate, slowed(rate, spin, 250.0), 250.0), slowed(rate, spin, 500.0), 1e-17);
  EXPECT_EQ(slowed(0.0, spin, 500.0), spin);
}

TEST(ElasticContact, NeverOvershootsForAnyStiffness) {
  const double depth = 0.01;
  double last = 0.0;
  for (const double dt : {1e-4, 0.05, 10.0})
    for (double k = 1.0; k < 1e15; k *= 7.0) {
      const double u = elastic_separating_speed(k, depth, 2e4, dt);
      EXPECT_GT(u, 0.0);
      EXPECT_LT(u * dt, depth);
    }
  for (double k = 1.0; k < 1e12; k *= 7.0) {
    const double u = elastic_separating_speed(k, depth, 2e4, 0.05);
    EXPECT_GT(u, last);
    last = u;
  }
  // soft spring: the speed from force x dt / mass
  EXPECT_NEAR(elastic_separating_speed(1.0, depth, 2e4, 0.05) / (0.05 * depth / 2e4), 1.0, 1e-3);
  EXPECT_EQ(elastic_separating_speed(1e6, 0.0, 2e4, 0.05), 0.0);
}

TEST(Turn, AngleIsAsAccurateAsStated) {
  for (const double angle : {1e-9, 1e-4, 0.02, -0.02, 0.2, 0.5}) {
    const Rotation q = turned({}, angle);
    const double p = 0.5 * std::fabs(angle);
    const double stated = 2.0 * 17.0 / 315.0 * std::pow(p, 7.0) * 1.3 + 4e-16;
    EXPECT_NEAR(std::atan2(q.sine, q.cosine), angle, stated) << angle;
    EXPECT_NEAR(q.cosine * q.cosine + q.sine * q.sine, 1.0, 1e-15) << angle;
  }
}

TEST(Turn, StaysARotationForAMillionTurns) {
  Rotation q;
  constexpr int turns = 1000000;
  constexpr double angle = 5e-5;
  for (int i = 0; i < turns; ++i) q = turned(q, angle);
  EXPECT_NEAR(q.cosine * q.cosine + q.sine * q.sine, 1.0, 1e-15);
  // rounding of each turn: a random walk of a million steps of 1e-16, times a margin of 100
  EXPECT_NEAR(std::remainder(std::atan2(q.sine, q.cosine) - turns * angle, 2.0 * M_PI), 0.0, 1e-11);
  const Rotation back = turned(turned({0.6, 0.8}, 0.3), -0.3);
  EXPECT_NEAR(back.cosine, 0.6, 2e-16);
  EXPECT_NEAR(back.sine, 0.8, 2e-16);
}

}  // namespace
}  // namespace gem
