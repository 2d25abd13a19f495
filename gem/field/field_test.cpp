// Generated fields: they have the paper's statistics, no contact at the start, and the same bits for the same seed.
#include "gem/field/field.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "gem/base/error.h"
#include "gem/base/hash.h"
#include "gem/field/channel.h"
#include "gem/field/check_field.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

std::uint64_t hash_of(const Bodies& b, bool with_places) {
  Hash hash;
  for (const Vec2 p : b.vertex) hash.add(p.x), hash.add(p.y);
  for (const std::int32_t v : b.vertex_begin) hash.add(static_cast<std::uint64_t>(v));
  for (std::size_t i = 0; with_places && i < b.count(); ++i) {
    for (const double x : {b.position[i].x, b.position[i].y, b.rotation[i].cosine, b.rotation[i].sine, b.mass[i],
                           b.inertia[i], b.thickness[i], b.drag[i], b.spin_drag[i]})
      hash.add(x);
  }
  return hash.value();
}

/// Sizes of the floes in id order, rounded: the floe set without positions.
std::vector<double> sizes_of(const Bodies& b) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < b.count(); ++i)
    if (b.kind[i] == BodyKind::floe) sizes.push_back(std::round(1e9 * b.area[i]));
  return sizes;
}

SceneDef small_scene() {
  SceneDef scene;
  scene.floes.count = 200;
  scene.floes.length_m = 150.0;
  scene.floes.width_m = 200.0;
  scene.boundary.present = false;
  return scene;
}

TEST(Field, PaperStatisticsForFiveSeeds) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SceneDef scene;
    scene.run.seed = seed;
    const Bodies b = make_field(scene);
    const FieldSummary s = summarise(scene, b);
    EXPECT_EQ(s.floe_count, 4008);
    EXPECT_NEAR(s.size_mean, 6.9, 0.05);
    EXPECT_NEAR(s.size_deviation, 3.9, 0.05);
    EXPECT_NEAR(s.cover, 0.4196, 0.005);
    EXPECT_GE(s.size_minimum, 2.0);
    EXPECT_LE(s.size_maximum, 20.0);
    EXPECT_GE(s.smallest_gap, scene.floes.gap_m);
    EXPECT_LT(s.smallest_gap, 1.0);
    EXPECT_LT(s.sides.size(), 20U);
    // Expected shares 25, 35, 25, 14 %; four standard errors of 4008 draws are at most 3 %.
    const double expected[] = {0.25, 0.35, 0.25, 0.14};
    for (std::size_t n = 4; n <= 7; ++n) EXPECT_NEAR(static_cast<double>(s.sides[n]) / 4008.0, expected[n - 4], 0.03);
    EXPECT_EQ(s.sides[3], 0);
  }
}

TEST(Field, SmallestGapAgreesWithAllPairs) {
  const SceneDef scene = small_scene();
  const Bodies b = make_field(scene);
  double smallest = 1e9;
  for (std::size_t i = 1; i < b.count(); ++i)
    for (std::size_t j = i + 1; j < b.count(); ++j)
      smallest = std::min(smallest, convex_separation(world_outline(b, i), world_outline(b, j)));
  EXPECT_EQ(summarise(scene, b).smallest_gap, smallest);
  EXPECT_GE(smallest, 0.05);
}

TEST(Field, SameSeedSameBitsAndOtherSeedOtherField) {
  SceneDef scene = small_scene();
  const std::uint64_t first = hash_of(make_field(scene), true);
  EXPECT_EQ(first, hash_of(make_field(scene), true));
  scene.run.seed = 2;
  EXPECT_NE(first, hash_of(make_field(scene), true));
}

TEST(Field, FloesAreNumberedAlongTheChannel) {
  const Bodies b = make_field(small_scene());
  ASSERT_GT(b.count(), 2U);
  for (std::size_t i = 2; i < b.count(); ++i) EXPECT_LE(b.position[i - 1].x, b.position[i].x);
}

TEST(Field, FloesKeepInsideTheNarrowingChannelAndAreTheSameFloes) {
  std::vector<double> sizes;
  for (const double gap : {400.0, 300.0, 200.0}) {
    SceneDef scene;
    scene.boundary.gap_m = gap;
    const Bodies b = make_field(scene);
    std::size_t checked = 0;
    for (std::size_t i = 0; i < b.count(); ++i) {
      if (b.kind[i] != BodyKind::floe) continue;
      ASSERT_TRUE(inside_channel(scene.boundary, world_outline(b, i)));
      ++checked;
    }
    EXPECT_EQ(checked, 4008U);
    EXPECT_GE(summarise(scene, b).smallest_gap, scene.floes.gap_m);
    std::vector<double> here = sizes_of(b);
    std::sort(here.begin(), here.end());
    if (sizes.empty()) sizes = here;
    EXPECT_EQ(sizes, here);
  }
}

TEST(Field, PacksFourFifths) {
  SceneDef scene = small_scene();
  scene.floes.count = 128;
  scene.floes.length_m = 100.0;
  scene.floes.width_m = 100.0;
  const Bodies b = make_field(scene);
  const FieldSummary s = summarise(scene, b);
  EXPECT_GE(s.cover, 0.8);
  EXPECT_GE(s.smallest_gap, scene.floes.gap_m);
  for (std::size_t i = 1; i < b.count(); ++i) {
    for (const Vec2 p : world_outline(b, i)) {
      EXPECT_GE(p.x, scene.floes.start_x_m - 1e-9);
      EXPECT_LE(p.x, scene.floes.start_x_m + 100.0 + 1e-9);
      EXPECT_LE(std::fabs(p.y), 50.0 + 1e-9);
    }
  }
  EXPECT_EQ(hash_of(b, true), hash_of(make_field(scene), true));
}

TEST(Field, RefusesWhatCannotFit) {
  SceneDef scene = small_scene();
  scene.floes.count = 200;
  scene.floes.length_m = 100.0;
  scene.floes.width_m = 100.0;
  try {
    make_field(scene);
    FAIL() << "125 % cover was accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::scene_rejected);
    EXPECT_NE(std::string(error.what()).find("do not fit"), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find("boundary"), std::string::npos) << error.what();
  }
}

TEST(Field, MixedClassesShareTheAreaAsTheirTenths) {
  SceneDef scene;
  scene.floes.classes = {{"thick", 1.2, 1.0}, {"medium", 0.7, 2.0}, {"thin", 0.5, 1.0}};
  const Bodies b = make_field(scene);
  const FieldSummary s = summarise(scene, b);
  ASSERT_EQ(s.class_share.size(), 3U);
  EXPECT_NEAR(s.class_share[0], 0.25, 0.005);
  EXPECT_NEAR(s.class_share[1], 0.50, 0.005);
  EXPECT_NEAR(s.class_share[2], 0.25, 0.005);
  EXPECT_NEAR(s.asked_cover, 0.4, 1e-15);
  const std::map<std::uint8_t, double> thickness = {{0, 1.2}, {1, 0.7}, {2, 0.5}};
  for (std::size_t i = 0; i < b.count(); ++i)
    if (b.kind[i] == BodyKind::floe) {
      EXPECT_EQ(b.thickness[i], thickness.at(b.ice_class[i]));
    }
}

TEST(Field, CopiesAreFewShapesManyTimes) {
  for (const Placement placement : {Placement::random, Placement::tiled}) {
    SceneDef scene;
    scene.floes.source = FloeSource::copied;
    scene.floes.placement = placement;
    const Bodies b = make_field(scene);
    const FieldSummary s = summarise(scene, b);
    EXPECT_EQ(s.floe_count, 4008);
    EXPECT_NEAR(s.size_mean, 6.9, 0.05);
    EXPECT_NEAR(s.size_deviation, 3.9, 0.05);
    EXPECT_GT(s.smallest_gap, 0.9 * scene.floes.gap_m);
    std::set<std::int64_t> sizes;
    for (std::size_t i = 0; i < b.count(); ++i)
      if (b.kind[i] == BodyKind::floe) sizes.insert(std::llround(1e6 * b.area[i]));
    EXPECT_EQ(sizes.size(), 24U);
  }
}

TEST(Field, TilesRepeatAlongTheChannel) {
  SceneDef scene;
  scene.floes.source = FloeSource::copied;
  scene.floes.placement = Placement::tiled;
  scene.floes.count = 4005;  // 15 blocks of 267
  const Bodies b = make_field(scene);
  const std::size_t first = b.count() - 4005;
  for (std::size_t i = 0; i < 267; ++i) {
    EXPECT_NEAR(b.position[first + 267 + i].x - b.position[first + i].x, 100.0, 1e-9);
    EXPECT_NEAR(b.position[first + 267 + i].y, b.position[first + i].y, 1e-9);
  }
  scene.boundary.gap_m = 300.0;
  EXPECT_THROW(make_field(scene), Error);
}

TEST(Channel, SidesOfThePaper) {
  BoundaryDef boundary;
  boundary.gap_m = 300.0;
  const auto sides = boundary_outlines(boundary);
  ASSERT_EQ(sides.size(), 2U);
  EXPECT_EQ(sides[0].size(), 5U);
  for (const auto& side : sides) EXPECT_EQ(first_non_convex_vertex(side), -1);
  EXPECT_EQ(channel_half_width(boundary, -1600.0), 200.0);
  EXPECT_EQ(channel_half_width(boundary, -800.0), 175.0);
  EXPECT_EQ(channel_half_width(boundary, 30.0), 150.0);
  boundary.gap_m = 400.0;
  EXPECT_EQ(boundary_outlines(boundary)[0].size(), 4U);
}

TEST(Channel, BendsTowardsTheAxisSplitTheSide) {
  BoundaryDef late;
  late.gap_m = 200.0;
  late.taper_start_x_m = -400.0;
  BoundaryDef widening;
  widening.gap_m = 500.0;
  for (const BoundaryDef& boundary : {late, widening}) {
    const auto sides = boundary_outlines(boundary);
    EXPECT_EQ(sides.size(), 4U);
    for (const auto& side : sides) EXPECT_EQ(first_non_convex_vertex(side), -1);
  }
  EXPECT_EQ(channel_half_width(late, -1000.0), 200.0);
  EXPECT_EQ(channel_half_width(late, -200.0), 150.0);
}

TEST(Channel, RefusesAChannelThatCannotBe) {
  BoundaryDef closed;
  closed.gap_m = 0.0;
  EXPECT_THROW(boundary_outlines(closed), Error);
  BoundaryDef behind;
  behind.inlet_x_m = 10.0;
  EXPECT_THROW(boundary_outlines(behind), Error);
}

TEST(Field, OneFloeIsMovedAndNoOther) {
  SceneDef scene = small_scene();
  const Bodies before = make_field(scene);
  scene.floes.moved_floe = 7;
  scene.floes.moved_by_m = {1e-6, 0.0};
  const Bodies after = make_field(scene);
  const std::size_t first = before.count() - 200;
  std::size_t moved = 0;
  for (std::size_t i = first; i < before.count(); ++i) {
    EXPECT_EQ(before.position[i].y, after.position[i].y);
    if (before.position[i].x == after.position[i].x) continue;
    ++moved;
    EXPECT_NEAR(after.position[i].x - before.position[i].x, 1e-6, 1e-12);
    const auto nearer =
        std::count_if(before.position.begin() + static_cast<std::ptrdiff_t>(first), before.position.end(),
                      [&](Vec2 p) { return length(p) < length(before.position[i]); });
    EXPECT_EQ(nearer, 7);
  }
  EXPECT_EQ(moved, 1U);
  scene.floes.moved_floe = 200;
  EXPECT_THROW(make_field(scene), Error);
}

}  // namespace
}  // namespace gem
