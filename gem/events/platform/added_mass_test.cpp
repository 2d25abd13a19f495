// Added mass: what a kick leaves, what a turn keeps, and the books of the water.
#include "gem/events/platform/added_mass.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/base/strict_math.h"
#include "gem/events/motion.h"

namespace gem::added_mass_law {
namespace {

constexpr double mass = 2e7, inertia = 4e10;
const AddedMassDef ship_water{1e6, 1.6e7, 2e10, 1e8};
const AddedMass ship = added_mass(ship_water, mass, inertia, true);
const Rotation askew = strict::rotation_of_angle(0.6);

const AddedMass uncoupled = added_mass({1e6, 1.6e7, 2e10, 0.0}, mass, inertia, true);

/// Momentum of ship and water in the ship's axes.
struct Momentum {
  double surge, sway, yaw;
};
Momentum momentum_of(const AddedMass& a, Rotation q, const PlatformSpeed& s) {
  const Vec2 v = rotate({q.cosine, -q.sine}, s.velocity);
  return {a.surge * v.x, a.sway * v.y + a.coupling * s.spin, a.yaw * s.spin + a.coupling * v.y};
}
double energy_of(const AddedMass& a, Rotation q, const PlatformSpeed& s) {
  const Vec2 v = rotate({q.cosine, -q.sine}, s.velocity);
  const Momentum p = momentum_of(a, q, s);
  return 0.5 * (v.x * p.surge + v.y * p.sway + s.spin * p.yaw);
}

TEST(AddedMass, AKickGivesTheMomentumOfTheForceToShipAndWater) {
  const PlatformSpeed before{{0.2, -0.1}, 0.001}, after{{0.25, 0.03}, 0.0035};
  const PlatformSpeed left = with_water(ship, askew, before, after);
  const Momentum p = momentum_of(ship, askew, {left.velocity - before.velocity, left.spin - before.spin});
  const Vec2 force = mass * rotate({askew.cosine, -askew.sine}, after.velocity - before.velocity);
  EXPECT_NEAR(p.surge, force.x, 1e-13 * length(force));
  EXPECT_NEAR(p.sway, force.y, 1e-13 * length(force));
  EXPECT_NEAR(p.yaw, inertia * (after.spin - before.spin), 1e-13 * inertia);
}

TEST(AddedMass, ALockedYawTakesNoWaterAround) {
  const AddedMass locked = added_mass(ship_water, mass, inertia, false);
  const PlatformSpeed left = with_water(locked, {}, {}, {{1.0, 1.0}, 0.0});
  EXPECT_DOUBLE_EQ(left.velocity.x, mass / (mass + ship_water.surge_kg));
  EXPECT_DOUBLE_EQ(left.velocity.y, mass / (mass + ship_water.sway_kg));
  EXPECT_EQ(left.spin, 0.0);
}

TEST(AddedMass, WithoutItNothingIsPresent) { EXPECT_FALSE(added_mass({}, mass, inertia, true).present); }

/// Turns freely for `dt` seconds.
PlatformSpeed turn(const AddedMass& a, const PlatformSpeed& speed, double dt, Rotation& q) {
  const PlatformSpeed middle = before_turn(a, q, speed, 0.5 * dt);
  const Rotation next = turned(q, dt * middle.spin);
  const PlatformSpeed after = after_turn(a, q, next, middle, 0.5 * dt);
  q = next;
  return after;
}

TEST(AddedMass, ATurnKeepsTheMomentumInTheWorld) {
  Rotation q = askew;
  PlatformSpeed speed{{1.1, 0.4}, 0.01};
  const auto in_world = [&] {
    const Momentum p = momentum_of(ship, q, speed);
    return rotate(q, {p.surge, p.sway});
  };
  const Vec2 before = in_world();
  for (int i = 0; i < 1000; ++i) speed = turn(ship, speed, 0.2, q);
  EXPECT_GT(std::fabs(std::atan2(q.sine, q.cosine) - 0.6), 0.5) << "it has turned";
  EXPECT_NEAR(length(in_world() - before), 0.0, 1e-12 * length(before));
}

/// Largest relative change of the energy in `time` seconds.
double energy_error(const AddedMass& a, double dt, double time) {
  Rotation q = askew;
  PlatformSpeed speed{{1.1, 0.4}, 0.01};
  const double before = energy_of(a, q, speed);
  double worst = 0.0;
  for (int i = 0; i < std::lround(time / dt); ++i) {
    speed = turn(a, speed, dt, q);
    worst = std::max(worst, std::fabs(energy_of(a, q, speed) / before - 1.0));
  }
  return worst;
}

TEST(AddedMass, ATurnKeepsTheEnergyToSecondOrderWithoutCoupling) {
  const double coarse = energy_error(uncoupled, 0.4, 400.0), fine = energy_error(uncoupled, 0.2, 400.0);
  EXPECT_LT(fine, 1e-6);
  EXPECT_NEAR(coarse / fine, 4.0, 0.1);
}

TEST(AddedMass, WithCouplingTheEnergyIsKeptToFirstOrder) {
  const double coarse = energy_error(ship, 0.4, 400.0), fine = energy_error(ship, 0.2, 400.0);
  EXPECT_LT(fine, 1e-4);
  EXPECT_NEAR(coarse / fine, 2.0, 0.05);
  // in eleven hours of turning freely, which no moored ship does
  EXPECT_NEAR(energy_error(ship, 0.4, 40000.0) / energy_error(ship, 0.2, 40000.0), 2.0, 0.1);
}

TEST(AddedMass, TimeRunsBack) {
  Rotation q = askew;
  const PlatformSpeed before{{1.1, 0.4}, 0.01};
  PlatformSpeed speed = before;
  for (int i = 0; i < 100; ++i) speed = turn(uncoupled, speed, 0.2, q);
  for (int i = 0; i < 100; ++i) speed = turn(uncoupled, speed, -0.2, q);
  EXPECT_NEAR(length(speed.velocity - before.velocity), 0.0, 1e-13);
  EXPECT_NEAR(speed.spin, before.spin, 1e-14);
  EXPECT_NEAR(q.sine, askew.sine, 1e-12);
}

TEST(AddedMass, WaterThatIsTheSameInAllDirectionsDoesNotTurnTheShip) {
  const AddedMass round = added_mass({5e6, 5e6, 1e10, 0.0}, mass, inertia, true);
  Rotation q = askew;
  const PlatformSpeed before{{1.1, 0.4}, 0.01}, after = turn(round, before, 0.2, q);
  EXPECT_NEAR(length(after.velocity - before.velocity), 0.0, 1e-15);
  EXPECT_NEAR(after.spin, before.spin, 1e-16);
}

TEST(AddedMass, TheBookOfTheWaterIsWhatThePlatformAloneHasMore) {
  const PlatformSpeed before{{0.2, -0.1}, 0.001}, after{{0.15, 0.0}, 0.002};
  const Vec2 place{30.0, -20.0};
  const Quantity given = given_by_water(ship, place, before, after);
  const Quantity a = quantity_of(mass, inertia, place, before.velocity, before.spin),
                 b = quantity_of(mass, inertia, place, after.velocity, after.spin);
  EXPECT_NEAR(given.momentum.x, b.momentum.x - a.momentum.x, 1e-8);
  EXPECT_NEAR(given.angular_momentum, b.angular_momentum - a.angular_momentum, 1e-5);
  EXPECT_NEAR(given.energy, b.energy - a.energy, 1e-8);
}

}  // namespace
}  // namespace gem::added_mass_law
