#include "gem/engine/reference/corners_inside.h"

#include <algorithm>
#include <limits>

#include "gem/engine/reference/touch.h"

namespace gem::reference {
namespace {

/// Corners nearer than this are side by side [m].
constexpr double tie = 1e-9;

/// Whether corner k of `p` can have come through a side: its neighbours are farther out, or less than 30 degrees
/// deeper.
bool can_meet(const TurnedOutline& p, std::size_t k, Vec2 normal) {
  constexpr double steepest = 0.5;
  const std::size_t count = p.corner.size();
  for (const std::size_t neighbour : {(k + 1) % count, (k + count - 1) % count}) {
    const Vec2 flank = p.corner[neighbour] - p.corner[k];
    if (dot(normal, flank) < -steepest * length(flank)) return false;
  }
  return true;
}

/// Sets the side of `q` that corner k of `p` presses: the nearest through which it can have come, else the nearest.
/// Returns whether there is one and the corner is inside. `slack`: how far beyond the other sides it still counts as
/// inside [m]; it decides between two corners that are side by side.
bool find_pressed_side(const TurnedOutline& p, std::size_t k, const TurnedOutline& q, Vec2 place_in_q, double slack,
                       CornerInside& found) {
  constexpr double none = std::numeric_limits<double>::infinity();
  CornerInside any = found;
  any.depth = found.depth = none;
  std::int32_t outside = -1, count_outside = 0;
  for (std::size_t side = 0; side < q.corner.size(); ++side) {
    const double depth = dot(q.normal[side], q.corner[side] - place_in_q);
    const auto number = static_cast<std::int32_t>(side);
    if (!(depth > -slack)) outside = number, ++count_outside;
    for (CornerInside* best : {&any, &found}) {
      if (!(depth < best->depth) || (best == &found && !can_meet(p, k, q.normal[side]))) continue;
      best->depth = depth;
      best->normal = q.normal[side];
      best->side = number;
    }
  }
  if (found.depth == none) found = any;
  return found.depth > 0.0 && (count_outside == 0 || (count_outside == 1 && outside == found.side));
}

/// Appends the corners of p that are inside q.
void find_corners(const Bodies& b, const std::vector<TurnedOutline>& outline, std::int32_t p, std::int32_t q,
                  std::vector<CornerInside>& corners) {
  for (std::size_t k = 0; k < outline[p].corner.size(); ++k) {
    CornerInside found{p, q, static_cast<std::int32_t>(k), -1, 0.0, {}, b.position[p] + outline[p].corner[k]};
    if (find_pressed_side(outline[p], k, outline[q], found.place - b.position[q], p > q ? tie : -tie, found))
      corners.push_back(found);
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
