// The chord of the overlap of two convex outlines.
//
// Outlines are in world axes relative to their own centroids; `offset` is the vector from A's centroid to B's.
//
// Where an edge of B lies on the line of an edge of A, the outlines cross anywhere along both. Rounding would choose
// the place, and tilt the chord by up to depth / width. So the crossings are then found twice, with A wider and
// narrower by a small margin where inside is told from outside, and the mean is taken: the middle of the common
// stretch. The chord of aligned faces is parallel to them, whatever the order, the orientation and the place of the
// bodies.
#pragma once

#include "gem/geometry/contact_geometry.h"
#include "gem/geometry/separating_axes.h"

namespace gem {

namespace detail {

/// Edges closer to each other than this lie on one line: above the rounding of positions 1e6 m from the origin [m].
constexpr double one_line = 1e-9;

/// The part of edge p -> q inside all edges of `a`: its parameters, and the edges of `a` that cut it (-1: uncut).
struct ClippedEdge {
  double begin = 0.0, end = 1.0;         // with the margin
  double entry_at = 0.0, exit_at = 1.0;  // where the edge meets those that cut it, without the margin
  int entry = -1, exit = -1;
  bool on_line = false;  // p -> q lies on the line of an edge of `a`
};

/// `margin`: by which `a` is wider when inside is told from outside [m].
GEM_HD inline ClippedEdge clip_edge(const Outline& a, Vec2 p, Vec2 q, double margin) {
  ClippedEdge clipped;
  for (int i = 0; i < a.count; ++i) {
    const double line_p = dot(a.normal[i], p - a.corner[i]), line_q = dot(a.normal[i], q - a.corner[i]);
    if (line_p < one_line && line_p > -one_line && line_q < one_line && line_q > -one_line) clipped.on_line = true;
    const double at_p = line_p - margin, at_q = line_q - margin;
    if (at_p > 0.0 && at_q > 0.0) {
      clipped.begin = 1.0;
      clipped.end = 0.0;
      return clipped;
    }
    if (!(at_p > 0.0 || at_q > 0.0)) continue;
    const double t = at_p / (at_p - at_q), met = line_p / (line_p - line_q);
    const double within = met < 0.0 ? 0.0 : met > 1.0 ? 1.0 : met;
    if (at_p > 0.0 && t > clipped.begin) {
      clipped.begin = t;
      clipped.entry_at = within;
      clipped.entry = i;
    }
    if (!(at_p > 0.0) && t < clipped.end) {
      clipped.end = t;
      clipped.exit_at = within;
      clipped.exit = i;
    }
  }
  return clipped;
}

/// Rate at which the crossing of an edge of A (direction `edge_a`) with an edge of B (normal `normal_b`) moves along
/// `tangent` as B moves into A against `normal`; 0 for parallel edges.
GEM_HD inline double crossing_rate(Vec2 edge_a, Vec2 normal_b, Vec2 normal, Vec2 tangent) {
  const double denominator = dot(edge_a, normal_b);
  if (denominator == 0.0) return 0.0;
  return -(dot(normal, normal_b) / denominator) * dot(edge_a, tangent);
}

}  // namespace detail

/// The edges of A and B where B enters A and where it leaves it.
struct ChordEdges {
  int entry_a = 0, entry_b = 0, exit_a = 0, exit_b = 0;
};

/// The crossings of two outlines, summed over the edges of B.
struct ChordSum {
  Vec2 chord, middle;
  double size = 0.0;  // size of the coordinates whose difference is the chord, for rounding
  int entries = 0, exits = 0;
  ChordEdges edges;  // of the last crossing of each kind
  int sets = 1;      // how often the crossings were found and added
  ChordEdges wider;  // of the first set, if there are two
};

/// Adds a crossing where the outline of B enters A through its edge `edge_a`.
GEM_HD inline void add_entry(ChordSum& sum, Vec2 crossing, int edge_a, int edge_b) {
  sum.chord -= crossing;
  sum.size += length(crossing);
  sum.middle += crossing;
  sum.edges.entry_a = edge_a;
  sum.edges.entry_b = edge_b;
  ++sum.entries;
}

/// Adds a crossing where the outline of B leaves A.
GEM_HD inline void add_exit(ChordSum& sum, Vec2 crossing, int edge_a, int edge_b) {
  sum.chord += crossing;
  sum.size += length(crossing);
  sum.middle += crossing;
  sum.edges.exit_a = edge_a;
  sum.edges.exit_b = edge_b;
  ++sum.exits;
}

/// Adds the crossings of one edge of B.
struct CrossingEdge {
  Vec2 begin, end;
  detail::ClippedEdge clipped;
  GEM_HD Vec2 entry() const { return begin + clipped.entry_at * (end - begin); }
  GEM_HD Vec2 exit() const { return begin + clipped.exit_at * (end - begin); }
  GEM_HD bool enters() const { return clipped.begin < clipped.end && clipped.entry >= 0; }
  GEM_HD bool leaves() const { return clipped.begin < clipped.end && clipped.exit >= 0; }
};

/// Crossings of edge `edge` of B with A, which is wider by `margin` [m].
GEM_HD inline CrossingEdge crossing_edge(const Outline& a, const Outline& b, Vec2 offset, int edge, double margin) {
  const Vec2 p = offset + b.corner[edge];
  const Vec2 q = offset + b.corner[edge + 1 < b.count ? edge + 1 : 0];
  return {p, q, detail::clip_edge(a, p, q, margin)};
}

namespace detail {

/// Growth of the chord with depth. The tangent points from where B enters A to where it leaves.
GEM_HD inline double chord_growth(const Outline& a, const Outline& b, const ChordEdges& edges, Vec2 normal,
                                  Vec2 tangent) {
  // edge direction = normal turned left
  const Vec2 exit_edge = turned_left(a.normal[edges.exit_a]), entry_edge = turned_left(a.normal[edges.entry_a]);
  return crossing_rate(exit_edge, b.normal[edges.exit_b], normal, tangent) -
         crossing_rate(entry_edge, b.normal[edges.entry_b], normal, tangent);
}

}  // namespace detail

/// The chord of an overlap joins the two crossings of the outlines. The normal is perpendicular to it, and the contact
/// point is its middle. Several crossings (deep overlap) are summed to one resultant chord. Without a crossing (one
/// outline inside the other, or an overlap below rounding) the separating axis and its deepest corner are used, with
/// width 0.
GEM_HD inline ContactGeometry chord_geometry(const Outline& a, const Outline& b, Vec2 offset, const Separation& axis,
                                             const ChordSum& sum) {
  ContactGeometry contact;
  const double width = length(sum.chord) / sum.sets;
  contact.count = 1;
  contact.point[0].separation = axis.distance;
  constexpr double rounding = 4e-15;
  if (sum.entries == sum.exits && sum.entries > 0 && width > rounding * sum.size) {
    const Vec2 tangent = (1.0 / (sum.sets * width)) * sum.chord;
    contact.normal = turned_left(tangent);
    contact.point[0].position = (0.5 / sum.entries) * sum.middle;
    contact.width = width;
    contact.growth = detail::chord_growth(a, b, sum.edges, contact.normal, tangent);
    if (sum.sets == 2)
      contact.growth = 0.5 * (contact.growth + detail::chord_growth(a, b, sum.wider, contact.normal, tangent));
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

/// The crossings of two outlines. `add(sum, margin)` adds those with A wider by `margin` [m] and returns whether an
/// edge lies on the line of another.
template <class Add>
GEM_HD inline ChordSum crossings(Add&& add) {
  ChordSum sum;
  if (!add(sum, 0.0)) return sum;
  sum = {};
  add(sum, detail::one_line);
  const int entries = sum.entries;
  sum.wider = sum.edges;
  add(sum, -detail::one_line);
  // an overlap less deep than the margin has no crossing with the narrower outline
  if (entries > 0 && sum.entries > entries) sum.sets = 2;
  return sum;
}

GEM_HD inline ContactGeometry chord_contact(const Outline& a, const Outline& b, Vec2 offset, const Separation& axis) {
  const ChordSum crossed = crossings([&](ChordSum& sum, double margin) {
    bool on_line = false;
    for (int j = 0; j < b.count; ++j) {
      const CrossingEdge edge = crossing_edge(a, b, offset, j, margin);
      on_line = on_line || edge.clipped.on_line;
      if (edge.enters()) add_entry(sum, edge.entry(), edge.clipped.entry, j);
      if (edge.leaves()) add_exit(sum, edge.exit(), edge.clipped.exit, j);
    }
    return on_line;
  });
  return chord_geometry(a, b, offset, axis, crossed);
}

/// Length over which both outlines face each other along `tangent` [m]: an upper bound of the chord.
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
