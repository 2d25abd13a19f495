// The pairs phase of a moment: look at near pairs, find where they touch, resolve their events.
//
//   1. each thread: does the last look at a pair still say that it cannot touch?
//   2. each group of lanes: turn the two outlines, follow the pair's axes, find the contact
//   3. each thread: the event of one touching pair, into the rows of its bodies
#pragma once

#include "gem/engine/device/look.h"
#include "gem/engine/solver/device_points.h"

namespace gem {

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
  for (int k = 0; k < 2; ++k) {
    if (k >= contact.count) break;
    const ContactSlot& slot = contact.slot[k];
    const Vec2 impulse = world_impulse(contact, slot.impulse);
    const MotionStep step = motion_step(bodies.mass_a, slot.arm_a, impulse);
    to_a.velocity[k] = -step.velocity;
    to_a.spin[k] = -step.spin;
    const MotionStep step_b = motion_step(bodies.mass_b, slot.arm_b, impulse);
    to_b.velocity[k] = step_b.velocity;
    to_b.spin[k] = step_b.spin;
    touched |= acted(slot) ? 1 : 0;
  }
  to_a.count = to_b.count = contact.count;
  to_a.acted = to_b.acted = touched;
  s.stamp[pair.row_a].entry = moment;
  s.stamp[pair.row_b].entry = moment;
}

/// Keeps of a contact what the books and the platform need of it.
GEM_DEVICE inline void keep_contact(Contact& kept, const Contact& contact) {
  kept.a = contact.a;
  kept.b = contact.b;
  kept.count = contact.count;
  kept.normal = contact.normal;
  for (int k = 0; k < 2; ++k) {
    if (k >= contact.count) break;
    ContactSlot& slot = kept.slot[k];
    const ContactSlot& from = contact.slot[k];
    slot.arm_a = from.arm_a;
    slot.arm_b = from.arm_b;
    slot.normal_before = from.normal_before;
    slot.tangential_before = from.tangential_before;
    slot.impulse.normal = from.impulse.normal;
    slot.impulse.tangential = from.impulse.tangential;
    slot.elastic = from.elastic;
    slot.repair = from.repair;
  }
}

/// Keeps of a contact what the iterations of a coupled moment and what follows them need.
GEM_DEVICE inline void keep_open_contact(Contact& kept, const Contact& contact) {
  keep_contact(kept, contact);
  kept.width = contact.width;
  kept.growth = contact.growth;
  kept.friction = contact.friction;
  for (int k = 0; k < 2; ++k) {
    if (k >= contact.count) break;
    kept.slot[k].separation = contact.slot[k].separation;
    kept.slot[k].feature = contact.slot[k].feature;
    kept.slot[k].target = contact.slot[k].target;
  }
}

/// Keeps what the record of a platform event is made of, before the bodies move.
GEM_DEVICE inline void keep_event(const DeviceScene& s, std::int32_t place, const BodyCell& a, const BodyCell& b,
                                  const Contact& contact, std::int32_t moment) {
  s.row_event[place] = {moment, contact, b.position, a.position, a.rotation, b.rotation};
  s.row_event_moment[place] = moment;
}

template <class Crew>
GEM_DEVICE inline void note_depth(const DeviceScene& s, Crew& crew, const Contact& contact) {
  if (!s.wants_samples) return;
  const double size = std::sqrt(smaller(s.area[contact.a], s.area[contact.b]));
  for (int k = 0; k < 2 && k < contact.count; ++k) {
    const double depth = -contact.slot[k].separation;
    if (!(depth > 0.0)) continue;
    const std::uint64_t of_depth = strict::bits_of(depth), of_share = strict::bits_of(depth / size);
    crew.highest(&crew.shared().overlap, of_depth);
    crew.highest(&crew.shared().share, of_share);
    crew.add(&s.overlap_count[OverlapCount::class_of_bits(of_depth)], 1);
    crew.add(&s.overlap_count[OverlapCount::classes + OverlapCount::class_of_bits(of_share)], 1);
  }
}

/// Coupled: a touching pair before the iterations.
template <class Crew>
GEM_DEVICE inline void open_touch(const DeviceScene& s, Crew& crew, const PairCell& pair, const Touch& touch,
                                  std::int32_t moment) {
  const BodyCell &a = s.body[pair.a], &b = s.body[pair.b];
  Contact contact;
  open_contact(contact, pair.a, pair.b, touch.geometry, b.position - a.position);
  Vec2 shift;
  if (pair.a == 0) shift = s.platform->moved - a.position;
  prepare(s.constants, pair_bodies(a, b), shift, contact);
  keep_open_contact(s.contact[touch.pair], contact);
  open_points(s, crew, pair, touch, moment);
  if (s.wants_events && pair.a == 0 && b.kind == BodyKind::floe)
    keep_event(s, pair.row_a - s.platform->row_begin, a, b, contact, moment);
  note_depth(s, crew, contact);
}

/// The event of one touching pair.
template <class Crew>
GEM_DEVICE inline void resolve(const DeviceScene& s, Crew& crew, const PairCell& pair, const Touch& touch,
                               std::int32_t moment) {
  const BodyCell &a = s.body[pair.a], &b = s.body[pair.b];
  Contact contact;
  open_contact(contact, pair.a, pair.b, touch.geometry, b.position - a.position);
  const PairBodies bodies = pair_bodies(a, b);
  Vec2 shift;
  if (pair.a == 0) shift = s.platform->moved - a.position;
  prepare(s.constants, bodies, shift, contact);
  resolve_alone(s.constants, bodies.mass_a, bodies.mass_b, contact);
  keep_contact(s.contact[touch.pair], contact);
  write_rows(s, pair, bodies, contact, moment);
  if (s.wants_events && pair.a == 0 && b.kind == BodyKind::floe && is_event(contact, s.event_speed))
    keep_event(s, pair.row_a - s.platform->row_begin, a, b, contact, moment);
  for (int k = 0; k < 2 && k < contact.count; ++k)
    if (contact.slot[k].separation <= 0.0) crew.add(&crew.shared().contacts, 1);
  note_depth(s, crew, contact);
}

/// Energy that a contact of the last moment took, now that all velocities after it are known.
GEM_DEVICE inline void work_of_contact(const DeviceScene& s, const PairCell& pair, const Contact& contact,
                                       std::int32_t stamp) {
  const BodyAfter a = s.after[pair.a], b = s.after[pair.b];
  PairBodies after;
  after.velocity_a = a.velocity;
  after.velocity_b = b.velocity;
  after.spin_a = a.spin;
  after.spin_b = b.spin;
  RowWork& work = s.work[pair.row_b];
  const std::int32_t count = contact.count;
  for (int j = 0; j < 2; ++j) {
    if (j >= count) break;
    const ContactSlot& slot = contact.slot[j];
    SlotWork took;
    if (acted(slot)) took = slot_work(contact, slot, relative_velocity(after, slot));
    work.slot[j].impact = took.impact;
    work.slot[j].elastic = took.elastic;
    work.slot[j].friction = took.friction;
  }
  work.count = count;
  s.stamp[pair.row_b].work = stamp;
}

/// The same of all contacts of the block. The last threads begin: the first have more to do in what goes on beside it.
template <class Crew>
GEM_DEVICE inline void work_of_last_moment(const DeviceScene& s, Crew& crew, const Desk& desk, std::int32_t stamp) {
  for (std::int32_t k = crew.threads() - 1 - crew.thread(); k < crew.shared().touched; k += crew.threads()) {
    const std::int32_t p = s.touched[desk.pairs.begin + k];
    work_of_contact(s, desk.pair[p], s.contact[p], stamp);
  }
}

/// The pairs phase of one moment, a desk full of pairs at a time.
template <Resolution resolution, class Crew>
GEM_DEVICE inline void pairs_phase(const DeviceScene& s, Crew& crew, const Desk& desk, std::int32_t moment) {
  BlockCell& shared = crew.shared();
  const std::int32_t groups = crew.threads() / Crew::Lanes::size;
  work_of_last_moment(s, crew, desk, moment);
  for (std::int32_t first = desk.pairs.begin; first < desk.pairs.end; first += crew.threads()) {
    const std::int32_t p = first + crew.thread();
    const auto next_look = [&]() -> LookItem& { return desk.look[crew.add(&shared.looks, 1)]; };
    if (p < desk.pairs.end) choose_look(s, desk.pair[p], p, next_look);
    crew.block_barrier();
    const std::int32_t looks = shared.looks;
    const auto next_touch = [&](int points) {
      return TouchPlace{desk.pairs.begin + crew.add(&shared.touches, 1), crew.add(&shared.points, points)};
    };
    look_at_items(s, crew, desk.pair, desk.outlines, desk.look, crew.thread() / Crew::Lanes::size, looks, groups,
                  next_touch);
    crew.block_barrier();
    if (crew.thread() == 0) shared.looks = 0;
    if (first + crew.threads() < desk.pairs.end) crew.block_barrier();
  }
  // a block without pairs has not met since its threads read the last number: it stays the same
  if (crew.thread() == 0 && shared.touched != shared.touches) shared.touched = shared.touches;
  if constexpr (resolution == Resolution::coupled) {
    if (crew.thread() == 0 && shared.points > 0) shared.first_point = crew.add(&s.counters->points, shared.points);
    crew.block_barrier();
  }
  for (std::int32_t k = crew.thread(); k < shared.touches; k += crew.threads()) {
    const Touch& touch = s.touch[desk.pairs.begin + k];
    s.touched[desk.pairs.begin + k] = touch.pair;
    if constexpr (resolution == Resolution::coupled)
      open_touch(s, crew, desk.pair[touch.pair], touch, moment);
    else
      resolve(s, crew, desk.pair[touch.pair], touch, moment);
  }
}

}  // namespace gem
