// Corners and sides where pieces touch, and the axes that a contact may have there.
#include <gtest/gtest.h>

#include <cmath>

#include "gem/geometry/piece_axis.h"

namespace gem {
namespace {

using Outlines = std::vector<std::vector<Vec2>>;

std::vector<Vec2> box(Vec2 low, Vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

bool has(const PieceCorner& corner, Vec2 normal) { return corner.has_normal && corner.normals.hold(normal); }

TEST(PieceJoints, HalvesOfASquareGoStraightOn) {
  const auto corners = piece_corners({box({-2.0, -1.0}, {0.0, 1.0}), box({0.0, -1.0}, {2.0, 1.0})});
  ASSERT_EQ(corners.size(), 8U);
  EXPECT_FALSE(corners[0].is_joint);
  EXPECT_TRUE(has(corners[0], {-0.6, -0.8}));
  const PieceCorner& joint = corners[2];  // (0, 1) of the left half
  EXPECT_TRUE(joint.is_joint);
  EXPECT_TRUE(has(joint, {0.0, 1.0}));
  EXPECT_FALSE(has(joint, {0.1, std::sqrt(0.99)}));
  EXPECT_FALSE(has(joint, {-0.1, std::sqrt(0.99)}));
  EXPECT_FALSE(has(joint, {0.0, -1.0}));
  EXPECT_TRUE(corners[1].is_inside) << "the side along the cut";
  EXPECT_TRUE(corners[7].is_inside) << "the same of the right half";
  for (const std::size_t k : {0, 2, 3, 4, 5, 6}) EXPECT_FALSE(corners[k].is_inside) << k;
}

/// An L, cut from its inner corner to the outer one.
const Outlines cut_askew = {{{0.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}},
                            {{0.0, 0.0}, {1.0, 1.0}, {1.0, 2.0}, {0.0, 2.0}}};

TEST(PieceJoints, AnOuterCornerHasTheNormalsOfTheWhole) {
  const auto corners = piece_corners(cut_askew);
  for (const std::size_t k : {0, 4}) {
    EXPECT_TRUE(corners[k].is_joint);
    EXPECT_TRUE(has(corners[k], {-0.6, -0.8})) << k;
    EXPECT_TRUE(has(corners[k], {-1.0, 0.0})) << k;
    EXPECT_TRUE(has(corners[k], {0.0, -1.0})) << k;
    EXPECT_FALSE(has(corners[k], {0.1, -std::sqrt(0.99)})) << k;
    EXPECT_FALSE(has(corners[k], {-std::sqrt(0.99), 0.1})) << k;
  }
}

TEST(PieceJoints, AnInnerCornerHasNone) {
  const auto corners = piece_corners(cut_askew);
  for (const std::size_t k : {3, 5}) {
    EXPECT_TRUE(corners[k].is_joint);
    EXPECT_FALSE(corners[k].has_normal) << k;
  }
  EXPECT_TRUE(corners[3].is_inside);
  EXPECT_TRUE(corners[4].is_inside);
}

TEST(PieceJoints, ASponsonHidesItsInnerSideButNotThatOfTheHull) {
  const auto corners = piece_corners({box({-10.0, -2.0}, {10.0, 2.0}), box({-1.0, 2.0}, {1.0, 4.0})});
  EXPECT_FALSE(corners[2].is_inside) << "the side of the hull is free beside the sponson";
  EXPECT_TRUE(corners[4].is_inside) << "the inner side of the sponson";
  EXPECT_TRUE(corners[4].is_joint);
  EXPECT_FALSE(corners[4].has_normal);
}

TEST(PieceJoints, TwoPiecesMayCoverASideTogether) {
  const auto corners =
      piece_corners({box({0.0, 0.0}, {4.0, 1.0}), box({-1.0, 1.0}, {2.0, 2.0}), box({2.0, 1.0}, {4.0, 2.0})});
  EXPECT_TRUE(corners[2].is_inside);
}

TEST(PieceJoints, PiecesApartAreFree) {
  for (const PieceCorner& corner : piece_corners({box({0.0, 0.0}, {1.0, 1.0}), box({1.1, 0.0}, {2.0, 1.0})})) {
    EXPECT_FALSE(corner.is_joint);
    EXPECT_FALSE(corner.is_inside);
  }
}

struct World {
  std::vector<Vec2> corner, normal;
  explicit World(const std::vector<Vec2>& outline) : corner(outline) {
    for (std::size_t k = 0; k < outline.size(); ++k) {
      const Vec2 along = outline[(k + 1) % outline.size()] - outline[k];
      normal.push_back((1.0 / length(along)) * turned_right(along));
    }
  }
  Outline view() const { return {corner.data(), normal.data(), static_cast<int>(corner.size())}; }
};

/// The axis of the right half of a square and a diamond whose lowest corner stands at `tip`.
PieceAxis axis_at(Vec2 tip, Separation& axis) {
  const Outlines halves = {box({-2.0, -1.0}, {0.0, 1.0}), box({0.0, -1.0}, {2.0, 1.0})};
  const auto corners = piece_corners(halves);
  const World a(halves[1]), b({{0.0, -1.0}, {1.0, 0.0}, {0.0, 1.0}, {-1.0, 0.0}});
  const Vec2 offset = tip + Vec2{0.0, 1.0};
  axis = find_axes(a.view(), b.view(), offset).first;
  return find_outer_axis(a.view(), &corners[4], {1.0, 0.0}, b.view(), offset, axis);
}

TEST(PieceJoints, ACornerBeforeTheJointGetsTheNormalOfTheSide) {
  Separation axis;
  EXPECT_EQ(axis_at({-0.01, 1.0}, axis), PieceAxis::replaced);
  EXPECT_FALSE(axis.edge_of_b);
  EXPECT_EQ(axis.edge, 2);
  EXPECT_NEAR(axis.distance, 0.0, 1e-15);
  EXPECT_EQ(axis_at({0.5, 1.0 - 0.01}, axis), PieceAxis::outer) << "behind the joint";
  EXPECT_NEAR(axis.distance, -0.01, 1e-15);
}

TEST(PieceJoints, AFloeThatNoOuterSideFacesHasNoContact) {
  Separation axis;
  EXPECT_EQ(axis_at({-0.6, 0.0 - 1.0}, axis), PieceAxis::none) << "within the left half";
}

}  // namespace
}  // namespace gem
