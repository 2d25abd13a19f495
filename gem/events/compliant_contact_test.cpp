// The law of one corner by itself: its bounds, its limits, and hits in one and two directions against closed forms.
#include "gem/events/compliant_contact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/base/random.h"
#include "gem/events/crushing.h"

namespace gem {
namespace {

constexpr double of_ice = 2.5e8;  // of a corner of ice of 1 m [N/m]

/// A mass that hits one corner head on, with a bound of crushing that grows as a corner's.
struct Hit {
  CornerLaw law;
  double mass = 9e4;     // [kg]
  double speed = 0.5;    // [m/s]
  double slip = 0.0;     // along the side [m/s]
  double growth = -1.0;  // of the chord; < 0: no crushing
};

struct Outcome {
  double peak = 0.0, depth = 0.0;          // [N], [m]
  double speed = 0.0, slip = 0.0;          // after it [m/s]
  double energy = 0.0, most_energy = 0.0;  // kinetic, after it and at most, over that before
};

/// Integrates a hit in substeps of `h` as the engine does.
Outcome integrate(const Hit& hit, double h) {
  const CrushingIce ice{2.5e6, -0.1, 1.0};
  const double start = 0.5 * hit.mass * (hit.speed * hit.speed + hit.slip * hit.slip);
  CornerMemory m;
  Outcome out{0.0, 0.0, hit.speed, hit.slip, 1.0, 1.0};
  double depth = 0.3 * h * hit.speed;
  for (int k = 0; k < 2000000 && depth > 0.0; ++k) {
    const double u_n = -out.speed, u_t = out.slip;
    const double trial = corner_pressure(hit.law, depth - m.crushed, u_n);
    const double bound = hit.growth < 0.0 ? trial : crushing_force(ice, hit.growth * depth);
    const double force = std::min(trial, bound);
    if (force < trial) m.crushed = crushed_depth(hit.law, m.crushed, depth, force);
    m.stretch = corner_stretch(hit.law, m.stretch, h * u_t, force);
    out.slip += h * corner_friction(hit.law, m.stretch, u_t, force) / hit.mass;
    out.speed -= h * force / hit.mass;
    out.peak = std::max(out.peak, force);
    out.depth = std::max(out.depth, depth);
    out.energy = 0.5 * hit.mass * (out.speed * out.speed + out.slip * out.slip) / start;
    out.most_energy = std::max(out.most_energy, out.energy);
    depth += h * out.speed;
    if (force == 0.0 && out.speed < 1e-9 * hit.speed) break;
  }
  return out;
}

ContactDef defaults() { return {}; }

TEST(CompliantContact, two_corners_are_a_face) {
  const ContactDef def = defaults();
  EXPECT_EQ(2.0 * corner_stiffness(def, 0.7, true), def.face_stiffness_Pa * 0.7);
  EXPECT_EQ(2.0 * corner_stiffness(def, 0.7, false), def.structure_stiffness_N_per_m);
  // damping ratio of a face: 2 c over 2 sqrt(K m)
  const double mass = 5e4, k = corner_stiffness(def, 1.0, true);
  EXPECT_NEAR(corner_damping(def, k, 1.0 / mass) / std::sqrt(2.0 * k * mass), def.damping_ratio, 1e-12);
}

TEST(CompliantContact, a_corner_pushes_only_where_its_spring_is_pressed) {
  const CornerLaw law{of_ice, 1e6, 0.3};
  EXPECT_EQ(corner_pressure(law, 0.0, -1.0), 0.0);
  EXPECT_EQ(corner_pressure(law, -1e-3, -1.0), 0.0);
  EXPECT_EQ(corner_pressure(law, 1e-6, 1.0), 0.0) << "it does not pull";
  EXPECT_EQ(corner_pressure(law, 1e-3, 0.0), of_ice * 1e-3);
  EXPECT_GT(corner_pressure(law, 1e-3, -0.1), corner_pressure(law, 1e-3, 0.0));
}

TEST(CompliantContact, crushed_depth_never_falls_and_leaves_the_force_in_the_spring) {
  const CornerLaw law{of_ice, 0.0, 0.0};
  const double crushed = crushed_depth(law, 0.0, 0.05, 1e5);
  EXPECT_NEAR(of_ice * (0.05 - crushed), 1e5, 1e-6);
  EXPECT_EQ(crushed_depth(law, crushed, 0.02, 1e5), crushed);
}

TEST(CompliantContact, friction_stays_within_coulombs_limit) {
  RandomSequence numbers(Random(1, 1));
  for (int k = 0; k < 10000; ++k) {
    const CornerLaw law{of_ice * numbers.uniform(), 1e6 * numbers.uniform(), numbers.uniform()};
    const double force = 1e6 * numbers.uniform(), most = law.friction * force * (1.0 + 1e-12);
    const double stretch = corner_stretch(law, numbers.uniform(-1.0, 1.0), numbers.uniform(-1.0, 1.0), force);
    EXPECT_LE(std::fabs(law.stiffness * stretch), most);
    EXPECT_LE(std::fabs(corner_friction(law, stretch, numbers.uniform(-1.0, 1.0), force)), most);
  }
  EXPECT_EQ(corner_stretch({of_ice, 0.0, 0.5}, 1e-3, 1e-3, 0.0), 0.0) << "no force, no stretch";
}

TEST(CompliantContact, undamped_spring_returns_the_speed) {
  const Outcome out = integrate({{of_ice, 0.0, 0.0}}, 1e-6);
  EXPECT_NEAR(out.peak, 0.5 * std::sqrt(of_ice * 9e4), 1e-3 * out.peak);
  EXPECT_NEAR(out.speed, -0.5, 1e-3);
}

TEST(CompliantContact, half_of_critical_damping_returns_three_tenths) {
  ContactDef def = defaults();
  def.damping_ratio = 0.5;
  const double mass = 9e4, k = corner_stiffness(def, 1.0, true);
  // both corners of a face
  const Hit hit{{2.0 * k, 2.0 * corner_damping(def, k, 1.0 / mass), 0.0}, mass, 0.2};
  const Outcome out = integrate(hit, 1e-6);
  EXPECT_NEAR(-out.speed / hit.speed, 0.30, 0.005);
  EXPECT_NEAR(out.peak, hit.speed * std::sqrt(2.0 * k * mass), 0.01 * out.peak);
}

TEST(CompliantContact, crushing_is_the_limit_of_a_stiff_spring) {
  const CrushingIce ice{2.5e6, -0.1, 1.0};
  for (const double growth : {1.0, 2.0, 7.5}) {
    const CrushingPeak right = crushing_corner(ice, growth, 0.5 * 9e4 * 0.25);
    double last = 1.0;
    for (const double k : {2.5e8, 2.5e9, 2.5e10}) {
      const Outcome out = integrate({{k, 0.0, 0.0}, 9e4, 0.5, 0.0, growth}, 1e-6);
      const double miss = std::fabs(out.peak / right.force - 1.0);
      EXPECT_LT(miss, last) << growth << " " << k;
      EXPECT_NEAR(out.depth, right.depth, 0.05 * right.depth);
      last = std::max(miss, 1e-4);
    }
    EXPECT_LT(last, 1e-3);
  }
}

/// Hits whose stiffness and damping are at the limits for their substep. Returns the largest energy gained.
double largest_gain(int hits, double damping_share, std::uint64_t seed) {
  RandomSequence numbers(Random(seed, 1));
  double most = -1.0;
  for (int k = 0; k < hits; ++k) {
    const double mass = std::pow(10.0, 6.0 * numbers.uniform()), h = std::pow(10.0, -4.0 * numbers.uniform());
    const CornerLaw asked{1e15, 1e15 * damping_share, numbers.uniform()};
    const Hit hit{stable_law(asked, h, 1.0 / mass), mass, 1.0, numbers.uniform(-3.0, 3.0),
                  numbers.below(2) ? -1.0 : numbers.uniform(0.5, 4.0)};
    most = std::max(most, integrate(hit, h).most_energy - 1.0);
  }
  return most;
}

TEST(CompliantContact, at_the_stability_limits_a_hit_gains_no_energy) { EXPECT_LE(largest_gain(20000, 1.0, 1), 1e-9); }

TEST(CompliantContact, limits_bind_only_beyond_them) {
  const CornerLaw soft{1e3, 10.0, 0.2}, law = stable_law(soft, 1e-3, 1e-4);
  EXPECT_EQ(law.stiffness, soft.stiffness);
  EXPECT_EQ(law.damping, soft.damping);
  const CornerLaw hard = stable_law({1e15, 1e15, 0.2}, 1e-3, 1e-4);
  EXPECT_DOUBLE_EQ(hard.stiffness, 0.64 / (1e-6 * 1e-4));
  EXPECT_DOUBLE_EQ(hard.damping, 0.36 / (1e-3 * 1e-4));
  const CornerLaw damped = stable_law({1e3, 1e15, 0.2}, 1e-3, 1e-4);
  EXPECT_DOUBLE_EQ(damped.damping, (1.0 - 1e3 * 1e-10) / (1e-3 * 1e-4));
}

}  // namespace
}  // namespace gem
