// Face contact: the facing stretch, its features across time steps, and its margin.
#include <gtest/gtest.h>

#include "gem/geometry/test_shapes.h"

namespace gem {
namespace {

using test::face;
using test::rectangle;
using test::Shape;

/// A square turned by a small angle [rad].
Shape tilted_square(double side, double angle) {
  std::vector<Vec2> corners = rectangle(side, side).corner;
  for (Vec2& p : corners) p = {p.x - angle * p.y, p.y + angle * p.x};
  return Shape(corners);
}

TEST(FaceContact, EqualFaces) {
  const Shape square = rectangle(10.0, 10.0);
  for (const double gap : {-0.01, 0.0, 0.02}) {
    const ContactGeometry c = face(square, square, {10.0 + gap, 0.0});
    ASSERT_EQ(c.count, 2);
    EXPECT_DOUBLE_EQ(c.normal.x, 1.0);
    EXPECT_DOUBLE_EQ(c.width, 10.0);
    EXPECT_EQ(c.growth, 0.0);
    for (const ContactPoint& p : c.point) {
      EXPECT_NEAR(p.separation, gap, 1e-14);
      EXPECT_NEAR(p.position.x, 5.0 + 0.5 * gap, 1e-14);
    }
    EXPECT_NEAR(c.point[0].position.y, -5.0, 1e-14);
    EXPECT_NEAR(c.point[1].position.y, 5.0, 1e-14);
  }
}

TEST(FaceContact, ShiftedFacesTouchAtOneCornerOfEach) {
  const Shape square = rectangle(10.0, 10.0);
  const ContactGeometry c = face(square, square, {9.99, 3.0});
  ASSERT_EQ(c.count, 2);
  EXPECT_NEAR(c.width, 7.0, 1e-14);
  EXPECT_NEAR(c.point[0].position.y, -2.0, 1e-14);
  EXPECT_NEAR(c.point[1].position.y, 5.0, 1e-14);
  EXPECT_EQ(c.point[0].feature, 2 * 3 + 1);  // lower left corner of B
  EXPECT_EQ(c.point[1].feature, 2 * 1 + 0);  // upper right corner of A
}

TEST(FaceContact, CornerOnFaceIsOnePoint) {
  const Shape wall = rectangle(4.0, 40.0), square = rectangle(10.0, 10.0, 0.125);
  const double reach = 5.0 * std::sqrt(2.0);
  const ContactGeometry c = face(wall, square, {2.0 + reach - 0.01, 3.0}, 0.001);
  ASSERT_EQ(c.count, 1);
  EXPECT_NEAR(c.point[0].separation, -0.01, 1e-13);
  EXPECT_NEAR(c.point[0].position.y, 3.0, 1e-13);
  EXPECT_NEAR(c.growth, 2.0, 1e-12);
}

TEST(FaceContact, CornerBesideCornerIsTheDeepestOne) {
  const Shape square = rectangle(10.0, 10.0, 0.125);
  const double reach = 5.0 * std::sqrt(2.0);
  const ContactGeometry touching = face(square, square, {2.0 * reach - 0.01, 0.0}, 0.001);
  ASSERT_GE(touching.count, 1);
  EXPECT_NEAR(length(touching.point[0].position - Vec2{reach, 0.0}), 0.0, 0.02);
  EXPECT_EQ(face(square, square, {2.0 * reach + 1.0, 0.0}, 0.001).count, 0);
}

TEST(FaceContact, FeaturesStayWhenTheReferenceEdgeFlips) {
  // nearly parallel faces: the tilt decides which body owns the axis, but the touching corners are the same
  const Shape square = rectangle(10.0, 10.0);
  const Vec2 offset{9.999, 3.0};
  const ContactGeometry straight = face(square, square, offset, 0.01);
  ASSERT_EQ(straight.count, 2);
  bool a_owned = false, b_owned = false;
  for (const double angle : {-1e-6, -1e-9, -1e-15, 0.0, 1e-15, 1e-9, 1e-6}) {
    const Shape tilted = tilted_square(10.0, angle);
    (test::separation_of(square, tilted, offset).edge_of_b ? b_owned : a_owned) = true;
    for (const ContactGeometry& c : {face(square, tilted, offset, 0.01), face(tilted, square, offset, 0.01)}) {
      ASSERT_EQ(c.count, 2) << angle;
      EXPECT_EQ(c.point[0].feature, straight.point[0].feature) << angle;
      EXPECT_EQ(c.point[1].feature, straight.point[1].feature) << angle;
      EXPECT_NEAR(c.point[0].separation, -0.001, 1e-5);
      EXPECT_NEAR(c.point[1].separation, -0.001, 1e-5);
    }
    EXPECT_EQ(face(square, tilted, {9.999, 0.0}, 0.01).count, 2) << angle;
  }
  EXPECT_TRUE(a_owned && b_owned);
}

TEST(FaceContact, MarginIsRespected) {
  // a 10 m face tilted by 1 mrad: its ends differ by 10 mm in height
  const Shape square = rectangle(10.0, 10.0), tilted = tilted_square(10.0, 1e-3);
  const Vec2 offset{10.005, 0.0};
  const ContactGeometry both = face(square, tilted, offset, 0.0101);
  ASSERT_EQ(both.count, 2);
  const double near = std::min(both.point[0].separation, both.point[1].separation);
  const double far = std::max(both.point[0].separation, both.point[1].separation);
  EXPECT_NEAR(far - near, 0.01, 1e-5);
  const ContactGeometry one = face(square, tilted, offset, 0.5 * (near + far));
  ASSERT_EQ(one.count, 1);
  EXPECT_EQ(one.point[0].separation, near);
  EXPECT_EQ(face(square, tilted, offset, near).count, 0);
}

TEST(FaceContact, PointsStandHalfWayBetweenTheSurfaces) {
  RandomSequence random(Random(41, 0));
  int compared = 0;
  for (int i = 0; i < 60000; ++i) {
    const Shape a = test::random_shape(random), b = test::random_shape(random);
    const Vec2 offset{random.uniform(-12.0, 12.0), random.uniform(-12.0, 12.0)};
    const Separation axis = test::separation_of(a, b, offset);
    if (std::fabs(axis.distance) > 0.05) continue;
    const ContactGeometry c = face(a, b, offset, 0.1), swapped = face(b, a, -offset, 0.1);
    ASSERT_EQ(c.count, swapped.count) << i;
    for (int k = 0; k < c.count; ++k) {
      const ContactPoint& p = c.point[k];
      const ContactPoint& q = swapped.point[c.count - 1 - k];  // the tangent turns round with the normal
      EXPECT_LT(p.separation, 0.1);
      EXPECT_GE(p.separation, axis.distance - 1e-12);
      EXPECT_EQ(p.feature ^ 1, q.feature) << i;
      EXPECT_NEAR(p.separation, q.separation, 1e-12) << i;
      EXPECT_LT(length(p.position - offset - q.position), 1e-12) << i;
      if (!(c.width > 0.0)) continue;
      ++compared;
      const Vec2 half = (0.5 * p.separation) * c.normal;
      EXPECT_LT(test::distance_to_boundary(a, {}, p.position - half), 1e-9) << i;
      EXPECT_LT(test::distance_to_boundary(b, offset, p.position + half), 1e-9) << i;
    }
  }
  EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace gem
