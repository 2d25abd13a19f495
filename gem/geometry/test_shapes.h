// Outlines for tests of contact geometry: squares, random convex polygons, and a slow, simple overlap.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "gem/base/random.h"
#include "gem/geometry/convex_contact.h"
#include "gem/geometry/polygon.h"

namespace gem::test {

/// A convex outline with its normals.
struct Shape {
  std::vector<Vec2> corner, normal;

  explicit Shape(std::vector<Vec2> corners) : corner(std::move(corners)) {
    for (std::size_t i = 0; i < corner.size(); ++i) {
      const Vec2 edge = corner[(i + 1) % corner.size()] - corner[i];
      normal.push_back((1.0 / length(edge)) * turned_right(edge));
    }
  }
  Outline outline() const { return {corner.data(), normal.data(), static_cast<int>(corner.size())}; }
};

inline Shape rectangle(double length_x, double length_y, double turns = 0.0) {
  const double x = 0.5 * length_x, y = 0.5 * length_y;
  std::vector<Vec2> corners{{x, -y}, {x, y}, {-x, y}, {-x, -y}};
  for (Vec2& p : corners) p = rotate(strict::rotation_of_turns(turns), p);
  return Shape(corners);
}

/// Grid of the random shapes [m]. A power of two, so that integers and doubles represent the same points.
constexpr double grid = 0x1p-30;

inline Vec2 on_grid(Vec2 p) { return {grid * std::round(p.x / grid), grid * std::round(p.y / grid)}; }

/// Corners on an ellipse of random size, direction and aspect ratio up to 1:1000; most are slivers.
inline Shape random_shape(RandomSequence& random) {
  for (;;) {
    const double size = random.uniform(1.0, 10.0), aspect = strict::power(10.0, -3.0 * random.uniform());
    const Rotation direction = strict::rotation_of_turns(random.uniform());
    const std::size_t count = 3 + random.below(10);
    std::vector<double> turns(count);
    for (double& t : turns) t = random.uniform();
    std::sort(turns.begin(), turns.end());
    std::vector<Vec2> corners;
    for (const double t : turns) {
      const Rotation q = strict::rotation_of_turns(t);
      corners.push_back(on_grid(rotate(direction, {size * q.cosine, size * aspect * q.sine})));
    }
    double shortest = size;
    for (std::size_t i = 0; i < count; ++i)
      shortest = std::min(shortest, length(corners[(i + 1) % count] - corners[i]));
    if (shortest > 1e-4 && first_non_convex_vertex(corners) < 0) return Shape(corners);
  }
}

/// Overlap of a and b: a cut along every edge of b, relative to a's origin.
inline std::vector<Vec2> overlap(const Shape& a, const Shape& b, Vec2 offset) {
  std::vector<Vec2> left = a.corner;
  for (std::size_t j = 0; j < b.corner.size(); ++j) {
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < left.size(); ++i) {
      const Vec2 p = left[i], q = left[(i + 1) % left.size()];
      const double at_p = dot(b.normal[j], p - b.corner[j] - offset);
      const double at_q = dot(b.normal[j], q - b.corner[j] - offset);
      if (at_p <= 0.0) kept.push_back(p);
      if ((at_p < 0.0 && at_q > 0.0) || (at_p > 0.0 && at_q < 0.0))
        kept.push_back(p + (at_p / (at_p - at_q)) * (q - p));
    }
    left = kept;
  }
  return left;
}

inline double overlap_area(const Shape& a, const Shape& b, Vec2 offset) {
  return polygon_moments(overlap(a, b, offset)).area;
}

inline double distance_to_boundary(const Shape& shape, Vec2 origin, Vec2 point) {
  double smallest = 1e300;
  for (std::size_t i = 0; i < shape.corner.size(); ++i) {
    const Vec2 a = origin + shape.corner[i], edge = shape.corner[(i + 1) % shape.corner.size()] - shape.corner[i];
    double along = dot(point - a, edge) / dot(edge, edge);
    along = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
    smallest = std::min(smallest, length(point - a - along * edge));
  }
  return smallest;
}

inline Separation separation_of(const Shape& a, const Shape& b, Vec2 offset) {
  return find_axes(a.outline(), b.outline(), offset).first;
}

inline ContactGeometry chord(const Shape& a, const Shape& b, Vec2 offset) {
  return chord_contact(a.outline(), b.outline(), offset, separation_of(a, b, offset));
}

inline ContactGeometry face(const Shape& a, const Shape& b, Vec2 offset, double margin = 1e300) {
  return face_contact(a.outline(), b.outline(), offset, separation_of(a, b, offset), margin);
}

}  // namespace gem::test
