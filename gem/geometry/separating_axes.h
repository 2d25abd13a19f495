// Separating axes of two convex outlines: search and update.
//
// Outlines are in world axes relative to their own centroids; `offset` is the vector from A's centroid to B's. A
// distance is that of B outside A or of A outside B.
#pragma once

#include <cstdint>

#include "gem/base/vec2.h"

namespace gem {

/// A convex counter-clockwise outline in world axes: its corners, and the outward unit normals of the edges that start
/// at them.
struct Outline {
  const Vec2* corner = nullptr;
  const Vec2* normal = nullptr;
  int count = 0;
};

/// The axis along which two outlines are farthest apart, or overlap least.
struct Separation {
  double distance = 0.0;  // > 0 apart, < 0 depth [m]
  int edge = 0;           // index of the edge whose normal is the axis
  bool edge_of_b = false;
  std::int16_t corner = -1;  // deepest corner of the other outline; -1: unknown
};

/// Distance of B outside edge `edge` of A: the smallest signed distance of B's corners [m].
GEM_HD inline double edge_separation(const Outline& a, int edge, const Outline& b, Vec2 offset) {
  const Vec2 normal = a.normal[edge];
  double smallest = dot(normal, b.corner[0]);
  for (int j = 1; j < b.count; ++j) {
    const double along = dot(normal, b.corner[j]);
    if (along < smallest) smallest = along;
  }
  return smallest + dot(normal, offset - a.corner[edge]);
}

/// The two best separating axes of a pair and a bound on all others, kept between narrow phases. While the bodies have
/// moved too little for another axis to become better, only the first or these two have to be updated.
struct SeparatingAxes {
  Separation first, second;  // the second distance may be an upper bound
  double others = 1e300;     // upper bound of the distance on all other axes; unknown at first
};

namespace detail {

/// Ranks one more axis. Ties go to A, then to the lower edge, in the order of find_axes().
GEM_HD inline void offer(SeparatingAxes& axes, const Separation& axis) {
  if (axis.distance > axes.first.distance) {
    axes.others = axes.second.distance;
    axes.second = axes.first;
    axes.first = axis;
  } else if (axis.distance > axes.second.distance) {
    axes.others = axes.second.distance;
    axes.second = axis;
  } else if (axis.distance > axes.others) {
    axes.others = axis.distance;
  }
}

/// Whether p ranks before q at equal distance.
GEM_HD inline bool ranks_before(const Separation& p, const Separation& q) {
  return p.edge_of_b == q.edge_of_b ? p.edge < q.edge : q.edge_of_b;
}

/// Corner of `outline` farthest against `direction`; the first of several.
GEM_HD inline int support_corner(const Outline& outline, Vec2 direction) {
  int best = 0;
  double smallest = dot(direction, outline.corner[0]);
  for (int j = 1; j < outline.count; ++j) {
    const double along = dot(direction, outline.corner[j]);
    if (along < smallest) {
      smallest = along;
      best = j;
    }
  }
  return best;
}

/// Whether corner `j` lies farther against `direction` than both its neighbours, beyond rounding. In a convex outline
/// it is then the farthest of all.
GEM_HD inline bool plainly_deepest(const Outline& outline, int j, Vec2 direction) {
  constexpr double rounding = 1e-9;  // [m]
  const double along = dot(direction, outline.corner[j]) + rounding;
  return along < dot(direction, outline.corner[j > 0 ? j - 1 : outline.count - 1]) &&
         along < dot(direction, outline.corner[j + 1 < outline.count ? j + 1 : 0]);
}

/// Updates the distance along a known axis, starting from the last deepest corner.
GEM_HD inline void measure(Separation& axis, const Outline& a, const Outline& b, Vec2 offset) {
  const Outline& owner = axis.edge_of_b ? b : a;
  const Outline& other = axis.edge_of_b ? a : b;
  const Vec2 normal = owner.normal[axis.edge];
  if (axis.corner < 0 || !plainly_deepest(other, axis.corner, normal))
    axis.corner = static_cast<std::int16_t>(support_corner(other, normal));
  const Vec2 to_other = axis.edge_of_b ? -offset : offset;
  axis.distance = dot(normal, other.corner[axis.corner]) + dot(normal, to_other - owner.corner[axis.edge]);
}

}  // namespace detail

/// Finds the axes of a pair among the edges of both outlines.
GEM_HD inline SeparatingAxes find_axes(const Outline& a, const Outline& b, Vec2 offset) {
  constexpr double none = -1e300;
  SeparatingAxes axes{{none, 0, false}, {none, 0, false}, none};
  for (int i = 0; i < a.count; ++i) detail::offer(axes, {edge_separation(a, i, b, offset), i, false});
  for (int j = 0; j < b.count; ++j) detail::offer(axes, {edge_separation(b, j, a, -offset), j, true});
  return axes;
}

/// Updates `axes` to the result of find_axes(), for bodies that moved by at most `moved` [m] relative to each other
/// since the last update. If the two axes already separate the outlines by more than `limit` [m], the others are not
/// updated.
GEM_HD inline void follow_axes(SeparatingAxes& axes, const Outline& a, const Outline& b, Vec2 offset, double moved,
                               double limit) {
  detail::measure(axes.first, a, b, offset);
  axes.second.distance += moved;
  axes.others += moved;
  if (!(axes.first.distance > axes.second.distance)) {
    detail::measure(axes.second, a, b, offset);
    if (axes.second.distance > axes.first.distance ||
        (axes.second.distance == axes.first.distance && detail::ranks_before(axes.second, axes.first))) {
      const Separation second = axes.first;
      axes.first = axes.second;
      axes.second = second;
    }
  }
  if (axes.first.distance > limit || axes.first.distance > axes.others) return;
  axes = find_axes(a, b, offset);
}

}  // namespace gem
