// A pair in its substeps has the same bits alone and beside three others.
#include "gem/engine/contact/sub_pair.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gem {
namespace {

constexpr double h = 1e-3;  // [s]

template <class Real>
struct Hit {
  SubPair<Real> pair;
  SubCorner<Real> corner;
  SubSide<Real> side[4];
  MotionOf<Real> wall, floe;
};

/// The tip of a square of 10 m, 1 cm before a wall of 20 m by 20 m, with this speed and spin [m/s], [rad/s].
template <class Real>
Hit<Real> hit_of(Real speed, Real spin) {
  Hit<Real> hit;
  const Real zero{}, one = zero + 1.0, diagonal = zero + std::sqrt(50.0);
  hit.pair.count = 1;
  hit.pair.bound = zero + 2.5e6;
  hit.pair.half_exponent = zero + 0.45;
  SubCorner<Real>& c = hit.corner;
  c.of_b = one > 0.0;
  c.corner = {diagonal, zero};
  c.flank[0] = {-diagonal, -diagonal};
  c.flank[1] = {-diagonal, diagonal};
  c.between = {-diagonal - 10.01, zero};
  c.sides = 4;
  c.law = {zero + 5e7, zero + 1e5, zero + 0.3};
  c.full_stiffness = zero + 5e7;
  hit.side[0] = {{-one, zero}, zero + 10.0, zero + side_role::meets};
  hit.side[1] = {{one, zero}, zero + 10.0, zero + side_role::shows};
  hit.side[2] = {{zero, one}, zero + 10.0, zero + side_role::shows};
  hit.side[3] = {{zero, -one}, zero + 10.0, zero + side_role::shows};
  hit.wall.cosine = hit.floe.cosine = one;
  hit.floe.velocity = {speed, 0.1 * one};
  hit.floe.spin = spin;
  return hit;
}

/// 100 substeps of a floe of 90 t. Its turn is small: cosine 1.
template <class Real>
void advance(Hit<Real>& hit) {
  for (int n = 0; n < 100; ++n) {
    const Real zero{};
    const PairPushOf<Real> push = press_pair(hit.pair, &hit.corner, hit.side, hit.wall, hit.floe, zero < 1.0, zero + h);
    hit.floe.velocity += (zero + 1.0 / 9e4) * push.impulse;
    hit.floe.spin += push.twist_b * (1.0 / 1.5e6);
    hit.floe.sine += h * hit.floe.spin;
    hit.floe.shift += (zero + h) * hit.floe.velocity;
  }
}

TEST(SubPair, HasTheSameBitsAloneAndInAPack) {
  const double speed[double_lanes] = {0.5, 1.0, -0.2, 0.7}, spin[double_lanes] = {0.0, 0.1, 0.0, -0.2};
  Hit<DoublePack> all =
      hit_of(DoublePack{speed[0], speed[1], speed[2], speed[3]}, DoublePack{spin[0], spin[1], spin[2], spin[3]});
  advance(all);
  for (int lane = 0; lane < double_lanes; ++lane) {
    Hit<double> alone = hit_of(double{speed[lane]}, double{spin[lane]});
    advance(alone);
    EXPECT_EQ(alone.pair.pressed > 0.0, speed[lane] > 0.0) << lane;
    EXPECT_EQ(all.pair.pressed[lane], alone.pair.pressed) << lane;
    EXPECT_EQ(all.pair.largest_force[lane], alone.pair.largest_force) << lane;
    EXPECT_EQ(all.pair.work.crushed[lane], alone.pair.work.crushed) << lane;
    EXPECT_EQ(all.pair.work.friction[lane], alone.pair.work.friction) << lane;
    EXPECT_EQ(all.corner.memory.crushed[lane], alone.corner.memory.crushed) << lane;
    EXPECT_EQ(all.floe.shift.x[lane], alone.floe.shift.x) << lane;
    EXPECT_EQ(all.floe.spin[lane], alone.floe.spin) << lane;
  }
}

}  // namespace
}  // namespace gem
