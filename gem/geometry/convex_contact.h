// Contact of two convex outlines: the separating axis, the chord of an overlap, and the touching stretch of two faces.
//
// Outlines are given turned into world axes about their own centroid; B's centroid stands at `offset` from A's.
// All results are relative to A's centroid; normals point from A to B.
#pragma once

#include <cstdint>

#include "gem/base/vec2.h"

namespace gem {

/// A convex counter-clockwise outline in world axes: corners and the outward unit normals of the edges that follow
/// them.
struct Outline {
  const Vec2* corner = nullptr;
  const Vec2* normal = nullptr;
  int count = 0;
};

/// The axis along which two outlines are farthest apart (or least deep in each other).
struct Separation {
  double distance = 0.0;  // > 0 apart, < 0 depth [m]
  int edge = 0;           // index of the edge whose normal is the axis
  bool edge_of_b = false;
  std::int16_t corner = -1;  // deepest corner of the other outline; -1: not looked for
};

/// How far B stands outside edge `edge` of A: the smallest signed distance of B's corners [m].
GEM_HD inline double edge_separation(const Outline& a, int edge, const Outline& b, Vec2 offset) {
  const Vec2 normal = a.normal[edge];
  double smallest = dot(normal, b.corner[0]);
  for (int j = 1; j < b.count; ++j) {
    const double along = dot(normal, b.corner[j]);
    if (along < smallest) smallest = along;
  }
  return smallest + dot(normal, offset - a.corner[edge]);
}

/// The two best separating axes of a pair and a bound on all others, kept from one look to the next: while the bodies
/// have moved too little for another axis to overtake, only the first needs a look, or these two.
struct SeparatingAxes {
  Separation first, second;  // the second's distance may be a bound from above
  double others = 1e300;     // no other axis parts the outlines by more; unknown at first
};

namespace detail {

/// Ranks one more axis. Ties go to A, then to the lower edge: the order in which find_axes offers them.
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

/// Whether p comes before q where both part the outlines equally.
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

/// Whether corner `j` lies farther against `direction` than both its neighbours, beyond rounding: then, in a convex
/// outline, farther than all others.
GEM_HD inline bool plainly_deepest(const Outline& outline, int j, Vec2 direction) {
  constexpr double rounding = 1e-9;  // [m]
  const double along = dot(direction, outline.corner[j]) + rounding;
  return along < dot(direction, outline.corner[j > 0 ? j - 1 : outline.count - 1]) &&
         along < dot(direction, outline.corner[j + 1 < outline.count ? j + 1 : 0]);
}

/// Brings the distance along a known axis up to date; starts from the corner that was deepest last.
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

/// The axes of a pair, looked for among the edges of both.
GEM_HD inline SeparatingAxes find_axes(const Outline& a, const Outline& b, Vec2 offset) {
  constexpr double none = -1e300;
  SeparatingAxes axes{{none, 0, false}, {none, 0, false}, none};
  for (int i = 0; i < a.count; ++i) detail::offer(axes, {edge_separation(a, i, b, offset), i, false});
  for (int j = 0; j < b.count; ++j) detail::offer(axes, {edge_separation(b, j, a, -offset), j, true});
  return axes;
}

/// The same result for a pair whose bodies moved by at most `moved` relative to each other since `axes` was found [m].
/// Where the two axes already part the outlines by more than `limit`, the rest is left alone.
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

/// One point of a contact.
struct ContactPoint {
  Vec2 position;            // relative to A's centroid, half-way between the two surfaces [m]
  double separation = 0.0;  // < 0: depth [m]
  int feature = 0;          // which corner touches: 2 x corner index + (0: of A, 1: of B)
};

/// Where and along which normal two outlines touch.
struct ContactGeometry {
  Vec2 normal;
  int count = 0;  // points
  ContactPoint point[2];
  double width = 0.0;   // chord or touching stretch [m]
  double growth = 0.0;  // how fast the chord of one point grows with depth: cot + cot of the angles at its ends [-];
                        // 0: flat, or two points, whose tilt only tilted_faces.h looks at
};

namespace detail {

/// Parts of edge p -> q inside all edges of `a`: parameters and the edges of `a` that cut it; -1 where uncut.
struct ClippedEdge {
  double begin = 0.0, end = 1.0;
  int entry = -1, exit = -1;
};

GEM_HD inline ClippedEdge clip_edge(const Outline& a, Vec2 p, Vec2 q) {
  ClippedEdge clipped;
  for (int i = 0; i < a.count; ++i) {
    const double at_p = dot(a.normal[i], p - a.corner[i]);
    const double at_q = dot(a.normal[i], q - a.corner[i]);
    if (at_p > 0.0 && at_q > 0.0) {
      clipped.begin = 1.0;
      clipped.end = 0.0;
      return clipped;
    }
    if (at_p > 0.0) {
      const double t = at_p / (at_p - at_q);
      if (t > clipped.begin) {
        clipped.begin = t;
        clipped.entry = i;
      }
    } else if (at_q > 0.0) {
      const double t = at_p / (at_p - at_q);
      if (t < clipped.end) {
        clipped.end = t;
        clipped.exit = i;
      }
    }
  }
  return clipped;
}

/// How fast the crossing of an edge of A (direction `edge_a`) with an edge of B (normal `normal_b`) runs along
/// `tangent` as B sinks into A against `normal`; 0 for parallel edges.
GEM_HD inline double crossing_rate(Vec2 edge_a, Vec2 normal_b, Vec2 normal, Vec2 tangent) {
  const double denominator = dot(edge_a, normal_b);
  if (denominator == 0.0) return 0.0;
  return -(dot(normal, normal_b) / denominator) * dot(edge_a, tangent);
}

}  // namespace detail

/// The crossings of two outlines, added up edge by edge of B.
struct ChordSum {
  Vec2 chord, middle;
  double size = 0.0;  // of the coordinates that the chord is the difference of
  int entries = 0, exits = 0;
  int entry_a = 0, entry_b = 0, exit_a = 0, exit_b = 0;  // edges of the last crossing of each kind
};

/// B's outline runs into A through its edge `edge_a` at `crossing`.
GEM_HD inline void add_entry(ChordSum& sum, Vec2 crossing, int edge_a, int edge_b) {
  sum.chord -= crossing;
  sum.size += length(crossing);
  sum.middle += crossing;
  sum.entry_a = edge_a;
  sum.entry_b = edge_b;
  ++sum.entries;
}

/// B's outline runs out of A.
GEM_HD inline void add_exit(ChordSum& sum, Vec2 crossing, int edge_a, int edge_b) {
  sum.chord += crossing;
  sum.size += length(crossing);
  sum.middle += crossing;
  sum.exit_a = edge_a;
  sum.exit_b = edge_b;
  ++sum.exits;
}

/// One edge of B with its part inside A and where it crosses A's outline.
struct CrossingEdge {
  Vec2 begin, end;
  detail::ClippedEdge clipped;
  GEM_HD Vec2 entry() const { return begin + clipped.begin * (end - begin); }
  GEM_HD Vec2 exit() const { return begin + clipped.end * (end - begin); }
  GEM_HD bool enters() const { return clipped.begin < clipped.end && clipped.entry >= 0; }
  GEM_HD bool leaves() const { return clipped.begin < clipped.end && clipped.exit >= 0; }
};

GEM_HD inline CrossingEdge crossing_edge(const Outline& a, const Outline& b, Vec2 offset, int edge) {
  const Vec2 p = offset + b.corner[edge];
  const Vec2 q = offset + b.corner[edge + 1 < b.count ? edge + 1 : 0];
  return {p, q, detail::clip_edge(a, p, q)};
}

/// The chord of an overlap: it joins the two crossings of the outlines; the normal is perpendicular to it, the contact
/// point its middle. Several crossings (deep overlap) add up to one resultant chord. Without a crossing (one outline
/// inside the other, or an overlap smaller than rounding) the separating axis and its deepest corner stand in, width 0.
GEM_HD inline ContactGeometry chord_geometry(const Outline& a, const Outline& b, Vec2 offset, const Separation& axis,
                                             const ChordSum& sum) {
  ContactGeometry contact;
  const double width = length(sum.chord);
  contact.count = 1;
  contact.point[0].separation = axis.distance;
  constexpr double rounding = 4e-15;
  if (sum.entries == sum.exits && sum.entries > 0 && width > rounding * sum.size) {
    const Vec2 tangent = (1.0 / width) * sum.chord;
    contact.normal = turned_left(tangent);
    contact.point[0].position = (0.5 / sum.entries) * sum.middle;
    contact.width = width;
    // edge direction = normal turned left; tangent runs from the entry of B into A to its exit
    const Vec2 exit_edge = turned_left(a.normal[sum.exit_a]), entry_edge = turned_left(a.normal[sum.entry_a]);
    contact.growth = detail::crossing_rate(exit_edge, b.normal[sum.exit_b], contact.normal, tangent) -
                     detail::crossing_rate(entry_edge, b.normal[sum.entry_b], contact.normal, tangent);
    return contact;
  }
  if (axis.edge_of_b) {
    contact.normal = -b.normal[axis.edge];
    contact.point[0].position = a.corner[detail::support_corner(a, -contact.normal)];
  } else {
    contact.normal = a.normal[axis.edge];
    contact.point[0].position = offset + b.corner[detail::support_corner(b, contact.normal)];
  }
  return contact;
}

GEM_HD inline ContactGeometry chord_contact(const Outline& a, const Outline& b, Vec2 offset, const Separation& axis) {
  ChordSum sum;
  for (int j = 0; j < b.count; ++j) {
    const CrossingEdge edge = crossing_edge(a, b, offset, j);
    if (edge.enters()) add_entry(sum, edge.entry(), edge.clipped.entry, j);
    if (edge.leaves()) add_exit(sum, edge.exit(), edge.clipped.exit, j);
  }
  return chord_geometry(a, b, offset, axis, sum);
}

/// The touching stretch of two outlines: both ends of the facing edges' common part, as far as they are closer than
/// `margin`. Each end is a corner of A or of B, which names the point from one moment to the next. Points are ordered
/// along the normal turned left.
GEM_HD inline ContactGeometry face_contact(const Outline& a, const Outline& b, Vec2 offset, const Separation& axis,
                                           double margin) {
  // reference r owns the axis, incident i faces it; coordinates relative to A's centroid
  const Outline& r = axis.edge_of_b ? b : a;
  const Outline& i = axis.edge_of_b ? a : b;
  const Vec2 to_r = axis.edge_of_b ? offset : Vec2{};
  const Vec2 to_i = axis.edge_of_b ? Vec2{} : offset;
  const int side_r = axis.edge_of_b ? 1 : 0;
  const Vec2 outward = r.normal[axis.edge];
  const Vec2 along = turned_left(outward);

  // the incident edge: of the two at the deepest corner, the one that faces the reference edge more squarely
  const int deepest = axis.corner >= 0 ? axis.corner : detail::support_corner(i, outward);
  const int before = deepest > 0 ? deepest - 1 : i.count - 1;
  const double facing_before = dot(outward, i.normal[before]);
  const double facing_after = dot(outward, i.normal[deepest]);
  const int edge = facing_before < facing_after ? before : deepest;
  const int edge_end = edge + 1 < i.count ? edge + 1 : 0;
  const int reference_end = axis.edge + 1 < r.count ? axis.edge + 1 : 0;

  // the reference edge runs along +along; the incident edge faces it and runs against it
  const Vec2 p0 = to_r + r.corner[axis.edge];
  const Vec2 p1 = to_r + r.corner[reference_end];
  const Vec2 q0 = to_i + i.corner[edge_end];
  const Vec2 q1 = to_i + i.corner[edge];
  const double reach = dot(along, p1 - p0);
  const double s0 = dot(along, q0 - p0);
  const double s1 = dot(along, q1 - p0);
  const double d0 = dot(outward, q0 - p0);
  const double d1 = dot(outward, q1 - p0);

  const double span = s1 - s0;
  // low end: where the later of the two starts; high end: where the earlier of the two stops
  const bool low_is_incident = !(s0 < 0.0) || !(span > 0.0);
  const bool high_is_incident = !(s1 > reach) || !(span > 0.0);
  const double low_depth = low_is_incident ? d0 : d0 + (d1 - d0) * ((0.0 - s0) / span);
  const double high_depth = high_is_incident ? d1 : d0 + (d1 - d0) * ((reach - s0) / span);
  const Vec2 low = low_is_incident ? q0 - (0.5 * d0) * outward : p0 + (0.5 * low_depth) * outward;
  const Vec2 high = high_is_incident ? q1 - (0.5 * d1) * outward : p1 + (0.5 * high_depth) * outward;
  const ContactPoint low_end{low, low_depth, low_is_incident ? 2 * edge_end + (1 - side_r) : 2 * axis.edge + side_r};
  const ContactPoint high_end{high, high_depth,
                              high_is_incident ? 2 * edge + (1 - side_r) : 2 * reference_end + side_r};

  const Vec2 normal = axis.edge_of_b ? -outward : outward;
  const double low_s = low_is_incident ? s0 : 0.0;
  const double high_s = high_is_incident ? s1 : reach;
  const bool stretch = span > 0.0 && high_s > low_s;
  const double width = stretch ? high_s - low_s : 0.0;
  const bool low_touches = low_depth < margin, high_touches = high_depth < margin;
  // along the normal turned left: against `along` when the reference is B
  if (stretch && low_touches && high_touches)
    return axis.edge_of_b ? ContactGeometry{normal, 2, {high_end, low_end}, width, 0.0}
                          : ContactGeometry{normal, 2, {low_end, high_end}, width, 0.0};
  // chord growth at the deepest corner: cotangents of its two sides against the reference edge
  const Vec2 side_before = turned_left(i.normal[before]);
  const Vec2 side_after = turned_left(i.normal[deepest]);
  const double rise_before = -dot(outward, side_before);
  const double rise_after = dot(outward, side_after);
  double growth = 0.0;
  if (rise_before > 0.0) growth += -dot(along, side_before) / rise_before;
  if (rise_after > 0.0) growth += -dot(along, side_after) / rise_after;
  if (stretch)
    return {normal, low_touches || high_touches ? 1 : 0, {low_touches ? low_end : high_end, high_end}, width, growth};
  // beyond each other's ends (corner against corner): only the deepest corner touches
  const Vec2 corner = to_i + i.corner[deepest];
  const ContactPoint at_corner{corner - (0.5 * axis.distance) * outward, axis.distance, 2 * deepest + (1 - side_r)};
  return {normal, axis.distance < margin ? 1 : 0, {at_corner, {}}, width, growth};
}

/// Length over which the two outlines face each other along `tangent` [m]: no chord of theirs can be longer.
GEM_HD inline double facing_length(const Outline& a, const Outline& b, Vec2 offset, Vec2 tangent) {
  const double a_low = dot(tangent, a.corner[detail::support_corner(a, tangent)]);
  const double a_high = dot(tangent, a.corner[detail::support_corner(a, -tangent)]);
  const double shift = dot(tangent, offset);
  const double b_low = shift + dot(tangent, b.corner[detail::support_corner(b, tangent)]);
  const double b_high = shift + dot(tangent, b.corner[detail::support_corner(b, -tangent)]);
  const double low = a_low > b_low ? a_low : b_low;
  const double high = a_high < b_high ? a_high : b_high;
  return high > low ? high - low : 0.0;
}

}  // namespace gem
