// Chord contact: overlaps in closed form, symmetry, and the force as the gradient of the overlap area.
#include <gtest/gtest.h>

#include "gem/geometry/test_shapes.h"

namespace gem {
namespace {

using test::chord;
using test::rectangle;
using test::Shape;

void expect_near(Vec2 computed, Vec2 expected, double tolerance) {
  EXPECT_NEAR(computed.x, expected.x, tolerance);
  EXPECT_NEAR(computed.y, expected.y, tolerance);
}

TEST(ChordContact, ShiftedSquares) {
  const Shape square = rectangle(10.0, 10.0);
  const ContactGeometry c = chord(square, square, {7.0, 4.0});
  EXPECT_NEAR(test::overlap_area(square, square, {7.0, 4.0}), 18.0, 1e-13);
  EXPECT_EQ(c.count, 1);
  EXPECT_NEAR(c.width, std::sqrt(45.0), 1e-14);
  expect_near(c.normal, {6.0 / std::sqrt(45.0), 3.0 / std::sqrt(45.0)}, 1e-15);
  expect_near(c.point[0].position, {3.5, 2.0}, 1e-14);
  EXPECT_NEAR(c.point[0].separation, -3.0, 1e-14);
}

TEST(ChordContact, CoaxialSquaresAtHalfARightAngle) {
  const Shape square = rectangle(10.0, 10.0), turned = rectangle(10.0, 10.0, 0.125);
  EXPECT_NEAR(test::overlap_area(square, turned, {}), 82.8427124746, 1e-10);
  // symmetric: eight crossings sum to zero, so the separating axis is used
  const ContactGeometry c = chord(square, turned, {});
  EXPECT_EQ(c.count, 1);
  EXPECT_EQ(c.width, 0.0);
  EXPECT_NEAR(length(c.normal), 1.0, 1e-15);
  EXPECT_NEAR(c.point[0].separation, -5.0 - 5.0 * std::sqrt(2.0), 1e-13);
}

TEST(ChordContact, CornerOnFace) {
  const Shape wall = rectangle(4.0, 40.0), square = rectangle(10.0, 10.0, 0.125);
  const double depth = 0.1, reach = 5.0 * std::sqrt(2.0);
  const ContactGeometry c = chord(wall, square, {2.0 + reach - depth, 3.0});
  EXPECT_NEAR(c.width, 2.0 * depth, 1e-13);
  EXPECT_NEAR(c.growth, 2.0, 1e-12);
  expect_near(c.normal, {1.0, 0.0}, 1e-13);
  expect_near(c.point[0].position, {2.0, 3.0}, 1e-13);
  EXPECT_NEAR(c.point[0].separation, -depth, 1e-13);
}

TEST(ChordContact, FaceOnFace) {
  const Shape square = rectangle(10.0, 10.0);
  const ContactGeometry equal = chord(square, square, {9.9, 0.0});
  EXPECT_NEAR(equal.width, 10.0, 1e-14);
  expect_near(equal.normal, {1.0, 0.0}, 1e-15);
  const ContactGeometry shifted = chord(square, square, {9.9, 1.0});
  EXPECT_NEAR(shifted.width, std::hypot(0.1, 9.0), 1e-13);
  expect_near(shifted.normal, {9.0 / shifted.width, 0.1 / shifted.width}, 1e-13);
  expect_near(shifted.point[0].position, {4.95, 0.5}, 1e-13);
}

/// Checks the chord of two outlines whose overlap is `expected` when A is not turned: both orders, 60 orientations,
/// places with other rounding.
void expect_everywhere(const Shape& a, const Shape& b, Vec2 offset, const ContactGeometry& expected) {
  const auto turned = [](const Shape& shape, Rotation q) {
    std::vector<Vec2> corners;
    for (const Vec2 p : shape.corner) corners.push_back(rotate(q, p));
    return Shape(corners);
  };
  for (int k = 0; k < 60; ++k)
    for (const Vec2 place : {Vec2{}, Vec2{1.3, -7.7}, Vec2{1e3, 333.3}, Vec2{-1e6, 7e5}}) {
      const Rotation q = strict::rotation_of_turns(k / 60.0);
      const Shape turned_a = turned(a, q), turned_b = turned(b, q);
      const Vec2 apart = (place + rotate(q, offset)) - place;  // as positions of bodies give it
      const ContactGeometry forth = chord(turned_a, turned_b, apart), back = chord(turned_b, turned_a, -apart);
      const double tolerance = 1e-13 * (10.0 + length(place));  // rounding of a place
      ASSERT_EQ(forth.count, 1);
      EXPECT_NEAR(forth.width, expected.width, tolerance) << k;
      EXPECT_NEAR(back.width, expected.width, tolerance) << k;
      expect_near(forth.normal, rotate(q, expected.normal), tolerance);
      expect_near(back.normal, -forth.normal, tolerance);
      expect_near(forth.point[0].position, rotate(q, expected.point[0].position), tolerance);
      expect_near(apart + back.point[0].position, forth.point[0].position, tolerance);
      EXPECT_NEAR(forth.growth, expected.growth, 1e-6) << k;
      EXPECT_NEAR(back.growth, expected.growth, 1e-6) << k;
    }
}

ContactGeometry flat(double width, Vec2 normal, Vec2 middle) {
  ContactGeometry contact;
  contact.width = width;
  contact.normal = normal;
  contact.point[0].position = middle;
  return contact;
}

TEST(ChordContact, AlignedFacesHaveOneChordInEveryOrientation) {
  const Shape square = rectangle(10.0, 10.0);
  for (const double depth : {0.5, 0.05, 1e-3, 1e-6})
    expect_everywhere(square, square, {10.0 - depth, 0.0}, flat(10.0, {1.0, 0.0}, {5.0 - 0.5 * depth, 0.0}));
}

TEST(ChordContact, FacesAlignedAtOneEndHaveOneChordInEveryOrientation) {
  // B is narrower, and its lower side continues that of A: there the chord begins half-way down the common stretch
  const Shape large = rectangle(10.0, 10.0), small = rectangle(4.0, 6.0);
  for (const double depth : {0.1, 1e-3}) {
    const Vec2 from{5.0 - 0.5 * depth, -5.0}, to{5.0, 1.0};
    const double width = length(to - from);
    ContactGeometry expected = flat(width, (1.0 / width) * turned_right(to - from), 0.5 * (from + to));
    expected.growth = chord(large, small, {7.0 - depth, -2.0}).growth;
    EXPECT_LT(std::fabs(expected.growth), 0.2 * depth);
    expect_everywhere(large, small, {7.0 - depth, -2.0}, expected);
  }
}

TEST(ChordContact, CornerOnCorner) {
  const Shape square = rectangle(10.0, 10.0, 0.125);
  const double reach = 5.0 * std::sqrt(2.0);
  const ContactGeometry c = chord(square, square, {2.0 * reach - 0.1, 0.0});
  EXPECT_NEAR(c.width, 0.1, 1e-13);
  expect_near(c.normal, {1.0, 0.0}, 1e-13);
  expect_near(c.point[0].position, {reach - 0.05, 0.0}, 1e-13);
  EXPECT_NEAR(c.growth, 1.0, 1e-11);
}

TEST(ChordContact, OneInsideTheOther) {
  const Shape large = rectangle(10.0, 10.0), small = rectangle(1.0, 1.0);
  const ContactGeometry inside = chord(large, small, {4.0, 0.1});
  EXPECT_EQ(inside.count, 1);
  EXPECT_EQ(inside.width, 0.0);
  expect_near(inside.normal, {1.0, 0.0}, 1e-15);
  EXPECT_NEAR(inside.point[0].separation, -1.5, 1e-14);
  const ContactGeometry around = chord(small, large, {-4.0, -0.1});
  expect_near(around.normal, {-1.0, 0.0}, 1e-15);
  EXPECT_NEAR(around.point[0].separation, -1.5, 1e-14);
}

TEST(ChordContact, CrossedBars) {
  const Shape flat = rectangle(20.0, 2.0), upright = rectangle(2.0, 20.0);
  // both bars are cut on both sides: no resultant, so the separating axis is used
  const ContactGeometry crossed = chord(flat, upright, {0.3, 0.2});
  EXPECT_EQ(crossed.count, 1);
  EXPECT_EQ(crossed.width, 0.0);
  EXPECT_NEAR(crossed.point[0].separation, -10.7, 1e-13);
  // a bar that protrudes on one side only is pushed out of it
  const ContactGeometry through = chord(flat, upright, {0.3, 10.5});
  EXPECT_NEAR(through.width, 2.0, 1e-13);
  expect_near(through.normal, {0.0, 1.0}, 1e-13);
}

TEST(ChordContact, SwappedBodiesSeeTheSameContact) {
  RandomSequence random(Random(31, 0));
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Shape a = test::random_shape(random), b = test::random_shape(random);
    const Vec2 offset = test::on_grid({random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)});
    const ContactGeometry c = chord(a, b, offset), swapped = chord(b, a, -offset);
    EXPECT_NEAR(c.point[0].separation, swapped.point[0].separation, 1e-12) << i;
    if (!(c.point[0].separation < -1e-6) || !(c.width > 1e-4) || !(swapped.width > 1e-4)) continue;
    ++compared;
    // a crossing moves by rounding / sine of its angle: slivers of 1:1000 leave 1e-9
    EXPECT_NEAR(c.width, swapped.width, 1e-9) << i;
    EXPECT_NEAR(c.normal.x, -swapped.normal.x, 1e-9 / c.width) << i;
    EXPECT_NEAR(c.normal.y, -swapped.normal.y, 1e-9 / c.width) << i;
    expect_near(c.point[0].position, swapped.point[0].position + offset, 1e-9);
  }
  EXPECT_GT(compared, 2000);
}

TEST(ChordContact, ForceIsTheGradientOfTheOverlapArea) {
  RandomSequence random(Random(32, 0));
  int compared = 0, cornered = 0;
  for (int i = 0; i < 20000; ++i) {
    const Shape a = test::random_shape(random), b = test::random_shape(random);
    const Vec2 offset{random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)};
    const ContactGeometry c = chord(a, b, offset);
    if (!(c.point[0].separation < -1e-3) || !(c.width > 1e-2)) continue;
    auto gradient = [&](double step) {
      auto along = [&](Vec2 d) {
        return (test::overlap_area(a, b, offset + step * d) - test::overlap_area(a, b, offset - step * d)) /
               (2.0 * step);
      };
      return Vec2{along({1.0, 0.0}), along({0.0, 1.0})};
    };
    // without a change of crossing edges the area is a quadratic function of the offset, so the difference is exact
    const Vec2 coarse = gradient(2e-5), fine = gradient(1e-5);
    if (length(coarse - fine) > 1e-6 * c.width) {
      ++cornered;
      continue;
    }
    ++compared;
    EXPECT_LT(length(fine + c.width * c.normal), 1e-5 * c.width) << i;
  }
  EXPECT_GT(compared, 2000);
  EXPECT_LT(cornered, compared / 20);
}

/// Number of crossings of the outlines.
int crossings(const Shape& a, const Shape& b, Vec2 offset) {
  int count = 0;
  for (std::size_t i = 0; i < a.corner.size(); ++i)
    for (std::size_t j = 0; j < b.corner.size(); ++j) {
      const Vec2 p = a.corner[i], q = a.corner[(i + 1) % a.corner.size()];
      const Vec2 r = offset + b.corner[j], s = offset + b.corner[(j + 1) % b.corner.size()];
      if (cross(q - p, r - p) * cross(q - p, s - p) < 0.0 && cross(s - r, p - r) * cross(s - r, q - r) < 0.0) ++count;
    }
  return count;
}

TEST(ChordContact, GrowthIsTheRateOfTheChord) {
  RandomSequence random(Random(33, 0));
  int compared = 0;
  for (int i = 0; i < 20000; ++i) {
    const Shape a = test::random_shape(random), b = test::random_shape(random);
    const Vec2 offset{random.uniform(-9.0, 9.0), random.uniform(-9.0, 9.0)};
    const ContactGeometry c = chord(a, b, offset);
    if (!(c.point[0].separation < -1e-3) || !(c.width > 1e-2) || std::fabs(c.growth) > 50.0) continue;
    if (crossings(a, b, offset) != 2) continue;  // several chords have no common growth
    const double step = 1e-6;
    const ContactGeometry deeper = chord(a, b, offset - step * c.normal), back = chord(a, b, offset + step * c.normal);
    const double forward = (deeper.width - c.width) / step, backward = (c.width - back.width) / step;
    if (std::fabs(forward - backward) > 1e-3) continue;  // a corner passes, or the chord turns fast
    ++compared;
    EXPECT_NEAR(c.growth, 0.5 * (forward + backward), 1e-3) << i;
  }
  EXPECT_GT(compared, 1000);
}

}  // namespace
}  // namespace gem
