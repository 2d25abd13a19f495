// Area, centroid and second moment of a simple polygon, and checks of an outline.
#pragma once

#include <vector>

#include "gem/base/vec2.h"

namespace gem {

/// Area integrals of an outline. The second moment is about the centroid.
struct PolygonMoments {
  double area = 0.0;           // [m2], negative for a clockwise outline
  Vec2 centroid;               // [m]
  double second_moment = 0.0;  // polar, about the centroid [m4], sign of the area
};

/// Sums are taken about the first vertex, so that an outline far from the origin loses no digits.
PolygonMoments polygon_moments(const std::vector<Vec2>& outline);

/// The same of outlines that do not overlap, together. The second moment is about the common centroid.
PolygonMoments moments_of_all(const std::vector<std::vector<Vec2>>& outlines);

/// Index of the first vertex where a counter-clockwise outline does not turn left; -1 if it is strictly convex and
/// simple.
int first_non_convex_vertex(const std::vector<Vec2>& outline);

/// Distance between two convex counter-clockwise outlines: > 0 apart, < 0 overlap depth [m].
double convex_separation(const std::vector<Vec2>& a, const std::vector<Vec2>& b);

}  // namespace gem
