#include "gem/geometry/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gem {
namespace {

double squared_distance_to_segment(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 edge = b - a;
  const double along = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
  const Vec2 offset = p - (a + along * edge);
  return dot(offset, offset);
}

/// Over the edges of a: the largest of the smallest distances of b's vertices outside that edge.
double edge_separation(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double largest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Vec2 edge = a[(i + 1) % a.size()] - a[i];
    const Vec2 normal = (1.0 / length(edge)) * turned_right(edge);
    double smallest = std::numeric_limits<double>::infinity();
    for (const Vec2 p : b) smallest = std::min(smallest, dot(p - a[i], normal));
    largest = std::max(largest, smallest);
  }
  return largest;
}

double vertex_distance(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Vec2 p : a)
    for (std::size_t i = 0; i < b.size(); ++i)
      smallest = std::min(smallest, squared_distance_to_segment(p, b[i], b[(i + 1) % b.size()]));
  return smallest;
}

}  // namespace

PolygonMoments polygon_moments(const std::vector<Vec2>& outline) {
  double doubled_area = 0.0;
  Vec2 first;
  double second = 0.0;
  const Vec2 origin = outline.empty() ? Vec2{} : outline[0];
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    const Vec2 p = outline[i] - origin;
    const Vec2 q = outline[i + 1] - origin;
    const double doubled = cross(p, q);
    doubled_area += doubled;
    first += doubled * (p + q);
    second += doubled * (dot(p, p) + dot(p, q) + dot(q, q));
  }
  if (doubled_area == 0.0) return {0.0, origin, 0.0};
  const double area = 0.5 * doubled_area;
  const Vec2 centre = (1.0 / (3.0 * doubled_area)) * first;
  return {area, origin + centre, second / 12.0 - area * dot(centre, centre)};
}

PolygonMoments moments_of_all(const std::vector<std::vector<Vec2>>& outlines) {
  if (outlines.size() == 1) return polygon_moments(outlines.front());
  PolygonMoments all;
  Vec2 first;
  std::vector<PolygonMoments> each;
  for (const std::vector<Vec2>& outline : outlines) {
    each.push_back(polygon_moments(outline));
    all.area += each.back().area;
    first += each.back().area * each.back().centroid;
  }
  if (!(all.area > 0.0)) return {};
  all.centroid = (1.0 / all.area) * first;
  for (const PolygonMoments& one : each) {
    const Vec2 arm = one.centroid - all.centroid;
    all.second_moment += one.second_moment + one.area * dot(arm, arm);
  }
  return all;
}

int first_non_convex_vertex(const std::vector<Vec2>& outline) {
  const std::size_t n = outline.size();
  double turned = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = outline[i] - outline[(i + n - 1) % n];
    const Vec2 after = outline[(i + 1) % n] - outline[i];
    if (!(cross(before, after) > 0.0)) return static_cast<int>(i);
    turned += std::atan2(cross(before, after), dot(before, after));
    // More than one full turn: every corner turns left, but the outline winds around itself.
    if (turned > 7.0) return static_cast<int>(i);
  }
  return -1;
}

double convex_separation(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  const double separation = std::max(edge_separation(a, b), edge_separation(b, a));
  if (separation <= 0.0) return separation;
  return std::sqrt(std::min(vertex_distance(a, b), vertex_distance(b, a)));
}

}  // namespace gem
