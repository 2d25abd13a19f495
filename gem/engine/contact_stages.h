// Stages that act on one pair: find where it touches, see how heavy it feels, resolve its event, enter it in the books.
//
// | stage              | reads                                   | writes                                  |
// | find_contact       | positions, outlines of a and b          | the contact's geometry                  |
// | prepare_contact    | velocities, masses, platform shift      | arms, compliance, velocities before     |
// | resolve_alone      | the contact                             | its impulses                            |
// | resolve_together   | velocities of a and b                   | its impulses, velocities of a and b     |
// | apply_impulses     | the contact's impulses                  | velocities of a and b                   |
// | repair_overlap     | repair shifts of a and b                | its repair, repair shifts of a and b    |
// | book_contact       | velocities after                        | ledger, struck flags                    |
#pragma once

#include "gem/engine/contact.h"
#include "gem/engine/field_state.h"
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
  contact.a = a;
  contact.b = b;
  contact.count = geometry.count;
  contact.normal = geometry.normal;
  contact.width = geometry.width;
  contact.growth = geometry.growth;
  for (int k = 0; k < geometry.count; ++k) {
    contact.slot[k].arm_a = geometry.point[k].position;
    contact.slot[k].arm_b = geometry.point[k].position - offset;
    contact.slot[k].separation = geometry.point[k].separation;
    contact.slot[k].feature = geometry.point[k].feature;
    contact.slot[k].target = 0.0;
    contact.slot[k].impulse = {};
    contact.slot[k].elastic = 0.0;
    contact.slot[k].repair = 0.0;
  }
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
  ice.thickness = f.bodies.thickness[contact.b];
  if (f.bodies.kind[contact.a] == BodyKind::floe && f.bodies.thickness[contact.a] < ice.thickness)
    ice.thickness = f.bodies.thickness[contact.a];
  return ice;
}

/// Velocity and compliance at the instant of the events. `platform_share` > 1 splits the platform's mass among so many
/// contacts: their impulses can then be summed without overshoot.
inline void prepare_contact(const FieldState& f, Contact& contact, double platform_share) {
  const Bodies& b = f.bodies;
  const MomentConstants& c = f.constants;
  CollisionMass mass_a = collision_mass(b, contact.a);
  const CollisionMass mass_b = collision_mass(b, contact.b);
  Vec2 shift;
  if (contact.a == 0) {
    mass_a = {platform_share * mass_a.inverse_mass, platform_share * mass_a.inverse_inertia};
    shift = b.position[0] - f.platform_position;
  }
  contact.friction = contact.a == 0 ? c.friction_structure : c.friction_ice;
  const Vec2 tangent = turned_left(contact.normal);
  for (int k = 0; k < contact.count; ++k) {
    ContactSlot& slot = contact.slot[k];
    slot.arm_a -= shift;
    slot.compliance = contact_compliance(mass_a, slot.arm_a, mass_b, slot.arm_b, contact.normal);
    const Vec2 velocity = relative_velocity(b, contact, slot);
    slot.normal_before = dot(velocity, contact.normal);
    slot.tangential_before = dot(velocity, tangent);
    if (c.resolution == Resolution::coupled) {
      slot.target = slot.separation > 0.0 ? -slot.separation / c.dt : 0.0;
    } else if (c.elastic_stiffness > 0.0 && slot.separation < 0.0) {
      const double asked =
          elastic_separating_speed(c.elastic_stiffness, -slot.separation, 1.0 / slot.compliance.nn, c.dt);
      const double cap = crushing_force(crushing_ice(f, contact), contact.width) * c.dt * slot.compliance.nn;
      slot.target = asked < cap ? asked : cap;
    }
  }
}

/// Impulse of one contact point from the velocity that it would have without its own impulse.
inline ContactImpulse resolve_slot(const MomentConstants& c, const ContactSlot& slot, double friction, double u_n,
                                   double u_t, double target) {
  if (!(friction > 0.0)) return {impact_frictionless(slot.compliance.nn, u_n, target), 0.0};
  if (c.friction_law == FrictionLaw::fixed_direction)
    return impact_fixed_direction(slot.compliance, u_n, u_t, target, friction);
  return impact_one_step(slot.compliance, u_n, u_t, target, friction);
}

/// Response of point k to the impulses of point j of the same pair.
inline Vec2 cross_response(const FieldState& f, const Contact& contact, int k, int j, double platform_share) {
  const ContactImpulse& p = contact.slot[j].impulse;
  const Vec2 impulse = p.normal * contact.normal + p.tangential * turned_left(contact.normal);
  const double share = contact.a == 0 ? platform_share : 1.0;
  const CollisionMass a = collision_mass(f.bodies, contact.a), b = collision_mass(f.bodies, contact.b);
  const ContactSlot& at = contact.slot[k];
  const ContactSlot& from = contact.slot[j];
  return (share * a.inverse_mass + b.inverse_mass) * impulse +
         cross(share * a.inverse_inertia * cross(from.arm_a, impulse), at.arm_a) +
         cross(b.inverse_inertia * cross(from.arm_b, impulse), at.arm_b);
}

/// Resolves a pair's event from the start-of-moment state, whatever its neighbours do. Two points of one pair are one
/// event: they are iterated to their common answer.
inline void resolve_alone(const FieldState& f, Contact& contact) {
  constexpr int sweeps = 24;  // the error of two points falls by 1/25 a sweep for a face (V14)
  const Vec2 tangent = turned_left(contact.normal);
  for (int sweep = 0; sweep < (contact.count == 1 ? 1 : sweeps); ++sweep) {
    for (int k = 0; k < contact.count; ++k) {
      ContactSlot& slot = contact.slot[k];
      Vec2 other;
      if (contact.count == 2) other = cross_response(f, contact, k, 1 - k, 1.0);
      slot.impulse = resolve_slot(f.constants, slot, contact.friction, slot.normal_before + dot(other, contact.normal),
                                  slot.tangential_before + dot(other, tangent), slot.target);
    }
  }
  for (int k = 0; k < contact.count; ++k) {
    ContactSlot& slot = contact.slot[k];
    const double closing = slot.normal_before < 0.0 ? -slot.normal_before : 0.0;
    const double asked = slot.target + closing;
    slot.elastic = asked > 0.0 && slot.target > 0.0 ? slot.impulse.normal * (slot.target / asked) : 0.0;
  }
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

/// Enters a resolved contact in the books and marks its bodies as struck. Velocities must be those after the events.
inline void book_contact(FieldState& f, const Contact& contact, Ledger& ledger) {
  const Vec2 tangent = turned_left(contact.normal);
  // what a fixed body gives: A acts on B with +impulse, B on A with -impulse
  const bool fixed_b = f.bodies.kind[contact.b] == BodyKind::fixed;
  const bool on_fixed = fixed_b || f.bodies.kind[contact.a] == BodyKind::fixed;
  const double given = fixed_b ? -1.0 : 1.0;
  const bool on_locked = contact.a == 0 && f.bodies.inverse_inertia[0] == 0.0;
  for (int k = 0; k < contact.count; ++k) {
    const ContactSlot& slot = contact.slot[k];
    const ContactImpulse& p = slot.impulse;
    if (p.normal == 0.0 && p.tangential == 0.0 && slot.repair == 0.0) continue;
    f.struck[contact.a] = f.struck[contact.b] = 1;
    const Vec2 velocity = relative_velocity(f.bodies, contact, slot);
    const double after_n = dot(velocity, contact.normal), after_t = dot(velocity, tangent);
    ledger[Channel::impact].energy += impulse_work(p.normal - slot.elastic, slot.normal_before, after_n);
    ledger[Channel::elastic].energy += impulse_work(slot.elastic, slot.normal_before, after_n);
    ledger[Channel::friction].energy += impulse_work(p.tangential, slot.tangential_before, after_t);
    if (on_fixed) {
      const Vec2 point = f.bodies.position[contact.b] + slot.arm_b;
      auto enter = [&](Channel channel, Vec2 impulse) {
        ledger[channel].momentum += given * impulse;
        ledger[channel].angular_momentum += given * cross(point, impulse);
      };
      enter(Channel::impact, (p.normal - slot.elastic) * contact.normal);
      enter(Channel::elastic, slot.elastic * contact.normal);
      enter(Channel::friction, p.tangential * tangent);
    }
    // a locked platform hands the twist on to whatever locks it
    if (on_locked)
      ledger.mooring_force.angular_momentum += cross(slot.arm_a, p.normal * contact.normal + p.tangential * tangent);
  }
}

}  // namespace gem
