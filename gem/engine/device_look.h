// Looks at near pairs: which may touch, and where they do. Steps 1 and 2 of device_pairs.h.
#pragma once

#include "gem/engine/device_desk.h"
#include "gem/engine/lane_geometry.h"
#include "gem/engine/pair_event.h"

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

/// Puts the pair on the desk to be looked at, unless the last look rules out that it touches now.
template <class Crew>
GEM_DEVICE inline void choose_look(const DeviceScene& s, Crew& crew, const Desk& desk, std::int32_t p) {
  PairCell& pair = desk.pair[p];
  const LookBody a = look_body(s.body[pair.a]), b = look_body(s.body[pair.b]);
  const double limit = s.constants.contact_margin;
  const Vec2 offset = b.position - a.position;
  const Vec2 shifted = offset - pair.offset;
  const double turned_a = a.turn_travel - pair.turned_a, turned_b = b.turn_travel - pair.turned_b;
  const double left = pair.axes.first.distance - limit - look_rounding - (a.radius * turned_a + b.radius * turned_b);
  if (left > 0.0 && dot(shifted, shifted) < left * left) return;
  if (!a.active || !b.active) return;
  pair.offset = offset;
  pair.turned_a = a.turn_travel;
  pair.turned_b = b.turn_travel;
  LookItem& item = desk.look[crew.add(&crew.shared().looks, 1)];
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
}

/// An outline in world axes: turned by the lanes of a group, or where it is too long the one that its owner keeps.
template <class Lanes>
GEM_DEVICE inline Outline outline_at_desk(const DeviceScene& s, const Lanes& lanes, DeskOutlines& room, int side,
                                          std::int32_t begin, int count, Rotation q) {
  if (count > desk_vertices) return {s.corner + begin, s.normal + begin, count};
  for (int v = lanes.rank(); v < count; v += Lanes::size) {
    const Vec2 corner = s.vertex[begin + v], normal = s.body_normal[begin + v];
    room.corner[side][v] = rotate(q, corner);
    room.normal[side][v] = rotate(q, normal);
  }
  return {room.corner[side], room.normal[side], count};
}

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

/// One look by a group of lanes.
template <class Crew>
GEM_DEVICE inline void look(const DeviceScene& s, Crew& crew, const Desk& desk, const LookItem& item) {
  const auto lanes = crew.lanes();
  const double limit = s.constants.contact_margin;
  DeskOutlines& room = desk.outlines[crew.thread() / Crew::Lanes::size];
  const Outline a = outline_at_desk(s, lanes, room, 0, item.vertex_a, item.count_a, item.rotation_a);
  const Outline b = outline_at_desk(s, lanes, room, 1, item.vertex_b, item.count_b, item.rotation_b);
  SeparatingAxes axes = desk.pair[item.pair].axes;
  lanes.sync();
  lane::follow_axes(lanes, axes, a, b, item.offset, item.moved + look_rounding, limit);
  const bool touches = lanes.ballot(axes.first.distance < limit) & 1U;
  ChordSum sum;
  if (touches && s.constants.manifold == Manifold::chord_middle) sum = lane::chord_sum(lanes, a, b, item.offset);
  if (lanes.rank() == 0) {
    desk.pair[item.pair].axes = axes;
    if (touches) {
      ContactGeometry geometry = s.constants.manifold == Manifold::chord_middle
                                     ? chord_geometry(a, b, item.offset, axes.first, sum)
                                     : face_contact(a, b, item.offset, axes.first, limit);
      if (geometry.count > 0)
        write_touch(s.touch[desk.pairs.begin + crew.add(&crew.shared().touches, 1)], item.pair,
                    crew.add(&crew.shared().points, geometry.count), geometry);
    }
  }
  lanes.sync();  // before the room is used again
}

}  // namespace gem
