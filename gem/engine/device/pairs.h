// The pair stages of a time step: choose the near pairs that may touch, find where they touch, resolve their events.
//
//   1. each thread: can one pair touch, going by its last narrow phase?
//   2. each group of lanes: turn the two outlines, follow the pair's axes, find the contact
//   3. each thread: the event of one touching pair, written to the rows of its bodies
#pragma once

#include "gem/engine/device/forces.h"
#include "gem/engine/device/narrow_phase.h"
#include "gem/engine/solver/device/device_points.h"

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

/// Writes what a resolved contact does to the rows of its bodies. Only floes read them: the platform reads the contact
/// itself, fixed bodies do not move.
GEM_DEVICE inline void write_rows(const DeviceScene& s, const PairCell& pair, const PairBodies& bodies,
                                  const Contact& contact, std::int32_t step) {
  RowEntry &to_a = s.entry[pair.row_a], &to_b = s.entry[pair.row_b];
  std::int32_t touched = 0;
  for (int k = 0; k < 2; ++k) {
    if (k >= contact.count) break;
    const ContactSlot& slot = contact.slot[k];
    const Vec2 impulse = world_impulse(contact, slot.impulse);
    const VelocityChange change = velocity_change(bodies.mass_a, slot.arm_a, impulse);
    to_a.velocity[k] = -change.velocity;
    to_a.spin[k] = -change.spin;
    const VelocityChange step_b = velocity_change(bodies.mass_b, slot.arm_b, impulse);
    to_b.velocity[k] = step_b.velocity;
    to_b.spin[k] = step_b.spin;
    touched |= acted(slot) ? 1 : 0;
  }
  to_a.count = to_b.count = contact.count;
  to_a.acted = to_b.acted = touched;
  s.stamp[pair.row_a].entry = step;
  s.stamp[pair.row_b].entry = step;
}

/// Copies what the books and the platform need of a contact.
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

/// Copies what a coupled time step needs of a contact from the iterations on.
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

/// Stores the data of a platform event before the bodies move.
GEM_DEVICE inline void keep_event(const DeviceScene& s, std::int32_t place, const BodyCell& a, const BodyCell& b,
                                  const Contact& contact, std::int32_t step) {
  s.row_event[place] = {step, contact, b.position, a.position, a.rotation, b.rotation};
  s.row_event_step[place] = step;
}

template <class Group>
GEM_DEVICE inline void note_depth(const DeviceScene& s, Group& group, const Contact& contact) {
  if (!s.wants_samples) return;
  const double size = std::sqrt(smaller(s.area[contact.a], s.area[contact.b]));
  for (int k = 0; k < 2 && k < contact.count; ++k) {
    const double depth = -contact.slot[k].separation;
    if (!(depth > 0.0)) continue;
    const std::uint64_t of_depth = strict::bits_of(depth), of_share = strict::bits_of(depth / size);
    group.highest(&group.shared().overlap, of_depth);
    group.highest(&group.shared().share, of_share);
    group.add(&s.overlap_count[OverlapCount::class_of_bits(of_depth)], 1);
    group.add(&s.overlap_count[OverlapCount::classes + OverlapCount::class_of_bits(of_share)], 1);
  }
}

/// Coupled: prepares a touching pair for the iterations.
template <class Group>
GEM_DEVICE inline void open_touching(const DeviceScene& s, Group& group, const PairCell& pair,
                                     const TouchingPair& touching, std::int32_t step) {
  const BodyCell &a = s.body[pair.a], &b = s.body[pair.b];
  Contact contact;
  open_contact(contact, pair.a, pair.b, touching.geometry, b.position - a.position);
  const bool on_platform = s.constants.is_platform(pair.a);
  Vec2 shift;
  if (on_platform) shift = s.platform->mid_position - a.position;
  prepare(s.constants, pair_bodies(a, b), shift, contact);
  keep_open_contact(s.contact[touching.pair], contact);
  open_points(s, group, pair, touching, step);
  if (s.wants_events && on_platform && b.kind == BodyKind::floe)
    keep_event(s, pair.row_a - s.platform->row_begin, a, b, contact, step);
  note_depth(s, group, contact);
}

/// Resolves the event of one touching pair.
template <class Group>
GEM_DEVICE inline void resolve(const DeviceScene& s, Group& group, const PairCell& pair, const TouchingPair& touching,
                               std::int32_t step) {
  const BodyCell &a = s.body[pair.a], &b = s.body[pair.b];
  Contact contact;
  open_contact(contact, pair.a, pair.b, touching.geometry, b.position - a.position);
  const PairBodies bodies = pair_bodies(a, b);
  const bool on_platform = s.constants.is_platform(pair.a);
  Vec2 shift;
  if (on_platform) shift = s.platform->mid_position - a.position;
  prepare(s.constants, bodies, shift, contact);
  resolve_alone(s.constants, bodies.mass_a, bodies.mass_b, contact);
  keep_contact(s.contact[touching.pair], contact);
  write_rows(s, pair, bodies, contact, step);
  if (s.wants_events && on_platform && b.kind == BodyKind::floe && presses(contact))
    keep_event(s, pair.row_a - s.platform->row_begin, a, b, contact, step);
  for (int k = 0; k < 2 && k < contact.count; ++k)
    if (contact.slot[k].separation <= 0.0) group.add(&group.shared().contacts, 1);
  note_depth(s, group, contact);
}

/// Computes the energy that a contact of the last time step took, from the velocities after all contacts.
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

/// work_of_contact() for all contacts of the block. The last threads take the first contacts: the first threads have
/// more to do in the code that runs next.
template <class Group>
GEM_DEVICE inline void work_of_last_step(const DeviceScene& s, Group& group, const Workspace& workspace,
                                         std::int32_t stamp) {
  for (std::int32_t k = group.threads() - 1 - group.thread(); k < group.shared().touched; k += group.threads()) {
    const std::int32_t p = s.touched[workspace.pairs.begin + k];
    work_of_contact(s, workspace.pair[p], s.contact[p], stamp);
  }
}

/// The pair stages of one time step. A pass takes one pair for each thread of the block.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void pair_stages(const DeviceScene& s, Group& group, const Workspace& workspace, std::int32_t step) {
  BlockCell& shared = group.shared();
  const std::int32_t lane_groups = group.threads() / Group::Lanes::size;
  work_of_last_step(s, group, workspace, step);
  if (records_forces(s, false)) note_forces(s, group, workspace, std::int64_t{step} - 1);
  for (std::int32_t first = workspace.pairs.begin; first < workspace.pairs.end; first += group.threads()) {
    const std::int32_t p = first + group.thread();
    const auto next_candidate = [&]() -> CandidatePair& {
      return workspace.candidate[group.add(&shared.candidates, 1)];
    };
    if (p < workspace.pairs.end) choose_candidate(s, workspace.pair[p], p, next_candidate);
    group.block_barrier();
    const std::int32_t candidates = shared.candidates;
    const auto next_touching = [&](int points) {
      return TouchingPlace{workspace.pairs.begin + group.add(&shared.touching_count, 1),
                           group.add(&shared.points, points)};
    };
    narrow_phase_of(s, group, workspace.pair, workspace.outlines, workspace.candidate,
                    group.thread() / Group::Lanes::size, candidates, lane_groups, next_touching);
    group.block_barrier();
    if (group.thread() == 0) shared.candidates = 0;
    if (first + group.threads() < workspace.pairs.end) group.block_barrier();
  }
  // a block without pairs has passed no barrier since its threads read `touched`: write only a change
  if (group.thread() == 0 && shared.touched != shared.touching_count) shared.touched = shared.touching_count;
  if constexpr (solver == ContactSolver::coupled) {
    if (group.thread() == 0 && shared.points > 0) shared.first_point = group.add(&s.counters->points, shared.points);
    group.block_barrier();
  }
  for (std::int32_t k = group.thread(); k < shared.touching_count; k += group.threads()) {
    const TouchingPair& touching = s.touching[workspace.pairs.begin + k];
    s.touched[workspace.pairs.begin + k] = touching.pair;
    if constexpr (solver == ContactSolver::coupled)
      open_touching(s, group, workspace.pair[touching.pair], touching, step);
    else
      resolve(s, group, workspace.pair[touching.pair], touching, step);
  }
}

}  // namespace gem
