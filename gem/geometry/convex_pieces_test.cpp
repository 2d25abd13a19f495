// Convex pieces: area is conserved, corners are kept, the order is always the same.
#include "gem/geometry/convex_pieces.h"

#include <gtest/gtest.h>

#include <cmath>

#include "gem/geometry/polygon.h"

namespace gem {
namespace {

using Corners = std::vector<Vec2>;

double area_of_pieces(const std::vector<Corners>& pieces) {
  double sum = 0.0;
  for (const Corners& piece : pieces) sum += polygon_moments(piece).area;
  return sum;
}

/// A star-shaped outline with deep bays.
Corners star(int corners) {
  Corners outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * 3.141592653589793 * i / corners;
    const double radius = 10.0 + 7.0 * std::sin(3.7 * i) * std::cos(1.3 * i);
    outline.push_back({100.0 + radius * std::cos(angle), -50.0 + radius * std::sin(angle)});
  }
  return outline;
}

TEST(ConvexPieces, AnAngleGivesTwo) {
  const Corners angle = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
  const auto pieces = convex_pieces(angle, 20);
  EXPECT_LE(pieces.size(), 3U);
  EXPECT_GE(pieces.size(), 2U);
  EXPECT_NEAR(area_of_pieces(pieces), 3.0, 1e-12);
}

TEST(ConvexPieces, AConvexOutlineStaysWhole) {
  const Corners square = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  const auto pieces = convex_pieces(square, 20);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].size(), 4U);
}

TEST(ConvexPieces, StarsKeepTheirAreaInConvexPiecesOfFewCorners) {
  for (const int corners : {7, 30, 101, 200}) {
    const Corners outline = star(corners);
    ASSERT_EQ(crossing_edges(outline).first, outline.size());
    const auto pieces = convex_pieces(outline, 20);
    ASSERT_GT(pieces.size(), 1U);
    // Each corner has a rounding of 1e-14 m on 100 m, times edges of some 20 m.
    EXPECT_NEAR(area_of_pieces(pieces), polygon_moments(outline).area, 1e-10);
    for (const Corners& piece : pieces) {
      EXPECT_EQ(first_non_convex_vertex(piece), -1);
      EXPECT_LE(piece.size(), 20U);
    }
    // At most four times the least number, which is at least half the number of bays.
    EXPECT_LT(pieces.size(), outline.size() - 2);
    const auto again = convex_pieces(outline, 20);
    ASSERT_EQ(again.size(), pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (std::size_t k = 0; k < pieces[i].size(); ++k) EXPECT_EQ(again[i][k].x, pieces[i][k].x);
  }
}

TEST(ConvexPieces, APolygonOfManyCornersIsCutToTheLimit) {
  Corners ring;
  for (int i = 0; i < 60; ++i) ring.push_back({10.0 * std::cos(0.104719755 * i), 10.0 * std::sin(0.104719755 * i)});
  const auto pieces = convex_pieces(ring, 20);
  EXPECT_GE(pieces.size(), 4U);
  for (const Corners& piece : pieces) EXPECT_LE(piece.size(), 20U);
  EXPECT_NEAR(area_of_pieces(pieces), polygon_moments(ring).area, 1e-11);
}

TEST(ConvexPieces, CornersOnALineOfOtherCornersAreCut) {
  // A comb: the feet of its teeth lie on one line.
  const Corners comb = {{0, 0}, {6, 0}, {6, 2}, {5, 2}, {5, 1}, {4, 1}, {4, 2}, {3, 2}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};
  const auto pieces = convex_pieces(comb, 20);
  ASSERT_FALSE(pieces.empty());
  EXPECT_NEAR(area_of_pieces(pieces), 9.0, 1e-12);
  for (const Corners& piece : pieces) EXPECT_EQ(first_non_convex_vertex(piece), -1);
}

TEST(ConvexPieces, CrossingEdgesAreFound) {
  const CrossingEdges bow = crossing_edges({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  EXPECT_EQ(bow.first, 0U);
  EXPECT_EQ(bow.second, 2U);
  // A corner that touches another edge.
  EXPECT_LT(crossing_edges({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}).first, 5U);
}

TEST(ConvexHull, OfAnAngleLeavesOutTheInnerCornerAndThoseOnLines) {
  const Corners hull = convex_hull({{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}});
  EXPECT_EQ(hull.size(), 5U);
  EXPECT_DOUBLE_EQ(polygon_moments(hull).area, 3.5);
}

}  // namespace
}  // namespace gem
