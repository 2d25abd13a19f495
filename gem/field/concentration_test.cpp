// Fields of an asked concentration: reached within half a floe, without overlap, with the sizes of the law.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "gem/base/error.h"
#include "gem/base/hash.h"
#include "gem/field/check_field.h"
#include "gem/field/field.h"
#include "gem/field/generator/field_region.h"
#include "gem/field/generator/size_law.h"
#include "gem/field/reached_concentration.h"

namespace gem {
namespace {

SceneDef packed_scene(double concentration) {
  SceneDef scene;
  scene.floes.concentration = concentration;
  scene.floes.length_m = 200.0;
  scene.floes.width_m = 150.0;
  scene.floes.start_x_m = -300.0;
  scene.boundary.present = false;
  return scene;
}

std::uint64_t outline_hash(const Bodies& bodies) {
  Hash hash;
  for (std::size_t i = 0; i < bodies.count(); ++i)
    for (const Vec2 p : world_outline(bodies, i)) hash.add(p.x), hash.add(p.y);
  return hash.value();
}

std::vector<double> sorted_sizes(const Bodies& bodies) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.kind[i] == BodyKind::floe) sizes.push_back(std::sqrt(bodies.area[i]));
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

class Concentration : public testing::TestWithParam<double> {};

TEST_P(Concentration, IsReachedWithoutOverlapAndWithTheSizesOfTheLaw) {
  for (const std::uint64_t seed : {1U, 7U}) {
    SceneDef scene = packed_scene(GetParam());
    scene.run.seed = seed;
    const Bodies bodies = make_field(scene);
    // Areas again, by themselves: corners inside the rectangle make the cut needless.
    double area = 0.0;
    for (std::size_t i = 0; i < bodies.count(); ++i) {
      if (bodies.kind[i] != BodyKind::floe) continue;
      area += bodies.area[i];
      for (const Vec2 p : world_outline(bodies, i)) {
        EXPECT_TRUE(p.x >= -300.0 - 1e-9 && p.x <= -100.0 + 1e-9 && std::fabs(p.y) <= 75.0 + 1e-9);
      }
    }
    const ReachedConcentration reached = reached_concentration(scene, bodies);
    EXPECT_NEAR(reached.reached, area / (200.0 * 150.0), 1e-12);
    // Half a floe of 6.9^2 + 3.9^2 = 62.8 m2 in 30000 m2.
    EXPECT_NEAR(reached.tolerance, 0.5 * 62.82 / 30000.0, 1e-12);
    // The quantiles of some hundred floes miss the law's mean area by less than 1 part in 1000.
    EXPECT_NEAR(reached.reached, GetParam(), reached.tolerance + 1e-3 * GetParam());
    EXPECT_GE(summarise(scene, bodies).smallest_gap, scene.floes.gap_m - 1e-9);
    const std::vector<double> sizes = sorted_sizes(bodies);
    const TruncatedSizeLaw law(scene.floes);
    for (std::size_t i = 0; i < sizes.size(); ++i)
      EXPECT_NEAR(sizes[i], law.quantile((double(i) + 0.5) / double(sizes.size())), 1e-9);
  }
}

TEST_P(Concentration, TheSeedDecidesEveryBit) {
  SceneDef scene = packed_scene(GetParam());
  const std::uint64_t first = outline_hash(make_field(scene));
  EXPECT_EQ(outline_hash(make_field(scene)), first);
  scene.run.seed = 2;
  EXPECT_NE(outline_hash(make_field(scene)), first);
}

INSTANTIATE_TEST_SUITE_P(Shares, Concentration, testing::Values(0.05, 0.5, 0.7, 0.8, 0.9, 0.95));

TEST(Concentration, ClassesKeepTheirRatio) {
  SceneDef scene = packed_scene(0.9);
  scene.floes.classes = {{"thin", 0.3, 6.0}, {"thick", 1.2, 3.0}};
  const FieldSummary summary = summarise(scene, make_field(scene));
  EXPECT_NEAR(summary.class_share[0], 2.0 / 3.0, 2e-3);
  EXPECT_EQ(summary.thickness_maximum, 1.2);
}

TEST(Concentration, IsThatOfTheWaterBetweenBoundaryAndObstacles) {
  SceneDef scene = packed_scene(0.85);
  scene.fixed.push_back({{{-220.0, -15.0}, {-180.0, -15.0}, {-180.0, 15.0}, {-220.0, 15.0}}});
  scene.boundary = {true, -320.0, 150.0, -320.0, 110.0, 60.0};
  const Bodies bodies = make_field(scene);
  // The channel narrows by 40 m over 320 m: at x = -300 it is 147.5 m wide, at -100 122.5 m.
  const double water = 200.0 * 0.5 * (147.5 + 122.5) - 40.0 * 30.0;
  double area = 0.0;
  for (std::size_t i = 0; i < bodies.count(); ++i)
    if (bodies.kind[i] == BodyKind::floe) area += bodies.area[i];
  EXPECT_NEAR(area / water, 0.85, 0.5 * 62.82 / water + 1e-3);
  EXPECT_NEAR(reached_concentration(scene, bodies).reached, area / water, 1e-12);
  EXPECT_GE(summarise(scene, bodies).smallest_gap, scene.floes.gap_m - 1e-9);
}

TEST(Concentration, WhatWasReachedIsSaidWhenItIsNotEnough) {
  SceneDef scene = packed_scene(0.95);
  scene.floes.gap_m = 0.5;
  try {
    make_field(scene);
    FAIL() << "a gap of 0.5 m around floes of 6.9 m leaves less than 0.95";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("0.95 was not reached (0.8"), std::string::npos) << error.what();
  }
}

TEST(Concentration, AreaWithinABoxIsCutExactly) {
  const Box box = {{0.0, 0.0}, {2.0, 1.0}};
  EXPECT_DOUBLE_EQ(area_within(box, {{1.0, -1.0}, {3.0, -1.0}, {3.0, 0.5}, {1.0, 0.5}}), 0.5);
  EXPECT_DOUBLE_EQ(free_area(box, {{{1.0, -1.0}, {3.0, -1.0}, {3.0, 0.5}, {1.0, 0.5}}}), 1.5);
  EXPECT_EQ(area_within(box, {{5.0, 5.0}, {6.0, 5.0}, {5.0, 6.0}}), 0.0);
}

}  // namespace
}  // namespace gem
