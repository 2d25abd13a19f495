// Chord growth of tilted faces: against the closed form, the chord of the overlap, and the single point of a small
// margin.
#include "gem/geometry/tilted_faces.h"

#include <gtest/gtest.h>

#include "gem/geometry/test_shapes.h"

namespace gem {
namespace {

using test::rectangle;
using test::Shape;

constexpr double turns_of(double angle) { return angle / (2.0 * M_PI); }

double growth(const Shape& a, const Shape& b, const ContactGeometry& c) {
  return tilted_faces_growth(a.outline(), b.outline(), c.point[0], c.point[1], c.width);
}

/// Places B along x so that its deepest point is `depth` inside the face of A at x = `face`.
Vec2 offset_of(const Shape& b, double face, double depth, double y = 0.0) {
  double lowest = 1e300;
  for (const Vec2 p : b.corner) lowest = std::min(lowest, p.x);
  return {face - lowest - depth, y};
}

TEST(TiltedFaces, SquareOnAFace) {
  const Shape wall = rectangle(4.0, 40.0);
  for (const double tilt : {1e-6, -1e-6, 1e-3, -1e-3, 1e-2, -1e-2, 0.1}) {
    const Shape square = rectangle(8.0, 8.0, turns_of(tilt));
    const Vec2 offset = offset_of(square, 2.0, 1e-6);
    const double expected = 1.0 / std::tan(std::fabs(tilt)) + std::tan(std::fabs(tilt));
    // the ends are known to 1e-15 m and differ by 8 m x tilt
    const double tolerance = 1e-12 + 4e-15 / (8.0 * std::fabs(tilt));
    const ContactGeometry c = test::face(wall, square, offset), swapped = test::face(square, wall, -offset);
    ASSERT_EQ(c.count, 2);
    EXPECT_EQ(c.growth, 0.0);
    EXPECT_NEAR(growth(wall, square, c) / expected, 1.0, tolerance) << tilt;
    EXPECT_NEAR(growth(square, wall, swapped) / expected, 1.0, tolerance) << tilt;
  }
}

TEST(TiltedFaces, OtherSideLeansInAndOverhangs) {
  const Shape wall = rectangle(4.0, 40.0);
  for (const double corner : {0.5, 1.2, 2.5}) {  // angle between the facing side and the other [rad]
    const double tilt = 0.01;
    // the facing side leaves the wall by the tilt, the other side by `corner` more
    const double on = 0.5 * M_PI - tilt - corner;
    const Vec2 up{8.0 * std::sin(tilt), 8.0 * std::cos(tilt)}, other{8.0 * std::cos(on), 8.0 * std::sin(on)};
    const Shape triangle({{0.0, 0.0}, other, up});
    const ContactGeometry c = test::face(wall, triangle, {2.0 - 1e-6, 0.0});
    ASSERT_EQ(c.count, 2) << corner;
    const double beta =
        M_PI - tilt - corner;  // below a right angle the other side leans over the wall, away from the chord
    EXPECT_NEAR(growth(wall, triangle, c), 1.0 / std::tan(tilt) + 1.0 / std::tan(beta), 1e-9) << corner;
  }
}

TEST(TiltedFaces, SharpCornerOfTheBodyThatOwnsTheNormal) {
  const double corner = M_PI / 18.0;  // 10 degrees
  const Shape needle({{0.0, 0.0}, {0.0, 8.0}, {-8.0 * std::sin(corner), 8.0 * std::cos(corner)}});
  for (const double tilt : {0.02, 0.9 * corner, corner, 1.05 * corner}) {
    // a block whose face is 0.1 m in front of the needle's tip and leans away from its side. It starts so little below
    // the tip that the needle's side is the best separating axis
    const Vec2 along{std::sin(tilt), std::cos(tilt)}, inward{std::cos(tilt), -std::sin(tilt)};
    const double below = 0.2 * 0.1 * tilt;
    const Vec2 low = Vec2{0.1, 0.0} - below * along;
    const Shape block({low, low + 10.0 * inward, low + 10.0 * inward + 10.0 * along, low + 10.0 * along});
    const ContactGeometry c = test::face(needle, block, {0.0, 0.0});
    ASSERT_EQ(c.count, 2);
    ASSERT_EQ(c.normal.y, 0.0) << "not the needle's";
    const ContactPoint& first = c.point[c.point[1].separation < c.point[0].separation];
    ASSERT_EQ(first.feature, 0) << "not the needle's tip";
    const double expected = std::sin(corner) / (std::sin(tilt) * std::sin(tilt + corner));
    EXPECT_NEAR(growth(needle, block, c) / expected, 1.0, 1e-12) << tilt;
  }
}

TEST(TiltedFaces, ParallelIsFlat) {
  const Shape square = rectangle(8.0, 8.0);
  EXPECT_EQ(growth(square, square, test::face(square, square, {8.0, 3.0})), 0.0);
}

TEST(TiltedFaces, SameAsOnePointWhoseMarginIsSmall) {
  const Shape wall = rectangle(4.0, 40.0);
  for (const double tilt : {1e-3, -3e-3, 1e-2}) {
    const Shape square = rectangle(8.0, 8.0, turns_of(tilt));
    const Vec2 offset = offset_of(square, 2.0, 1e-6);
    const ContactGeometry one = test::face(wall, square, offset, 1e-4), two = test::face(wall, square, offset);
    ASSERT_EQ(one.count, 1);
    ASSERT_EQ(two.count, 2);
    EXPECT_NEAR(growth(wall, square, two) / one.growth, 1.0, 1e-11);
  }
}

TEST(TiltedFaces, AsTheChordOfTheOverlapGrows) {
  RandomSequence random(Random(43, 0));
  int compared = 0;
  for (int i = 0; i < 60000; ++i) {
    const Shape a = test::random_shape(random), b = test::random_shape(random);
    const Vec2 offset{random.uniform(-12.0, 12.0), random.uniform(-12.0, 12.0)};
    const Separation axis = test::separation_of(a, b, offset);
    if (std::fabs(axis.distance) > 0.05) continue;
    const ContactGeometry c = test::face(a, b, offset, 0.3);
    if (c.count != 2) continue;
    const double tilt = std::fabs(c.point[1].separation - c.point[0].separation) / c.width;
    if (!(tilt > 1e-3 && tilt < 0.05)) continue;
    // pushed in by 1e-6 m beyond first contact, the overlap is a triangle unless the corner is beside the end of the
    // other face
    const Vec2 pushed = offset - (axis.distance + 1e-6) * c.normal;
    const ContactGeometry chord = test::chord(a, b, pushed);
    const bool plain = chord.width > 0.0 && chord.growth > 0.0 && test::overlap(a, b, pushed).size() == 3;
    if (!plain) continue;
    ++compared;
    // the chord's normal differs from the face's by up to 1 / growth, which changes both cotangents by that much
    EXPECT_NEAR(growth(a, b, c) / chord.growth, 1.0, 1e-2) << i << " tilt " << tilt;
  }
  RecordProperty("compared", compared);
  EXPECT_GT(compared, 10);
}

}  // namespace
}  // namespace gem
