// Curves and tables of moorings: values, energies, and forces that are the gradient of the energy.
#include "gem/events/platform/mooring_laws.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/events/platform/mooring_tables.h"

namespace gem {
namespace {

const std::vector<ForceRow> hardening = {{1.0, 0.0}, {3.0, 1e6}, {4.0, 4e6}};

CurvePoint at(const std::vector<CurveKnot>& curve, double x) {
  return curve_at(curve.data(), static_cast<std::int32_t>(curve.size()), x);
}

TEST(ForceCurve, IsLinearBetweenItsRowsWithTheEnergyBelowIt) {
  const std::vector<CurveKnot> curve = linear_curve(hardening);
  EXPECT_EQ(at(curve, 0.0).force, 0.0) << "slack";
  EXPECT_EQ(at(curve, 1.0).energy, 0.0);
  EXPECT_DOUBLE_EQ(at(curve, 2.0).force, 5e5);
  EXPECT_DOUBLE_EQ(at(curve, 2.0).energy, 2.5e5);
  EXPECT_DOUBLE_EQ(at(curve, 3.0).force, 1e6);
  EXPECT_DOUBLE_EQ(at(curve, 4.0).energy, 1e6 + 2.5e6);
  EXPECT_DOUBLE_EQ(at(curve, 5.0).force, 7e6) << "the last slope goes on";
  EXPECT_DOUBLE_EQ(at(curve, 5.0).energy, 3.5e6 + 5.5e6);
  EXPECT_DOUBLE_EQ(at(curve, 3.5).slope, 3e6);
}

TEST(ForceCurve, IsSmoothThroughItsSamples) {
  // a cubic is its own Hermite interpolant
  const auto cubic = [](double x) { return 2.0 + x * (1.0 - x * (0.5 - 0.25 * x)); };
  const auto slope = [](double x) { return 1.0 - x * (1.0 - 0.75 * x); };
  std::vector<CurveSample> samples;
  for (const double x : {0.0, 0.7, 1.0, 3.0}) samples.push_back({x, cubic(x), slope(x), -cubic(x), -slope(x)});
  const std::vector<CurveKnot> curve = smooth_curve(samples);
  for (const double x : {0.1, 0.7, 0.9, 2.0, 3.0}) {
    EXPECT_NEAR(at(curve, x).force, cubic(x), 1e-14);
    EXPECT_NEAR(at(curve, x).beside, -cubic(x), 1e-14);
    EXPECT_NEAR(at(curve, x).slope, slope(x), 1e-14);
    EXPECT_NEAR(at(curve, x).energy, x * (2.0 + x * (0.5 - x * (0.5 / 3.0 - x * 0.0625))), 1e-14);
  }
  EXPECT_NEAR(at(curve, 5.0).force, cubic(3.0) + 2.0 * slope(3.0), 1e-14);
}

/// Largest difference of a pull from minus the gradient of its energy, over the largest force.
template <class Pull>
double worst_gradient(Pull pull) {
  constexpr double step = 1e-5;
  double worst = 0.0, largest = 0.0;
  for (int k = 0; k < 200; ++k) {
    const double angle = 0.0314 * k + 0.003, r = 0.2 + 0.021 * k;
    const Vec2 at{r * std::cos(angle), r * std::sin(angle)};
    const Vec2 force = pull(at).force;
    const auto slope = [&](Vec2 d) { return (pull(at + d).energy - pull(at - d).energy) / (2.0 * step); };
    worst = std::max(worst, length(force + Vec2{slope({step, 0.0}), slope({0.0, step})}));
    largest = std::max(largest, length(force));
  }
  EXPECT_GT(largest, 0.0);
  return worst / largest;
}

TEST(MooringTable, PullsTowardsTheAnchor) {
  const MooringTables tables = mooring_tables(MooringLaw::table, {hardening, {}});
  const MooringPull pull = table_pull(tables.view(), {-1.2, 1.6});
  EXPECT_DOUBLE_EQ(pull.force.x, 3e5);
  EXPECT_DOUBLE_EQ(pull.force.y, -4e5);
  EXPECT_EQ(table_pull(tables.view(), {}).force.x, 0.0);
  EXPECT_EQ(table_pull(tables.view(), {0.5, 0.5}).energy, 0.0);
}

/// Directions at uneven angles, each with its own stiffness.
std::vector<DirectionRow> uneven() {
  std::vector<DirectionRow> rows;
  for (const auto& [angle, stiffness] : {std::pair{-1.0, 1e5}, {0.3, 4e5}, {1.7, 2e5}, {3.0, 3e5}, {4.2, 2.5e5}})
    rows.insert(rows.end(), {{angle, 0.0, 0.0}, {angle, 2.0, 2.0 * stiffness}, {angle, 5.0, 8.0 * stiffness}});
  return rows;
}

TEST(MooringTable, ByDirectionIsTheGradientOfItsEnergy) {
  const MooringTables tables = mooring_tables(MooringLaw::table, {{}, uneven()});
  // the difference quotient of a quadratic energy is exact; its rounding is 1e-16 U / step, and where the slope of the
  // force jumps by 2e5 N/m the quotient is off by half of that times the step
  EXPECT_LT(worst_gradient([&](Vec2 offset) { return table_pull(tables.view(), offset); }), 2e-6);
}

TEST(MooringTable, ByDirectionHasTheForceOfItsRowsAndIsSmoothThere) {
  const MooringTables tables = mooring_tables(MooringLaw::table, {{}, uneven()});
  for (const auto& [angle, stiffness] : {std::pair{0.3, 4e5}, {1.7, 2e5}, {4.2, 2.5e5}})
    for (const double beside : {-1e-9, 0.0, 1e-9}) {
      const Vec2 e{std::cos(angle + beside), std::sin(angle + beside)};
      const Vec2 force = table_pull(tables.view(), 1.5 * e).force;
      EXPECT_NEAR(dot(force, e), -1.5 * stiffness, 1e-6 * stiffness);
      EXPECT_NEAR(cross(force, e), 0.0, 1e-6 * stiffness);
    }
}

TEST(MooringTable, TheSameInAllDirectionsIsTheRadialOne) {
  std::vector<DirectionRow> rows;
  for (const double angle : {0.0, 1.5, 3.0, 4.5})
    for (const ForceRow& row : hardening) rows.push_back({angle, row[0], row[1]});
  const MooringTables all = mooring_tables(MooringLaw::table, {{}, rows});
  const MooringTables one = mooring_tables(MooringLaw::table, {hardening, {}});
  for (int k = 0; k < 100; ++k) {
    const Vec2 offset{4.0 * std::cos(0.07 * k), 5.0 * std::sin(0.07 * k)};
    EXPECT_EQ(table_pull(all.view(), offset).force.x, table_pull(one.view(), offset).force.x);
    EXPECT_EQ(table_pull(all.view(), offset).energy, table_pull(one.view(), offset).energy);
  }
}

TEST(MooringLaws, ALineBreaksAboveItsStrengthAndStaysBroken) {
  MooringDesign design;
  design.line_height_m = 40.0;
  for (const double side : {1.0, -1.0})
    design.lines.push_back({side * 640.0, 0.0, side * 50.0, 0.0, 600.0, 1400.0, 7e8, 0.0});
  MooringTables tables = mooring_tables(MooringLaw::catenary, design);
  MooringLaws laws;
  laws.law = MooringLaw::catenary;
  laws.view = tables.view();
  const Rotation ahead{1.0, 0.0};
  EXPECT_EQ(broken_after(laws, {100.0, 0.0}, ahead, 0), 0U) << "without a strength no line breaks";
  const double tension = line_tension(laws.view, 1, {1.0, 0.0}, ahead);
  for (MooringBranch& line : tables.branch) line.strength = tension;
  EXPECT_EQ(broken_after(laws, {1.0, 0.0}, ahead, 0), 0U) << "it holds its strength";
  EXPECT_EQ(broken_after(laws, {1.001, 0.0}, ahead, 0), 2U);
  EXPECT_EQ(broken_after(laws, {-1.001, 0.0}, ahead, 2), 3U) << "a broken line stays broken";
  EXPECT_EQ(lines_pull(laws.view, {1.0, 0.0}, ahead, 3).energy, 0.0);
  EXPECT_LT(lines_pull(laws.view, {1.0, 0.0}, ahead, 1).force.x, 0.0) << "only the line at -x pulls";
}

}  // namespace
}  // namespace gem
