// Cuts of outlines whose parts are known, and of random ones: parts are convex and keep the area.
#include "gem/geometry/cut_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "gem/base/random.h"
#include "gem/geometry/polygon.h"

namespace gem {
namespace {

const std::vector<Vec2> square = {{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}, {0.0, 2.0}};

TEST(CutOutline, HalvesASquare) {
  const auto cut = cut_outline(square, {1.0, 0.0}, {0.0, 1.0}, 1e-3);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->length, 2.0);
  EXPECT_EQ(polygon_moments(cut->left).area, 2.0);
  EXPECT_EQ(polygon_moments(cut->left).centroid.x, 0.5);
  EXPECT_EQ(polygon_moments(cut->right).centroid.x, 1.5);
}

TEST(CutOutline, EndsAtACornerThatIsNear) {
  const double slope = 1.0 / std::sqrt(2.0);
  const auto cut = cut_outline(square, {1e-4, 0.0}, {slope, slope}, 1e-3);
  ASSERT_TRUE(cut);
  EXPECT_EQ(cut->left.size(), 3u);
  EXPECT_EQ(cut->right.size(), 3u);
  EXPECT_EQ(polygon_moments(cut->left).area, 2.0);
}

TEST(CutOutline, RefusesALineThatMissesOrTouches) {
  EXPECT_FALSE(cut_outline(square, {3.0, 0.0}, {0.0, 1.0}, 1e-3));
  EXPECT_FALSE(cut_outline(square, {2.0, 0.0}, {0.0, 1.0}, 1e-3));
  EXPECT_FALSE(cut_outline(square, {2.0, 0.0}, {std::sqrt(0.5), std::sqrt(0.5)}, 1e-3));
}

TEST(CutOutline, PartsOfRandomOutlinesAreConvexAndKeepTheArea) {
  RandomSequence random(Random(7, 0));
  int cuts = 0;
  for (int k = 0; k < 2000; ++k) {
    std::vector<Vec2> outline;
    const int corners = 3 + k % 12;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.8 * random.uniform()) / corners;
      outline.push_back({10.0 * std::cos(angle), 7.0 * std::sin(angle)});
    }
    const double angle = 2.0 * std::numbers::pi * random.uniform();
    const PolygonMoments whole = polygon_moments(outline);
    const auto cut = cut_outline(outline, whole.centroid, {std::cos(angle), std::sin(angle)}, 1e-3);
    if (!cut) continue;
    ++cuts;
    EXPECT_EQ(first_non_convex_vertex(cut->left), -1);
    EXPECT_EQ(first_non_convex_vertex(cut->right), -1);
    EXPECT_LE(cut->left.size() + cut->right.size(), outline.size() + 4);
    // areas of 1e2 m2 with 53 bits: 1e-14 relative; a corner that is snapped moves no area
    EXPECT_NEAR(polygon_moments(cut->left).area + polygon_moments(cut->right).area, whole.area, 1e-11);
  }
  EXPECT_GT(cuts, 1900);
}

}  // namespace
}  // namespace gem
