// The geometry of a pair by a group of lanes. Every lane gets the result that one thread alone would get.
#pragma once

#include "gem/geometry/convex_contact.h"

namespace gem::lane {

/// The smallest of the lanes' values, on all lanes.
template <class Lanes>
GEM_DEVICE inline double smallest_of(const Lanes& lanes, double value) {
  for (int step = 1; step < Lanes::size; step *= 2) {
    const double other = lanes.partner(value, step);
    if (other < value) value = other;
  }
  return value;
}

/// edge_separation() with a corner of B for each lane [m].
template <class Lanes>
GEM_DEVICE inline double edge_separation(const Lanes& lanes, const Outline& a, int edge, const Outline& b,
                                         Vec2 offset) {
  const Vec2 normal = a.normal[edge];
  double smallest = 1e300;
  for (int j = lanes.rank(); j < b.count; j += Lanes::size) {
    const double along = dot(normal, b.corner[j]);
    if (along < smallest) smallest = along;
  }
  return smallest_of(lanes, smallest) + dot(normal, offset - a.corner[edge]);
}

template <class Lanes>
GEM_DEVICE inline double separation_along(const Lanes& lanes, const Separation& axis, const Outline& a,
                                          const Outline& b, Vec2 offset) {
  return axis.edge_of_b ? edge_separation(lanes, b, axis.edge, a, -offset)
                        : edge_separation(lanes, a, axis.edge, b, offset);
}

/// A separating axis with its index in the order of find_axes(): the lower index wins a tie.
struct RankedAxis {
  double distance = -1e300;
  int order = 1 << 30;
};

struct RankedAxes {
  RankedAxis first, second;
  double others = -1e300;
};

GEM_DEVICE inline bool parts_more(const RankedAxis& p, const RankedAxis& q) {
  return p.distance > q.distance || (p.distance == q.distance && p.order < q.order);
}

GEM_DEVICE inline void offer(RankedAxes& axes, const RankedAxis& axis) {
  if (parts_more(axis, axes.first)) {
    axes.others = axes.second.distance;
    axes.second = axes.first;
    axes.first = axis;
  } else if (parts_more(axis, axes.second)) {
    axes.others = axes.second.distance;
    axes.second = axis;
  } else if (axis.distance > axes.others) {
    axes.others = axis.distance;
  }
}

/// find_axes() with some edges for each lane.
template <class Lanes>
GEM_DEVICE inline SeparatingAxes find_axes(const Lanes& lanes, const Outline& a, const Outline& b, Vec2 offset) {
  RankedAxes best;
  for (int e = lanes.rank(); e < a.count + b.count; e += Lanes::size) {
    const bool of_b = e >= a.count;
    const double distance =
        of_b ? gem::edge_separation(b, e - a.count, a, -offset) : gem::edge_separation(a, e, b, offset);
    offer(best, {distance, e});
  }
  for (int step = 1; step < Lanes::size; step *= 2) {
    const RankedAxis first{lanes.partner(best.first.distance, step), lanes.partner(best.first.order, step)};
    const RankedAxis second{lanes.partner(best.second.distance, step), lanes.partner(best.second.order, step)};
    const double others = lanes.partner(best.others, step);
    offer(best, first);
    offer(best, second);
    if (others > best.others) best.others = others;
  }
  const auto axis = [&](const RankedAxis& ranked) {
    const bool of_b = ranked.order >= a.count;
    return Separation{ranked.distance, of_b ? ranked.order - a.count : ranked.order, of_b};
  };
  return {axis(best.first), axis(best.second), best.others};
}

/// Updates the distances along the two axes of the last narrow phase. Returns whether no other axis can separate the
/// outlines by more; if not, all axes have to be searched.
template <class Lanes>
GEM_DEVICE inline bool follow_two_axes(const Lanes& lanes, SeparatingAxes& axes, const Outline& a, const Outline& b,
                                       Vec2 offset, double moved, double limit) {
  axes.first.distance = separation_along(lanes, axes.first, a, b, offset);
  axes.second.distance = separation_along(lanes, axes.second, a, b, offset);
  if (axes.second.distance > axes.first.distance ||
      (axes.second.distance == axes.first.distance && detail::ranks_before(axes.second, axes.first))) {
    const Separation second = axes.first;
    axes.first = axes.second;
    axes.second = second;
  }
  axes.others += moved;
  // one answer for the group, even where a state that is not finite makes the lanes differ
  return lanes.from(axes.first.distance > limit || axes.first.distance > axes.others ? 1 : 0, 0) != 0;
}

/// Adds the crossings of two outlines with an edge of B for each lane, in the order of the edges. See crossings().
template <class Lanes>
GEM_DEVICE inline bool add_crossings(const Lanes& lanes, const Outline& a, const Outline& b, Vec2 offset, double margin,
                                     ChordSum& sum) {
  bool on_line = false;
  for (int first = 0; first < b.count; first += Lanes::size) {
    const int j = first + lanes.rank();
    CrossingEdge edge;
    if (j < b.count) edge = crossing_edge(a, b, offset, j, margin);
    on_line = on_line || lanes.ballot(j < b.count && edge.clipped.on_line) != 0;
    const bool enters = j < b.count && edge.enters(), leaves = j < b.count && edge.leaves();
    const unsigned all_enter = lanes.ballot(enters), all_leave = lanes.ballot(leaves);
    const Vec2 entry = edge.entry(), exit = edge.exit();
    for (unsigned some = all_enter | all_leave; some != 0; some &= some - 1) {
      const int k = lanes.lowest(some);
      if (all_enter >> k & 1U)
        add_entry(sum, {lanes.from(entry.x, k), lanes.from(entry.y, k)}, lanes.from(edge.clipped.entry, k), first + k);
      if (all_leave >> k & 1U)
        add_exit(sum, {lanes.from(exit.x, k), lanes.from(exit.y, k)}, lanes.from(edge.clipped.exit, k), first + k);
    }
  }
  return on_line;
}

template <class Lanes>
GEM_DEVICE inline ChordSum chord_sum(const Lanes& lanes, const Outline& a, const Outline& b, Vec2 offset) {
  return crossings([&](ChordSum& sum, double margin) { return add_crossings(lanes, a, b, offset, margin, sum); });
}

}  // namespace gem::lane
