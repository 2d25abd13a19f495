// The law of splitting: its constant from the formula, the limits of the formula, and the scaling of force and energy.
#include "gem/events/breakup.h"

#include <gtest/gtest.h>

#include <numbers>

namespace gem {
namespace {

double opening_pair(double a) { return std::sqrt(std::numbers::pi * a) / (2.0 * crack_mouth_factor(a)); }

TEST(Breakup, TheCoefficientIsTheLargestOpeningPairOverTheDepth) {
  double largest = 0.0, at = 0.0;
  for (int i = 1; i < 100000; ++i)
    if (const double a = i / 100000.0; opening_pair(a) > largest) largest = opening_pair(a), at = a;
  // the maximum is flat: on a grid of 1e-5 it is found to (1e-5)^2 times its curvature, about 1e-9
  EXPECT_NEAR(splitting_coefficient, largest, 1e-9);
  EXPECT_NEAR(at, 0.21, 1e-3);
}

TEST(Breakup, TheFormulaHasTheLimitsOfShortAndDeepCracks) {
  // half plane with a pair of forces at the mouth: sqrt(pi^2 / (pi^2 - 4)) = 1.2967; the fit gives 1.30
  const double pi = std::numbers::pi;
  EXPECT_NEAR(crack_mouth_factor(0.0), std::sqrt(pi * pi / (pi * pi - 4.0)), 5e-3);
  // a ligament bent by the moment P L: K = 3.975 P L / ligament^(3/2); here in the units of K_I = 2 P g / sqrt(pi a L)
  const double a = 1.0 - 1e-6;
  EXPECT_NEAR(2.0 / std::sqrt(pi * a) * crack_mouth_factor(a) * std::pow(1e-6, 1.5), 3.975, 5e-3);
}

TEST(Breakup, ForceAndEnergyScaleWithThicknessLengthAndToughness) {
  BreakupDef def;
  def.fracture_toughness_Pa_sqrt_m = 1e5;
  def.elastic_modulus_Pa = 5e9;
  def.wedge_ratio = 0.5;
  EXPECT_NEAR(splitting_force(def, 1.0, 100.0), 2.0 * splitting_coefficient * 1e6, 1e-6);
  EXPECT_NEAR(splitting_force(def, 2.0, 400.0), 4.0 * splitting_force(def, 1.0, 100.0), 1e-6);
  EXPECT_NEAR(crack_energy(def, 1.0, 100.0), 200.0, 1e-9);  // K^2 / E = 2 J/m2 on 100 m2
}

}  // namespace
}  // namespace gem
