// The narrow phase: which near pairs may touch, and where they do. Steps 1 and 2 of pairs.h.
#pragma once

#include "gem/engine/device/lane_geometry.h"
#include "gem/engine/device/workspace.h"
#include "gem/engine/step/motion_bound.h"
#include "gem/engine/step/pair_event.h"
#include "gem/geometry/piece_axis.h"

namespace gem {

/// What choose_candidate() needs of a body.
struct CandidateBody {
  Vec2 position;
  Rotation rotation;
  double turn_travel, radius;
  std::int32_t vertex_begin;
  std::int16_t vertex_count;
  bool active;
};

GEM_DEVICE inline CandidateBody candidate_body(const BodyCell& cell) {
  return {cell.position,     cell.rotation,     cell.turn_travel, cell.radius,
          cell.vertex_begin, cell.vertex_count, cell.active != 0};
}

/// Adds pair p to the candidates, at place(), unless its last narrow phase rules out that it touches now. Returns the
/// relative motion after which the pair becomes a candidate [m]; zero or less: it is a candidate now.
template <class Place>
GEM_DEVICE inline double choose_candidate(const DeviceScene& s, PairCell& pair, std::int32_t p, Place&& place) {
  const CandidateBody a = candidate_body(s.body[pair.a]), b = candidate_body(s.body[pair.b]);
  const double limit = s.constants.contact_margin;
  const Vec2 offset = b.position - a.position;
  const Vec2 shifted = offset - pair.offset;
  const double turned_a = a.turn_travel - pair.turned_a, turned_b = b.turn_travel - pair.turned_b;
  const double left = pair.axes.first.distance - limit - motion_rounding - (a.radius * turned_a + b.radius * turned_b);
  if (left > 0.0 && dot(shifted, shifted) < left * left) return left - length(shifted);
  if (!a.active || !b.active) return 0.0;
  pair.offset = offset;
  pair.turned_a = a.turn_travel;
  pair.turned_b = b.turn_travel;
  CandidatePair& item = place();
  item.pair = p;
  item.vertex_a = a.vertex_begin;
  item.vertex_b = b.vertex_begin;
  item.count_a = a.vertex_count;
  item.count_b = b.vertex_count;
  item.offset = offset;
  item.rotation_a = a.rotation;
  item.rotation_b = b.rotation;
  // an axis turns with its body and sweeps over the other body, whose far side is this far away
  const double far = 2.0 * (a.radius + b.radius) + length(shifted) + limit;
  item.moved = length(shifted) + far * (turned_a + turned_b);
  return 0.0;
}

/// An outline in world axes, after turn_in_workspace(). One that is too long for the workspace is the copy that its
/// owner keeps.
GEM_DEVICE inline Outline outline_in_workspace(const DeviceScene& s, WorkspaceOutlines& outlines, int side,
                                               std::int32_t begin, int count) {
  if (count > workspace_vertices) return {s.corner + begin, s.normal + begin, count};
  return {outlines.corner[side], outlines.normal[side], count};
}

/// Turns an outline to world axes, by the lanes of a group.
template <class Lanes>
GEM_DEVICE inline void turn_in_workspace(const DeviceScene& s, const Lanes& lanes, WorkspaceOutlines& outlines,
                                         int side, std::int32_t begin, int count, Rotation q) {
  if (count > workspace_vertices) return;
  for (int v = lanes.rank(); v < count; v += Lanes::size) {
    const Vec2 corner = s.vertex[begin + v], normal = s.body_normal[begin + v];
    outlines.corner[side][v] = rotate(q, corner);
    outlines.normal[side][v] = rotate(q, normal);
  }
}

/// Where a touching pair is written, and the index of its first point among those of its block.
struct TouchingPlace {
  std::int32_t touching, first_point;
};

GEM_DEVICE inline void write_touching(TouchingPair& touching, std::int32_t pair, std::int32_t first_point,
                                      const ContactGeometry& geometry) {
  touching.pair = pair;
  touching.first_point = first_point;
  touching.geometry.normal = geometry.normal;
  touching.geometry.count = geometry.count;
  touching.geometry.width = geometry.width;
  touching.geometry.growth = geometry.growth;
  for (int k = 0; k < 2; ++k) {
    if (k >= geometry.count) break;
    touching.geometry.point[k].position = geometry.point[k].position;
    touching.geometry.point[k].separation = geometry.point[k].separation;
    touching.geometry.point[k].feature = geometry.point[k].feature;
  }
}

/// The contact of a piece of the platform. Out of line: most scenes have none, and should not take its registers.
GEM_DEVICE GEM_NOINLINE inline ContactGeometry contact_of_piece(const DeviceScene& s, const CandidatePair& item,
                                                                const Outline& a, const Outline& b,
                                                                const Separation& axis) {
  return piece_face_contact(a, s.piece_corner + item.vertex_a, item.rotation_a, b, item.offset, axis,
                            s.constants.contact_margin);
}

/// Runs the narrow phase for some items. Each group of lanes takes one item. Few items need a search of all axes: the
/// whole warp does it. Few items touch: wider groups compute their contacts. place(points) returns the TouchingPlace
/// for a contact of `points` points.
template <class Group, class Place>
class NarrowPhase {
 public:
  GEM_DEVICE NarrowPhase(const DeviceScene& s, Group& group, PairCell* pair, WorkspaceOutlines* outlines,
                         const CandidatePair* items, Place place)
      : s_(s), group_(group), pair_(pair), outlines_(outlines), items_(items), place_(place) {}

  /// Checks item `at` for the group of this thread, which is number `lane_group` in its block. All groups of a warp
  /// call it together.
  GEM_DEVICE void check(std::int32_t at, std::int32_t count, int lane_group) {
    const auto lanes = group_.lanes();
    const auto warp = group_.warp();
    const bool has_item = at < count;
    SeparatingAxes axes;
    bool known = true;
    if (has_item) {
      const CandidatePair& item = items_[at];
      turn_in_workspace(s_, lanes, outlines_[lane_group], 0, item.vertex_a, item.count_a, item.rotation_a);
      turn_in_workspace(s_, lanes, outlines_[lane_group], 1, item.vertex_b, item.count_b, item.rotation_b);
      axes = pair_[item.pair].axes;
      lanes.sync();
      known = lane::follow_two_axes(lanes, axes, outline(at, lane_group, 0), outline(at, lane_group, 1), item.offset,
                                    item.moved + motion_rounding, limit());
    }
    warp.sync();
    for (unsigned left = warp.ballot(!known && lanes.rank() == 0); left != 0; left &= left - 1) {
      const int ahead = warp.lowest(left) / Group::Lanes::size - warp.rank() / Group::Lanes::size;  // groups
      const std::int32_t its = at + ahead;
      const SeparatingAxes found = lane::find_axes(warp, outline(its, lane_group + ahead, 0),
                                                   outline(its, lane_group + ahead, 1), items_[its].offset);
      if (ahead == 0) axes = found;
    }
    const bool touches = has_item && axes.first.distance < limit();
    if (has_item && lanes.rank() == 0) pair_[items_[at].pair].axes = axes;
    warp.sync();
    unsigned left = warp.ballot(touches && lanes.rank() == 0);
    while (left != 0) {
      constexpr int together = Group::Warp::size / Group::Wide::size;
      unsigned mine = 0;
      for (int k = 0; k < together; ++k, left &= left - 1)
        if (k == warp.rank() / Group::Wide::size) mine = left;
      if (mine == 0) continue;
      const int ahead = warp.lowest(mine) / Group::Lanes::size - warp.rank() / Group::Lanes::size;
      describe(at + ahead, lane_group + ahead);
    }
    warp.sync();  // before the outlines are overwritten
  }

 private:
  GEM_DEVICE double limit() const { return s_.constants.contact_margin; }

  GEM_DEVICE Outline outline(std::int32_t at, int lane_group, int side) const {
    const CandidatePair& item = items_[at];
    return side == 0 ? outline_in_workspace(s_, outlines_[lane_group], 0, item.vertex_a, item.count_a)
                     : outline_in_workspace(s_, outlines_[lane_group], 1, item.vertex_b, item.count_b);
  }

  GEM_DEVICE bool is_of_piece(const CandidatePair& item) const {
    return s_.piece_corner && s_.constants.is_platform(pair_[item.pair].a);
  }

  /// The contact geometry of a touching pair, by a wide group.
  GEM_DEVICE void describe(std::int32_t at, int lane_group) {
    const auto wide = group_.wide();
    const CandidatePair& item = items_[at];
    const bool chord = s_.constants.manifold == Manifold::chord_middle;
    const Outline a = outline(at, lane_group, 0), b = outline(at, lane_group, 1);
    ChordSum sum;
    if (chord) sum = lane::chord_sum(wide, a, b, item.offset);
    if (wide.rank() != 0) return;
    const Separation axis = pair_[item.pair].axes.first;
    const ContactGeometry geometry = chord               ? chord_geometry(a, b, item.offset, axis, sum)
                                     : is_of_piece(item) ? contact_of_piece(s_, item, a, b, axis)
                                                         : face_contact(a, b, item.offset, axis, limit());
    if (geometry.count == 0) return;
    const TouchingPlace to = place_(geometry.count);
    write_touching(s_.touching[to.touching], item.pair, to.first_point, geometry);
  }

  const DeviceScene& s_;
  Group& group_;
  PairCell* pair_;
  WorkspaceOutlines* outlines_;
  const CandidatePair* items_;
  Place place_;
};

/// Checks items first, first + step, ... below `count` by the group of this thread.
template <class Group, class Place>
GEM_DEVICE inline void narrow_phase_of(const DeviceScene& s, Group& group, PairCell* pair, WorkspaceOutlines* outlines,
                                       const CandidatePair* items, std::int32_t first, std::int32_t count,
                                       std::int32_t step, Place&& place) {
  constexpr int of_warp = Group::Warp::size / Group::Lanes::size;
  const int lane_group = group.thread() / Group::Lanes::size;
  NarrowPhase<Group, Place&> narrow_phase(s, group, pair, outlines, items, place);
  // all lane groups of a warp take part in its ballots, so the warp loops while its first group has an item
  for (std::int32_t at = first; at - lane_group % of_warp < count; at += step)
    narrow_phase.check(at, count, lane_group);
}

}  // namespace gem
