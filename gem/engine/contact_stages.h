// Stages that act on one pair: find where it touches, see how heavy it feels, resolve its event, enter it in the books.
//
// | stage              | reads                                   | writes                                  |
// | find_contact       | positions, outlines of a and b          | the contact's geometry                  |
// | prepare_contact    | velocities, masses, platform shift      | arms, compliance, velocities before     |
// | resolve_alone      | the contact                             | its impulses                            |
// | resolve_together   | velocities of a and b                   | its impulses, velocities of a and b     |
// | apply_impulses     | the contact's impulses                  | velocities of a and b                   |
// | repair_overlap     | repair shifts of a and b                | its repair, repair shifts of a and b    |
// | book_contact       | velocities after                        | books of B, struck flags                    |
#pragma once

#include "gem/engine/contact.h"
#include "gem/engine/field_state.h"
#include "gem/engine/pair_event.h"
#include "gem/events/events.h"

namespace gem {

/// Slack for rounding where a bound on motion spares a look [m].
constexpr double rounding = 1e-9;

/// Looks whether a pair touches (or, coupled, is closer than the contact margin). `axes` are those of an earlier look,
/// since which the bodies moved by at most `moved`; they are brought up to date. Everything of the contact that later
/// stages only add to is set to zero.
inline bool find_contact(const FieldState& f, std::int32_t a, std::int32_t b, SeparatingAxes& axes, double moved,
                         Contact& contact) {
  const double limit = f.constants.contact_margin;
  const Outline outline_a = f.outline(a), outline_b = f.outline(b);
  const Vec2 offset = f.bodies.position[b] - f.bodies.position[a];
  follow_axes(axes, outline_a, outline_b, offset, moved + rounding, limit);
  if (!(axes.first.distance < limit)) return false;
  const ContactGeometry geometry = f.constants.manifold == Manifold::chord_middle
                                       ? chord_contact(outline_a, outline_b, offset, axes.first)
                                       : face_contact(outline_a, outline_b, offset, axes.first, limit);
  if (geometry.count == 0) return false;
  open_contact(contact, a, b, geometry, offset);
  return true;
}

inline CollisionMass collision_mass(const Bodies& b, std::int32_t i) {
  return {b.inverse_mass[i], b.inverse_inertia[i]};
}

/// Velocity of B against A at a contact point [m/s].
inline Vec2 relative_velocity(const Bodies& b, const Contact& contact, const ContactSlot& slot) {
  return b.velocity[contact.b] + cross(b.spin[contact.b], slot.arm_b) - b.velocity[contact.a] -
         cross(b.spin[contact.a], slot.arm_a);
}

/// Crushing properties of a contact: the thinner ice crushes.
inline CrushingIce crushing_ice(const FieldState& f, const Contact& contact) {
  CrushingIce ice = f.constants.ice;
  ice.thickness =
      crushed_thickness(f.bodies.kind[contact.a], f.bodies.thickness[contact.a], f.bodies.thickness[contact.b]);
  return ice;
}

/// Velocity and compliance at the instant of the events. `platform_share` > 1 splits the platform's mass among so many
/// contacts: their impulses can then be summed without overshoot.
inline void prepare_contact(const FieldState& f, Contact& contact, double platform_share) {
  const Bodies& b = f.bodies;
  const std::int32_t i = contact.a, j = contact.b;
  PairBodies pair{collision_mass(b, i),
                  collision_mass(b, j),
                  b.velocity[i],
                  b.velocity[j],
                  b.spin[i],
                  b.spin[j],
                  crushed_thickness(b.kind[i], b.thickness[i], b.thickness[j])};
  Vec2 shift;
  if (i == 0) {
    pair.mass_a = {platform_share * pair.mass_a.inverse_mass, platform_share * pair.mass_a.inverse_inertia};
    shift = b.position[0] - f.platform_position;
  }
  prepare(f.constants, pair, shift, contact);
}

inline void resolve_alone(const FieldState& f, Contact& contact) {
  resolve_alone(f.constants, collision_mass(f.bodies, contact.a), collision_mass(f.bodies, contact.b), contact);
}

/// Adds an impulse on B, and its opposite on A unless A is the platform of a coupled moment (summed afterwards).
inline void apply_impulse(Bodies& b, const Contact& contact, const ContactSlot& slot, ContactImpulse p, bool also_a) {
  const Vec2 impulse = p.normal * contact.normal + p.tangential * turned_left(contact.normal);
  b.velocity[contact.b] += b.inverse_mass[contact.b] * impulse;
  b.spin[contact.b] += b.inverse_inertia[contact.b] * cross(slot.arm_b, impulse);
  if (!also_a) return;
  b.velocity[contact.a] -= b.inverse_mass[contact.a] * impulse;
  b.spin[contact.a] -= b.inverse_inertia[contact.a] * cross(slot.arm_a, impulse);
}

/// Whether a coupled sweep may write to A: the platform is summed after the sweep, fixed bodies never move.
inline bool sweeps_write_a(const Bodies& b, const Contact& contact) {
  return contact.a != 0 && b.inverse_mass[contact.a] > 0.0;
}

/// All impulses of a contact at once.
inline void apply_impulses(Bodies& b, const Contact& contact, bool also_a) {
  for (int k = 0; k < contact.count; ++k) apply_impulse(b, contact, contact.slot[k], contact.slot[k].impulse, also_a);
}

/// A speed change below this share of the residual does not make the neighbours of a body look again.
constexpr double quiet_share = 0.1;

/// Whether a contact has anything to answer to: one of its bodies changed in this sweep or the one before.
inline bool wants_visit(const FieldState& f, const Contact& contact, std::int32_t sweep) {
  return f.changed[contact.a] >= sweep - 1 || f.changed[contact.b] >= sweep - 1;
}

/// One visit of a coupled sweep: each point gets the impulse that its law asks for, given all other impulses so far.
/// Returns the largest change of speed [m/s] and marks the bodies as changed.
inline double resolve_together(FieldState& f, Contact& contact, std::int32_t sweep) {
  const Vec2 tangent = turned_left(contact.normal);
  const bool also_a = sweeps_write_a(f.bodies, contact);
  double change = 0.0;
  for (int k = 0; k < contact.count; ++k) {
    ContactSlot& slot = contact.slot[k];
    const Vec2 velocity = relative_velocity(f.bodies, contact, slot);
    const ContactImpulse old = slot.impulse;
    const double u_n =
        dot(velocity, contact.normal) - slot.compliance.nn * old.normal - slot.compliance.nt * old.tangential;
    const double u_t = dot(velocity, tangent) - slot.compliance.nt * old.normal - slot.compliance.tt * old.tangential;
    slot.impulse = resolve_slot(f.constants, slot, contact.friction, u_n, u_t, slot.target);
    const ContactImpulse step{slot.impulse.normal - old.normal, slot.impulse.tangential - old.tangential};
    if (step.normal == 0.0 && step.tangential == 0.0) continue;
    apply_impulse(f.bodies, contact, slot, step, also_a);
    const double change_n = std::fabs(step.normal) * slot.compliance.nn;
    const double change_t = std::fabs(step.tangential) * slot.compliance.tt;
    if (change_n > change) change = change_n;
    if (change_t > change) change = change_t;
  }
  if (change > quiet_share * f.constants.residual_speed) {
    f.changed[contact.b] = sweep;
    if (also_a) f.changed[contact.a] = sweep;
  }
  return change;
}

/// Gives the platform its velocity after a sweep and marks it as changed if that is worth a look.
inline void place_platform(FieldState& f, Vec2 velocity, double spin, std::int32_t sweep) {
  const double change =
      length(velocity - f.bodies.velocity[0]) + f.bodies.radius[0] * std::fabs(spin - f.bodies.spin[0]);
  f.bodies.velocity[0] = velocity;
  f.bodies.spin[0] = spin;
  if (change > quiet_share * f.constants.residual_speed) f.changed[0] = sweep;
}

/// One visit of a position-repair sweep: pushes apart by a share of the overlap, without touching velocities.
inline void repair_overlap(FieldState& f, Contact& contact) {
  for (int k = 0; k < contact.count; ++k) {
    ContactSlot& slot = contact.slot[k];
    if (!(slot.separation < 0.0)) continue;
    const Vec2 shift = f.repair_shift[contact.b] + cross(f.repair_turn[contact.b], slot.arm_b) -
                       f.repair_shift[contact.a] - cross(f.repair_turn[contact.a], slot.arm_a);
    const double asked = -f.constants.repair_share * slot.separation;
    const double repair = slot.repair + (asked - dot(shift, contact.normal)) / slot.compliance.nn;
    const double step = (repair > 0.0 ? repair : 0.0) - slot.repair;
    if (step == 0.0) continue;
    slot.repair += step;
    const Vec2 impulse = step * contact.normal;
    const CollisionMass mass_b = collision_mass(f.bodies, contact.b);
    f.repair_shift[contact.b] += mass_b.inverse_mass * impulse;
    f.repair_turn[contact.b] += mass_b.inverse_inertia * cross(slot.arm_b, impulse);
    if (!sweeps_write_a(f.bodies, contact)) continue;
    const CollisionMass mass_a = collision_mass(f.bodies, contact.a);
    f.repair_shift[contact.a] -= mass_a.inverse_mass * impulse;
    f.repair_turn[contact.a] -= mass_a.inverse_inertia * cross(slot.arm_a, impulse);
  }
}

/// Enters a resolved contact in the books of its body B and marks its bodies as struck. Velocities must be those after
/// the events.
inline void book_contact(FieldState& f, const Contact& contact) {
  const bool fixed_b = f.bodies.kind[contact.b] == BodyKind::fixed;
  const bool on_fixed = fixed_b || f.bodies.kind[contact.a] == BodyKind::fixed;
  const bool on_locked = contact.a == 0 && f.bodies.inverse_inertia[0] == 0.0;
  const ContactBooks books{f.book(Channel::impact, contact.b), f.book(Channel::elastic, contact.b),
                           f.book(Channel::friction, contact.b)};
  for (int k = 0; k < contact.count; ++k) {
    const ContactSlot& slot = contact.slot[k];
    if (!acted(slot)) continue;
    f.struck[contact.a] = f.struck[contact.b] = 1;
    const SlotWork work = slot_work(contact, slot, relative_velocity(f.bodies, contact, slot));
    books.impact.energy += work.impact;
    books.elastic.energy += work.elastic;
    books.friction.energy += work.friction;
    if (on_fixed) book_fixed(books, contact, slot, f.bodies.position[contact.b], fixed_b);
    // a locked platform hands the twist on to whatever locks it
    if (on_locked) f.mooring_force.angular_momentum += cross(slot.arm_a, world_impulse(contact, slot.impulse));
  }
}

}  // namespace gem
