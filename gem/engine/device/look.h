// Looks at near pairs: which may touch, and where they do. Steps 1 and 2 of device_pairs.h.
#pragma once

#include "gem/engine/device/desk.h"
#include "gem/engine/device/lane_geometry.h"
#include "gem/engine/step/pair_event.h"

namespace gem {

/// Slack for rounding where a bound on motion spares a look [m].
constexpr double look_rounding = 1e-9;

/// What choosing needs of a body.
struct LookBody {
  Vec2 position;
  Rotation rotation;
  double turn_travel, radius;
  std::int32_t vertex_begin;
  std::int16_t vertex_count;
  bool active;
};

GEM_DEVICE inline LookBody look_body(const BodyCell& cell) {
  return {cell.position,     cell.rotation,     cell.turn_travel, cell.radius,
          cell.vertex_begin, cell.vertex_count, cell.active != 0};
}

/// Puts pair p at place() to be looked at, unless the last look rules out that it touches now. Returns by how much its
/// bodies may still move, one relative to the other, before it has to be looked at; not above 0: looked at [m].
template <class Place>
GEM_DEVICE inline double choose_look(const DeviceScene& s, PairCell& pair, std::int32_t p, Place&& place) {
  const LookBody a = look_body(s.body[pair.a]), b = look_body(s.body[pair.b]);
  const double limit = s.constants.contact_margin;
  const Vec2 offset = b.position - a.position;
  const Vec2 shifted = offset - pair.offset;
  const double turned_a = a.turn_travel - pair.turned_a, turned_b = b.turn_travel - pair.turned_b;
  const double left = pair.axes.first.distance - limit - look_rounding - (a.radius * turned_a + b.radius * turned_b);
  if (left > 0.0 && dot(shifted, shifted) < left * left) return left - length(shifted);
  if (!a.active || !b.active) return 0.0;
  pair.offset = offset;
  pair.turned_a = a.turn_travel;
  pair.turned_b = b.turn_travel;
  LookItem& item = place();
  item.pair = p;
  item.vertex_a = a.vertex_begin;
  item.vertex_b = b.vertex_begin;
  item.count_a = a.vertex_count;
  item.count_b = b.vertex_count;
  item.offset = offset;
  item.rotation_a = a.rotation;
  item.rotation_b = b.rotation;
  // an axis turns with its body and sweeps over the other, whose far side is this far from it
  const double far = 2.0 * (a.radius + b.radius) + length(shifted) + limit;
  item.moved = length(shifted) + far * (turned_a + turned_b);
  return 0.0;
}

/// An outline in world axes, once it is turned: where it is too long for the room, the one that its owner keeps.
GEM_DEVICE inline Outline outline_in_room(const DeviceScene& s, DeskOutlines& room, int side, std::int32_t begin,
                                          int count) {
  if (count > desk_vertices) return {s.corner + begin, s.normal + begin, count};
  return {room.corner[side], room.normal[side], count};
}

/// Turns an outline by the lanes of a group.
template <class Lanes>
GEM_DEVICE inline void turn_at_desk(const DeviceScene& s, const Lanes& lanes, DeskOutlines& room, int side,
                                    std::int32_t begin, int count, Rotation q) {
  if (count > desk_vertices) return;
  for (int v = lanes.rank(); v < count; v += Lanes::size) {
    const Vec2 corner = s.vertex[begin + v], normal = s.body_normal[begin + v];
    room.corner[side][v] = rotate(q, corner);
    room.normal[side][v] = rotate(q, normal);
  }
}

/// Where a touch is written, and its first point among those of its block.
struct TouchPlace {
  std::int32_t touch, first_point;
};

GEM_DEVICE inline void write_touch(Touch& touch, std::int32_t pair, std::int32_t first_point,
                                   const ContactGeometry& geometry) {
  touch.pair = pair;
  touch.first_point = first_point;
  touch.geometry.normal = geometry.normal;
  touch.geometry.count = geometry.count;
  touch.geometry.width = geometry.width;
  touch.geometry.growth = geometry.growth;
  for (int k = 0; k < 2; ++k) {
    if (k >= geometry.count) break;
    touch.geometry.point[k].position = geometry.point[k].position;
    touch.geometry.point[k].separation = geometry.point[k].separation;
    touch.geometry.point[k].feature = geometry.point[k].feature;
  }
}

/// Looks at some items: each group of lanes takes one. Few need all axes searched: the warp does that together. Not
/// many touch: wider groups share out their crossings. place(points) is where a touch of so many points is written, and
/// its first point among those of its block.
template <class Crew, class Place>
class Looks {
 public:
  GEM_DEVICE Looks(const DeviceScene& s, Crew& crew, PairCell* pair, DeskOutlines* outlines, const LookItem* items,
                   Place place)
      : s_(s), crew_(crew), pair_(pair), outlines_(outlines), items_(items), place_(place) {}

  /// Item `at` for the group of this thread, which stands at `group` in its block; others of the warp look at theirs.
  GEM_DEVICE void look(std::int32_t at, std::int32_t count, int group) {
    const auto lanes = crew_.lanes();
    const auto warp = crew_.warp();
    const bool looks = at < count;
    SeparatingAxes axes;
    bool known = true;
    if (looks) {
      const LookItem& item = items_[at];
      turn_at_desk(s_, lanes, outlines_[group], 0, item.vertex_a, item.count_a, item.rotation_a);
      turn_at_desk(s_, lanes, outlines_[group], 1, item.vertex_b, item.count_b, item.rotation_b);
      axes = pair_[item.pair].axes;
      lanes.sync();
      known = lane::follow_two_axes(lanes, axes, outline(at, group, 0), outline(at, group, 1), item.offset,
                                    item.moved + look_rounding, limit());
    }
    warp.sync();
    for (unsigned left = warp.ballot(!known && lanes.rank() == 0); left != 0; left &= left - 1) {
      const int ahead = warp.lowest(left) / Crew::Lanes::size - warp.rank() / Crew::Lanes::size;  // groups
      const std::int32_t its = at + ahead;
      const SeparatingAxes found =
          lane::find_axes(warp, outline(its, group + ahead, 0), outline(its, group + ahead, 1), items_[its].offset);
      if (ahead == 0) axes = found;
    }
    const bool touches = looks && axes.first.distance < limit();
    if (looks && lanes.rank() == 0) pair_[items_[at].pair].axes = axes;
    warp.sync();
    unsigned left = warp.ballot(touches && lanes.rank() == 0);
    while (left != 0) {
      constexpr int together = Crew::Warp::size / Crew::Wide::size;
      unsigned mine = 0;
      for (int k = 0; k < together; ++k, left &= left - 1)
        if (k == warp.rank() / Crew::Wide::size) mine = left;
      if (mine == 0) continue;
      const int ahead = warp.lowest(mine) / Crew::Lanes::size - warp.rank() / Crew::Lanes::size;
      describe(at + ahead, group + ahead);
    }
    warp.sync();  // before the room is used again
  }

 private:
  GEM_DEVICE double limit() const { return s_.constants.contact_margin; }

  GEM_DEVICE Outline outline(std::int32_t at, int group, int side) const {
    const LookItem& item = items_[at];
    return side == 0 ? outline_in_room(s_, outlines_[group], 0, item.vertex_a, item.count_a)
                     : outline_in_room(s_, outlines_[group], 1, item.vertex_b, item.count_b);
  }

  /// The geometry of a touch, by a wide group.
  GEM_DEVICE void describe(std::int32_t at, int group) {
    const auto wide = crew_.wide();
    const LookItem& item = items_[at];
    const bool chord = s_.constants.manifold == Manifold::chord_middle;
    const Outline a = outline(at, group, 0), b = outline(at, group, 1);
    ChordSum sum;
    if (chord) sum = lane::chord_sum(wide, a, b, item.offset);
    if (wide.rank() != 0) return;
    const Separation axis = pair_[item.pair].axes.first;
    const ContactGeometry geometry =
        chord ? chord_geometry(a, b, item.offset, axis, sum) : face_contact(a, b, item.offset, axis, limit());
    if (geometry.count == 0) return;
    const TouchPlace to = place_(geometry.count);
    write_touch(s_.touch[to.touch], item.pair, to.first_point, geometry);
  }

  const DeviceScene& s_;
  Crew& crew_;
  PairCell* pair_;
  DeskOutlines* outlines_;
  const LookItem* items_;
  Place place_;
};

/// Looks at items: the group of this thread at `first`, first + step, ... below `count`.
template <class Crew, class Place>
GEM_DEVICE inline void look_at_items(const DeviceScene& s, Crew& crew, PairCell* pair, DeskOutlines* outlines,
                                     const LookItem* items, std::int32_t first, std::int32_t count, std::int32_t step,
                                     Place&& place) {
  constexpr int of_warp = Crew::Warp::size / Crew::Lanes::size;
  const int group = crew.thread() / Crew::Lanes::size;
  Looks<Crew, Place&> looks(s, crew, pair, outlines, items, place);
  // as long as the first group of the warp has an item
  for (std::int32_t at = first; at - group % of_warp < count; at += step) looks.look(at, count, group);
}

}  // namespace gem
