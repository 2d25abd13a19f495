// The elastic catenary against its closed form, without stretch and nearly weightless, and its curve.
#include "gem/events/platform/catenary.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gem {
namespace {

/// A chain of 84 mm in 40 m of water.
constexpr LineProperties chain{600.0, 1400.0, 7e8, 40.0};

TEST(Catenary, HangsAtItsHeight) {
  for (double h = 1.0; h < 5e8; h *= 3.0) {
    const double v = vertical_tension(chain, h);
    EXPECT_NEAR(line_shape(chain, h, v).z, chain.height, 1e-12 * chain.height) << h;
  }
}

TEST(Catenary, WithoutStretchIsTheInextensibleOne) {
  LineProperties stiff = chain;
  stiff.stiffness = 1e16;
  for (const double h : {1e3, 1e5, 1e6}) {
    // V^2 = (w z)^2 + 2 w z H while a part lies on the seabed
    const double wz = chain.weight * chain.height, v = std::sqrt(wz * wz + 2.0 * wz * h);
    ASSERT_LT(v, chain.weight * chain.length);
    EXPECT_NEAR(vertical_tension(stiff, h) / v, 1.0, 1e-9);
    EXPECT_NEAR(line_shape(stiff, h, v).x, chain.length - v / chain.weight + h / chain.weight * std::asinh(v / h),
                1e-7);
  }
}

TEST(Catenary, NearlyWeightlessIsASpring) {
  const LineProperties rope{500.0, 1.0, 1e7, 30.0};
  for (const double h : {1e6, 3e6}) {
    const LineShape shape = line_shape(rope, h, vertical_tension(rope, h));
    const double span = std::hypot(shape.x, rope.height), tension = h * span / shape.x;
    // the sag shortens the span by (w L / T)^2 / 24 of it
    EXPECT_NEAR(span / (rope.length * (1.0 + tension / rope.stiffness)), 1.0,
                std::pow(500.0 / tension, 2) / 12.0 + 1e-12);
  }
}

TEST(Catenary, BothFormsMeetWhereTheWholeLineHangs) {
  const double h = 5e6, v = chain.weight * chain.length;
  const LineShape below = line_shape(chain, h, v * (1.0 - 1e-12)), above = line_shape(chain, h, v);
  EXPECT_NEAR(below.x, above.x, 1e-9);
  EXPECT_NEAR(below.z, above.z, 1e-9);
  EXPECT_NEAR(below.x_of_h, above.x_of_h, 1e-15);
  EXPECT_NEAR(below.z_of_v, above.z_of_v, 1e-15);
}

TEST(Catenary, DerivativesAreThoseOfTheShape) {
  for (const double h : {1e4, 1e6, 2e7})
    for (const double v : {1e5, 5e5, 1e6, 3e6}) {
      const double dh = 1e-5 * h, dv = 1e-5 * v;
      const LineShape at = line_shape(chain, h, v);
      const double x_of_h = (line_shape(chain, h + dh, v).x - line_shape(chain, h - dh, v).x) / (2.0 * dh);
      const double z_of_h = (line_shape(chain, h + dh, v).z - line_shape(chain, h - dh, v).z) / (2.0 * dh);
      const double x_of_v = (line_shape(chain, h, v + dv).x - line_shape(chain, h, v - dv).x) / (2.0 * dv);
      const double z_of_v = (line_shape(chain, h, v + dv).z - line_shape(chain, h, v - dv).z) / (2.0 * dv);
      // places of 600 m round to 1e-13 m, over steps of 1e-5 of the tension
      const double rounding_h = 2e-12 / dh, rounding_v = 2e-12 / dv;
      EXPECT_NEAR(at.x_of_h, x_of_h, 1e-8 * std::fabs(x_of_h) + rounding_h);
      EXPECT_NEAR(at.z_of_h, z_of_h, 1e-8 * std::fabs(z_of_h) + rounding_h);
      EXPECT_NEAR(at.z_of_h, x_of_v, 1e-8 * std::fabs(x_of_v) + rounding_v) << "x over V is z over H";
      EXPECT_NEAR(at.z_of_v, z_of_v, 1e-8 * std::fabs(z_of_v) + rounding_v);
    }
}

TEST(Catenary, CurveHasTheTensionsOfTheClosedForm) {
  const std::vector<CurveKnot> curve = smooth_curve(line_samples(chain, 1e7));
  const auto count = static_cast<std::int32_t>(curve.size());
  double worst = 0.0, worst_tension = 0.0;
  for (double h = 1e3; h < 3.5e7; h *= 1.037) {
    const double v = vertical_tension(chain, h);
    const CurvePoint at = curve_at(curve.data(), count, line_shape(chain, h, v).x);
    worst = std::max(worst, std::fabs(at.force / h - 1.0));
    worst_tension = std::max(worst_tension, std::fabs(at.beside / std::hypot(h, v) - 1.0));
  }
  EXPECT_LT(worst, 1e-6);
  EXPECT_LT(worst_tension, 1e-6);
  // slack before it hangs straight down: H = 0, and the weight of the hanging part
  const double rest = vertical_tension(chain, 0.0);
  EXPECT_EQ(curve_at(curve.data(), count, 100.0).force, 0.0);
  EXPECT_EQ(curve_at(curve.data(), count, 100.0).beside, rest);
  EXPECT_NEAR(rest + rest * rest / (2.0 * chain.stiffness), chain.weight * chain.height, 1e-8);
}

}  // namespace
}  // namespace gem
