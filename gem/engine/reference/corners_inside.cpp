#include "gem/engine/reference/corners_inside.h"

#include <algorithm>
#include <limits>

#include "gem/engine/reference/touch.h"

namespace gem::reference {
namespace {

/// Sets the nearest side of `q` and the depth behind it for the point `y` from q's centroid. Returns whether the point
/// is inside.
bool find_nearest_side(const TurnedOutline& q, Vec2 y, CornerInside& found) {
  found.depth = std::numeric_limits<double>::infinity();
  for (std::size_t side = 0; side < q.corner.size(); ++side) {
    const double depth = dot(q.normal[side], q.corner[side] - y);
    if (!(depth > 0.0)) return false;
    if (depth < found.depth) {
      found.depth = depth;
      found.normal = q.normal[side];
    }
  }
  return !q.corner.empty();
}

/// Appends the corners of p that are inside q.
void find_corners(const Bodies& b, const std::vector<TurnedOutline>& outline, std::int32_t p, std::int32_t q,
                  std::vector<CornerInside>& corners) {
  for (std::size_t k = 0; k < outline[p].corner.size(); ++k) {
    CornerInside found{p, q, static_cast<std::int32_t>(k), 0.0, {}, b.position[p] + outline[p].corner[k]};
    if (find_nearest_side(outline[q], found.place - b.position[q], found)) corners.push_back(found);
  }
}

/// Whether a share of a side is on it, up to rounding, so that no crossing at the end of two sides is lost.
bool on_side(double share) { return share > -1e-12 && share < 1.0 + 1e-12; }

/// Longest distance between the points where sides of `a` and `b` cross [m]. `offset` is from a's centroid to b's.
double chord_of(const TurnedOutline& a, const TurnedOutline& b, Vec2 offset) {
  std::vector<Vec2> crossing;
  for (std::size_t i = 0; i < a.corner.size(); ++i)
    for (std::size_t j = 0; j < b.corner.size(); ++j) {
      const Vec2 side_a = a.corner[(i + 1) % a.corner.size()] - a.corner[i];
      const Vec2 side_b = b.corner[(j + 1) % b.corner.size()] - b.corner[j];
      const Vec2 between = offset + b.corner[j] - a.corner[i];
      const double area = cross(side_a, side_b);
      const double share_a = cross(between, side_b) / area, share_b = cross(between, side_a) / area;
      // parallel sides give no number or an infinite one
      if (on_side(share_a) && on_side(share_b)) crossing.push_back(a.corner[i] + share_a * side_a);
    }
  double chord = 0.0;
  for (const Vec2 one : crossing)
    for (const Vec2 other : crossing) chord = std::max(chord, length(one - other));
  return chord;
}

bool may_overlap(const Bodies& b, std::size_t i, std::size_t j) {
  const Vec2 offset = b.position[j] - b.position[i];
  const double reach = b.radius[i] + b.radius[j];
  return b.active[i] && b.active[j] && (b.inverse_mass[i] > 0.0 || b.inverse_mass[j] > 0.0) &&
         dot(offset, offset) < reach * reach;
}

}  // namespace

std::vector<Overlap> all_overlaps(const Bodies& bodies) {
  std::vector<TurnedOutline> outline;
  for (std::size_t i = 0; i < bodies.count(); ++i) outline.push_back(turned_outline(bodies, i));
  std::vector<Overlap> overlaps;
  for (std::size_t i = 0; i < bodies.count(); ++i)
    for (std::size_t j = i + 1; j < bodies.count(); ++j) {
      if (!may_overlap(bodies, i, j)) continue;
      Overlap o{static_cast<std::int32_t>(i), static_cast<std::int32_t>(j), {}, 0.0};
      find_corners(bodies, outline, o.b, o.a, o.corners);
      find_corners(bodies, outline, o.a, o.b, o.corners);
      if (o.corners.empty()) continue;
      o.chord = chord_of(outline[i], outline[j], bodies.position[j] - bodies.position[i]);
      overlaps.push_back(o);
    }
  return overlaps;
}

}  // namespace gem::reference
