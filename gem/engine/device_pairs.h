// The pairs phase of a moment: look at near pairs, find where they touch, resolve their events.
//
//   1. each thread: does the last look at a pair still say that it cannot touch?
//   2. each group of lanes: follow the pair's axes, add up its chord
//   3. each thread: the event of one touching pair, into the rows of its bodies
#pragma once

#include "gem/engine/crew.h"
#include "gem/engine/device_scene.h"
#include "gem/engine/lane_geometry.h"
#include "gem/engine/pair_event.h"

namespace gem {

/// Slack for rounding where a bound on motion spares a look [m].
constexpr double look_rounding = 1e-9;

/// A block's stretch of [0, count).
struct Stretch {
  std::int32_t begin = 0, end = 0;
};

template <class Crew>
GEM_DEVICE inline Stretch stretch_of(const Crew& crew, std::int32_t count) {
  const std::int64_t all = count;
  return {static_cast<std::int32_t>(all * crew.block() / crew.blocks()),
          static_cast<std::int32_t>(all * (crew.block() + 1) / crew.blocks())};
}

/// How two bodies of a pair moved since the last look.
struct PairShift {
  Vec2 offset, shifted;
  double turned_a, turned_b;
};

GEM_DEVICE inline PairShift pair_shift(const PairCell& pair, const BodyCell& a, const BodyCell& b) {
  const Vec2 offset = b.position - a.position;
  return {offset, offset - pair.offset, a.turn_travel - pair.turned_a, b.turn_travel - pair.turned_b};
}

/// Whether the last look cannot rule out that the pair touches now.
GEM_DEVICE inline bool wants_look(const DeviceScene& s, const PairCell& pair) {
  const BodyCell &a = s.body[pair.a], &b = s.body[pair.b];
  const PairShift m = pair_shift(pair, a, b);
  const double left = pair.axes.first.distance - s.constants.contact_margin - look_rounding -
                      (a.radius * m.turned_a + b.radius * m.turned_b);
  if (left > 0.0 && dot(m.shifted, m.shifted) < left * left) return false;
  return a.active && b.active;
}

template <class Crew>
GEM_DEVICE inline void choose_looks(const DeviceScene& s, Crew& crew, Stretch mine) {
  for (std::int32_t p = mine.begin + crew.thread(); p < mine.end; p += crew.threads())
    if (wants_look(s, s.pair[p])) s.look[mine.begin + crew.add(&crew.shared().looks, 1)] = p;
}

/// One look by a group of lanes.
template <class Crew>
GEM_DEVICE inline void look(const DeviceScene& s, Crew& crew, std::int32_t p, Stretch mine) {
  const auto lanes = crew.lanes();
  const double limit = s.constants.contact_margin;
  PairCell& pair = s.pair[p];
  const BodyCell &a = s.body[pair.a], &b = s.body[pair.b];
  const Outline outline_a = s.outline(a), outline_b = s.outline(b);
  const PairShift m = pair_shift(pair, a, b);
  // an axis turns with its body and sweeps over the other, whose far side is this far from it
  const double far = 2.0 * (a.radius + b.radius) + length(m.shifted) + limit;
  const double moved = length(m.shifted) + far * (m.turned_a + m.turned_b);
  SeparatingAxes axes = pair.axes;
  lane::follow_axes(lanes, axes, outline_a, outline_b, m.offset, moved + look_rounding, limit);
  const bool touches = lanes.ballot(axes.first.distance < limit) & 1U;
  ChordSum sum;
  if (touches && s.constants.manifold == Manifold::chord_middle)
    sum = lane::chord_sum(lanes, outline_a, outline_b, m.offset);
  lanes.sync();  // every lane has read the pair before one writes it
  if (lanes.rank() != 0) return;
  pair.axes = axes;
  pair.offset = m.offset;
  pair.turned_a = a.turn_travel;
  pair.turned_b = b.turn_travel;
  if (touches) s.touch[mine.begin + crew.add(&crew.shared().touches, 1)] = {p, axes.first, sum};
}

template <class Crew>
GEM_DEVICE inline void look_at_pairs(const DeviceScene& s, Crew& crew, Stretch mine) {
  const std::int32_t groups = crew.threads() / Crew::Lanes::size;
  for (std::int32_t k = crew.thread() / Crew::Lanes::size; k < crew.shared().looks; k += groups)
    look(s, crew, s.look[mine.begin + k], mine);
}

GEM_DEVICE inline PairBodies pair_bodies(const BodyCell& a, const BodyCell& b) {
  return {{a.inverse_mass, a.inverse_inertia},
          {b.inverse_mass, b.inverse_inertia},
          a.velocity,
          b.velocity,
          a.spin,
          b.spin,
          crushed_thickness(a.kind, a.thickness, b.thickness)};
}

/// Writes what a resolved contact does into the rows of its bodies. The platform reads the contact itself; fixed bodies
/// do not move.
GEM_DEVICE inline void write_rows(const DeviceScene& s, const PairCell& pair, const PairBodies& bodies,
                                  const Contact& contact, std::int32_t moment) {
  RowEntry &to_a = s.entry[pair.row_a], &to_b = s.entry[pair.row_b];
  std::int32_t touched = 0;
  for (int k = 0; k < contact.count; ++k) {
    const ContactSlot& slot = contact.slot[k];
    const Vec2 impulse = world_impulse(contact, slot.impulse);
    const MotionStep step = motion_step(bodies.mass_a, slot.arm_a, impulse);
    to_a.step[k] = {-step.velocity, -step.spin};
    to_b.step[k] = motion_step(bodies.mass_b, slot.arm_b, impulse);
    touched |= acted(slot) ? 1 : 0;
  }
  to_a.count = to_b.count = contact.count;
  to_a.acted = to_b.acted = touched;
  s.stamp[pair.row_a].entry = moment;
  s.stamp[pair.row_b].entry = moment;
}

/// Keeps what the record of a platform event is made of, before the bodies move.
GEM_DEVICE inline void keep_event(const DeviceScene& s, const PairCell& pair, const BodyCell& a, const BodyCell& b,
                                  const Contact& contact, std::int32_t moment) {
  if (!s.wants_events || pair.a != 0 || b.kind != BodyKind::floe || !is_event(contact, s.event_speed)) return;
  const std::int32_t place = pair.row_a - a.row_begin;
  s.row_event[place] = {moment, contact, b.position, a.position, s.motion[pair.a].rotation, s.motion[pair.b].rotation};
  s.row_event_moment[place] = moment;
}

/// The event of one touching pair.
template <class Crew>
GEM_DEVICE inline void resolve(const DeviceScene& s, Crew& crew, const Touch& touch, Stretch mine,
                               std::int32_t moment) {
  const PairCell& pair = s.pair[touch.pair];
  const BodyCell &a = s.body[pair.a], &b = s.body[pair.b];
  const Outline outline_a = s.outline(a), outline_b = s.outline(b);
  const Vec2 offset = b.position - a.position;
  const ContactGeometry geometry =
      s.constants.manifold == Manifold::chord_middle
          ? chord_geometry(outline_a, outline_b, offset, touch.axis, touch.sum)
          : face_contact(outline_a, outline_b, offset, touch.axis, s.constants.contact_margin);
  if (geometry.count == 0) return;
  Contact contact;
  open_contact(contact, pair.a, pair.b, geometry, offset);
  const PairBodies bodies = pair_bodies(a, b);
  Vec2 shift;
  if (pair.a == 0) shift = s.platform->moved - a.position;
  prepare(s.constants, bodies, shift, contact);
  resolve_alone(s.constants, bodies.mass_a, bodies.mass_b, contact);
  s.contact[touch.pair] = contact;
  write_rows(s, pair, bodies, contact, moment);
  keep_event(s, pair, a, b, contact, moment);
  BlockCell& shared = crew.shared();
  s.touched[mine.begin + crew.add(&shared.touched, 1)] = touch.pair;
  for (int k = 0; k < contact.count; ++k) {
    const double depth = -contact.slot[k].separation;
    if (depth >= 0.0) crew.add(&shared.contacts, 1);
    if (depth > 0.0) crew.highest(&shared.overlap, strict::bits_of(depth));
  }
}

/// Energy that the contacts of the last moment took, now that all velocities after it are known.
template <class Crew>
GEM_DEVICE inline void work_of_last_moment(const DeviceScene& s, Crew& crew, Stretch mine, std::int32_t stamp) {
  for (std::int32_t k = crew.thread(); k < crew.shared().touched; k += crew.threads()) {
    const std::int32_t p = s.touched[mine.begin + k];
    const PairCell& pair = s.pair[p];
    const BodyCell &a = s.body[pair.a], &b = s.body[pair.b];
    const Contact& contact = s.contact[p];
    PairBodies after;
    after.velocity_a = a.velocity_after;
    after.velocity_b = b.velocity_after;
    after.spin_a = a.spin_after;
    after.spin_b = b.spin_after;
    RowWork& work = s.work[pair.row_b];
    for (int j = 0; j < contact.count; ++j) {
      const ContactSlot& slot = contact.slot[j];
      work.slot[j] = acted(slot) ? slot_work(contact, slot, relative_velocity(after, slot)) : SlotWork{};
    }
    work.count = contact.count;
    s.stamp[pair.row_b].work = stamp;
  }
}

/// The pairs phase of one moment.
template <class Crew>
GEM_DEVICE inline void pairs_phase(const DeviceScene& s, Crew& crew, Stretch mine, std::int32_t moment) {
  BlockCell& shared = crew.shared();
  work_of_last_moment(s, crew, mine, moment);
  choose_looks(s, crew, mine);
  crew.block_barrier();
  look_at_pairs(s, crew, mine);
  if (crew.thread() == 0) shared.touched = 0;
  crew.block_barrier();
  for (std::int32_t k = crew.thread(); k < shared.touches; k += crew.threads())
    resolve(s, crew, s.touch[mine.begin + k], mine, moment);
}

}  // namespace gem
