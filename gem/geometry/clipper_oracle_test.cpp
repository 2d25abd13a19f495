// Random convex pairs, slivers included, against Clipper: overlap yes or no, and the chord of the overlap.
#include <gtest/gtest.h>

#include "gem/geometry/test_shapes.h"

#ifdef GEM_HAS_CLIPPER
#include <polyclipping/clipper.hpp>
#endif

namespace gem {
namespace {

#ifdef GEM_HAS_CLIPPER

using test::Shape;

ClipperLib::Path path_of(const Shape& shape, Vec2 offset) {
  ClipperLib::Path path;
  for (const Vec2 p : shape.corner) {
    const Vec2 moved = offset + p;
    path.emplace_back(static_cast<ClipperLib::cInt>(moved.x / test::grid),
                      static_cast<ClipperLib::cInt>(moved.y / test::grid));
  }
  return path;
}

/// Overlap of two shapes on the grid; its corners are rounded to the grid.
std::vector<Vec2> clipped(const Shape& a, const Shape& b, Vec2 offset) {
  ClipperLib::Clipper clipper;
  clipper.AddPath(path_of(a, {}), ClipperLib::ptSubject, true);
  clipper.AddPath(path_of(b, offset), ClipperLib::ptClip, true);
  ClipperLib::Paths paths;
  clipper.Execute(ClipperLib::ctIntersection, paths);
  std::vector<Vec2> outline;
  if (paths.empty()) return outline;
  for (const ClipperLib::IntPoint& p : paths[0])
    outline.push_back({test::grid * static_cast<double>(p.X), test::grid * static_cast<double>(p.Y)});
  return outline;
}

struct Owned {
  Vec2 sum;           // of the edges on B
  bool clear = true;  // every edge lies on one outline only
};

Owned edges_of_b(const std::vector<Vec2>& overlap, const Shape& a, const Shape& b, Vec2 offset) {
  Owned owned;
  for (std::size_t i = 0; i < overlap.size(); ++i) {
    const Vec2 p = overlap[i], q = overlap[(i + 1) % overlap.size()], middle = 0.5 * (p + q);
    if (length(q - p) < 1e-8) continue;
    const double to_a = test::distance_to_boundary(a, {}, middle);
    const double to_b = test::distance_to_boundary(b, offset, middle);
    if (to_b < to_a) owned.sum += q - p;
    if (std::max(to_a, to_b) < 1e-6) owned.clear = false;
  }
  return owned;
}

TEST(ClipperOracle, OverlapAndChordOfRandomPairs) {
  RandomSequence random(Random(51, 0));
  int overlapping = 0, apart = 0, chords = 0;
  for (int i = 0; i < 20000; ++i) {
    const Shape a = test::random_shape(random), b = test::random_shape(random);
    const Vec2 offset = test::on_grid({random.uniform(-10.0, 10.0), random.uniform(-10.0, 10.0)});
    const ContactGeometry contact = test::chord(a, b, offset);
    const double separation = contact.point[0].separation;
    if (std::fabs(separation) < 1e-6) continue;
    const std::vector<Vec2> overlap = clipped(a, b, offset);
    const double area = polygon_moments(overlap).area;
    if (separation > 0.0) {
      ++apart;
      EXPECT_EQ(area, 0.0) << i;
      continue;
    }
    ++overlapping;
    EXPECT_GT(area, 0.0) << i;
    // corners rounded to 1e-9 m on outlines of at most 60 m
    EXPECT_NEAR(area, test::overlap_area(a, b, offset), 6e-8) << i;
    const Owned owned = edges_of_b(overlap, a, b, offset);
    if (!owned.clear || contact.width == 0.0) continue;
    ++chords;
    const Vec2 chord = -contact.width * turned_left(contact.normal);
    EXPECT_LT(length(chord - owned.sum), 1e-7) << i;
  }
  EXPECT_GT(apart, 2000);
  EXPECT_GT(overlapping, 2000);
  EXPECT_GT(chords, 2000);
}

#else

TEST(ClipperOracle, OverlapAndChordOfRandomPairs) {
  GTEST_SKIP() << "skipped: Clipper was not found (package libpolyclipping-dev)";
}

#endif

}  // namespace
}  // namespace gem
