// Crushing: a table of worked cases, the transition from corner to flat, energy as the integral of the force.
#include "gem/events/crushing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/events/events.h"

namespace gem {
namespace {

// m_e = 5e4 kg at 0.25 m/s in ice of 0.5 m and 3 MPa; expected values are known to six digits
constexpr double closing_speed = 0.25;
constexpr double energy = 1562.5;
constexpr double six_digits = 4e-6;

double cotangent(double degrees) { return 1.0 / std::tan(degrees * M_PI / 180.0); }

struct Case {
  const char* name;
  double growth;  // 0: flat, 7 m wide
  double exponent;
  double depth;
  double force;
  double duration;
  double area;
};

TEST(Crushing, WorkedCases) {
  const Case cases[] = {
      {"corner 120", 2.0 * cotangent(30.0), -0.1, 0.0202142, 146864.52, 0.129046, 0.0350120},
      {"corner 120, even pressure", 2.0 * cotangent(30.0), 0.0, 0.0245236, 127428.0, 0.154086, 0.0424761},
      {"corner 120, steep pressure", 2.0 * cotangent(30.0), -0.5, 0.00706328, 331822.0, 0.0487293, 0.0122340},
      {"corner 90", 2.0 * cotangent(45.0), -0.1, 0.0262216, 113218.0, 0.167397, 0.0262216},
      {"oblique 20/40", cotangent(20.0) + cotangent(40.0), -0.1, 0.0190202, 156084.0, 0.121424, 0.0374625},
      {"platform corner", 2.0 * cotangent(9.0), -0.1, 0.0109541, 271018.0, 0.0699302, 0.0691613},
      {"edge on edge", 0.0, -0.1, 0.000168670, 9263660.0, 0.00134936, 3.5},
  };
  for (const Case& c : cases) {
    const CrushingIce ice{3e6, c.exponent, 0.5};
    const bool flat = c.growth == 0.0;
    const CrushingPeak peak = crushing_peak(ice, c.growth, flat ? 7.0 : 100.0, energy);
    EXPECT_NEAR(peak.depth / c.depth, 1.0, six_digits) << c.name;
    EXPECT_NEAR(peak.force / c.force, 1.0, six_digits) << c.name;
    const double n = flat ? 1.0 : 2.0 + c.exponent;
    EXPECT_NEAR(crushing_duration(peak.depth, closing_speed, n) / c.duration, 1.0, six_digits) << c.name;
    const double width = flat ? 7.0 : c.growth * peak.depth;
    EXPECT_NEAR(0.5 * width / c.area, 1.0, six_digits) << c.name;
    EXPECT_NEAR(peak.force / crushing_force(ice, width), 1.0, 1e-13) << c.name;
  }
}

TEST(Crushing, CornerTurnsFlatWithoutAStep) {
  const CrushingIce ice{3e6, -0.1, 0.5};
  const double growth = 2.0, longest = 0.1;
  const double corner_energy = crushing_force(ice, longest) * (longest / growth) / 1.9;
  const CrushingPeak below = crushing_peak(ice, growth, longest, corner_energy * (1.0 - 1e-9));
  const CrushingPeak above = crushing_peak(ice, growth, longest, corner_energy * (1.0 + 1e-9));
  EXPECT_NEAR(below.depth / above.depth, 1.0, 1e-8);
  EXPECT_NEAR(below.force / above.force, 1.0, 1e-8);
  // beyond it the force is constant: that of the longest chord
  const CrushingPeak deep = crushing_peak(ice, growth, longest, 10.0 * corner_energy);
  EXPECT_DOUBLE_EQ(deep.force, crushing_force(ice, longest));
  EXPECT_NEAR(deep.depth, longest / growth + 9.0 * corner_energy / deep.force, 1e-12);
}

TEST(Crushing, EnergyIsTheIntegralOfTheForce) {
  const CrushingIce ice{2.5e6, -0.3, 0.7};
  const double growth = 3.0, longest = 0.2;
  const double corner_energy = crushing_force(ice, longest) * (longest / growth) / 1.7;
  for (const double asked : {0.3 * corner_energy, 2.0 * corner_energy}) {
    const CrushingPeak peak = crushing_peak(ice, growth, longest, asked);
    constexpr int steps = 200000;
    double work = 0.0;
    for (int i = 0; i < steps; ++i) {
      const double depth = (i + 0.5) / steps * peak.depth;
      work += crushing_force(ice, std::fmin(growth * depth, longest)) * peak.depth / steps;
    }
    // the midpoint rule near the start of z^0.7: the first cell is wrong by a few percent of (1/steps)^1.7
    EXPECT_NEAR(work / asked, 1.0, 1e-8);
  }
}

TEST(Crushing, NothingForNoEnergyAndNoWidth) {
  const CrushingIce ice{3e6, -0.1, 0.5};
  EXPECT_EQ(crushing_peak(ice, 2.0, 1.0, 0.0).force, 0.0);
  EXPECT_EQ(crushing_peak(ice, 2.0, 1.0, 0.0).depth, 0.0);
  EXPECT_EQ(crushing_force(ice, 0.0), 0.0);
  EXPECT_EQ(crushing_flat(ice, 0.0, 10.0).depth, 0.0);
}

TEST(Crushing, TheCapIsTheLawOfTheWholeFace) {
  EventDefinitions definitions;
  const Events e = make_events(definitions, nullptr, 0.05, false);
  for (const double thickness : {0.3, 1.2})
    for (const double area : {4.0, 400.0}) {
      const CrushingPowers powers = crushing_powers(e, thickness, area);
      const double law = 0.05 * crushing_force(crushing_ice(e, thickness), std::sqrt(area));
      EXPECT_NEAR(largest_impulse(e, true, powers.thickness, powers.width, 1) / law, 1.0, 1e-14);
      EXPECT_NEAR(largest_impulse(e, true, powers.thickness, powers.width, 2) / law, 0.5, 1e-14);
    }
  EXPECT_EQ(largest_impulse(e, false, 1.0, 1.0, 1), no_cap);
  EXPECT_EQ(crushing_powers(e, 0.0, 0.0).thickness, 0.0);  // a body that has no ice
}

}  // namespace
}  // namespace gem
