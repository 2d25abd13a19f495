// Stages for one pair: contact geometry, masses and arms, the event, its impulses.
//
// | stage            | reads                              | writes                                       |
// | find_contact     | positions, outlines of a and b     | the contact's geometry                       |
// | prepare_contact  | velocities, masses, platform shift | arms, velocities before, targets             |
// | resolve_alone    | the contact                        | its impulses                                 |
// | apply_impulses   | the contact's impulses             | velocities of a and b                        |
// | point_of_contact | the contact, masses                | nothing: returns the point for the iteration |
#pragma once

#include "gem/engine/solver/coupled_point.h"
#include "gem/engine/step/body_repair.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/field_state.h"
#include "gem/engine/step/motion_bound.h"
#include "gem/engine/step/pair_event.h"
#include "gem/events/events.h"

namespace gem {

inline CollisionMass collision_mass(const Bodies& b, std::int32_t i) {
  return {b.inverse_mass[i], b.inverse_inertia[i]};
}

/// Prefetches what the narrow phase reads of a body. The bodies of listed pairs are scattered in memory if floes are
/// not numbered along the channel.
inline void prefetch_search(const FieldState& f, std::int32_t i) {
  __builtin_prefetch(&f.bodies.position[i]);
  __builtin_prefetch(&f.bodies.radius[i]);
  __builtin_prefetch(&f.turn_travel[i]);
  __builtin_prefetch(&f.bodies.vertex_begin[i]);
}

/// Prefetches the outline of a body.
inline void prefetch_outline(const FieldState& f, std::int32_t i) {
  const std::int32_t first = f.bodies.vertex_begin[i];
  constexpr std::int32_t line = 4;  // corners per cache line
  __builtin_prefetch(&f.corner[first]);
  __builtin_prefetch(&f.corner[first] + line);
  __builtin_prefetch(&f.normal[first]);
  __builtin_prefetch(&f.normal[first] + line);
}

/// Prefetches what the events read of a body.
inline void prefetch_events(const FieldState& f, std::int32_t i) {
  __builtin_prefetch(&f.bodies.velocity[i]);
  __builtin_prefetch(&f.bodies.spin[i]);
  __builtin_prefetch(&f.bodies.inverse_mass[i]);
  __builtin_prefetch(&f.bodies.inverse_inertia[i]);
  __builtin_prefetch(&f.bodies.thickness[i]);
  __builtin_prefetch(&f.crushing[i]);
}

/// The properties of both bodies that the events of a pair read.
inline PairBodies pair_bodies(const Bodies& b, std::int32_t i, std::int32_t j) {
  return {collision_mass(b, i),
          collision_mass(b, j),
          b.velocity[i],
          b.velocity[j],
          b.spin[i],
          b.spin[j],
          crushed_thickness(b.kind[i], b.thickness[i], b.thickness[j])};
}

/// Geometry of a piece of the platform and another body, along the axes of find_contact().
ContactGeometry piece_contact(const FieldState& f, std::int32_t a, std::int32_t b, const SeparatingAxes& axes);

/// Narrow phase of one pair. Returns whether the pair touches; for `coupled`, whether it is closer than the contact
/// margin. `axes` are the separating axes of an earlier test of the pair; the bodies have moved by at most `moved` [m]
/// since, and the axes are updated. Fills the geometry of `contact` and sets all members that later stages add to to
/// zero.
inline bool find_contact(const FieldState& f, std::int32_t a, std::int32_t b, SeparatingAxes& axes, double moved,
                         Contact& contact) {
  const double limit = f.constants.contact_margin;
  const Outline outline_a = f.outline(a), outline_b = f.outline(b);
  const Vec2 offset = f.bodies.position[b] - f.bodies.position[a];
  follow_axes(axes, outline_a, outline_b, offset, moved + motion_rounding, limit);
  if (!(axes.first.distance < limit)) return false;
  if (f.constants.solver == ContactSolver::compliant) {
    const Separation& axis = axes.first;
    open_contact(contact, a, b, {axis.edge_of_b ? -outline_b.normal[axis.edge] : outline_a.normal[axis.edge], 0, {}},
                 offset);
    return true;
  }
  const ContactGeometry geometry = !f.piece_corner.empty() && f.constants.is_platform(a) ? piece_contact(f, a, b, axes)
                                   : f.constants.manifold == Manifold::chord_middle
                                       ? chord_contact(outline_a, outline_b, offset, axes.first)
                                       : face_contact(outline_a, outline_b, offset, axes.first, limit);
  if (geometry.count == 0) return false;
  open_contact(contact, a, b, geometry, offset);
  return true;
}

/// Velocity of B relative to A at a contact point [m/s].
inline Vec2 relative_velocity(const Bodies& b, const Contact& contact, const ContactSlot& slot) {
  return b.velocity[contact.b] + cross(b.spin[contact.b], slot.arm_b) - b.velocity[contact.a] -
         cross(b.spin[contact.a], slot.arm_a);
}

/// Thickness of the ice that crushes in a contact: the thinner of both floes [m].
inline double crushed_thickness(const FieldState& f, const Contact& contact) {
  return crushed_thickness(f.bodies.kind[contact.a], f.bodies.thickness[contact.a], f.bodies.thickness[contact.b]);
}

/// Sets friction, arms and relative velocities at the time of the events. In a coupled time step the target lets a gap
/// close, but not more.
inline void prepare_contact(const FieldState& f, Contact& contact) {
  const Bodies& b = f.bodies;
  const std::int32_t i = contact.a, j = contact.b;
  Vec2 shift;
  if (f.constants.is_platform(i)) shift = b.position[0] - f.platform_position;
  prepare(f.constants, pair_bodies(b, i, j), shift, contact);
}

/// A contact point as the coupled iterations see it. `points_of_a`, `points_of_b`: number of points among which the
/// mass of each body is split; `last`: what the point has from the last time step.
inline PointGeometry<double> point_of_contact(const FieldState& f, const Contact& contact, const ContactSlot& slot,
                                              std::int32_t points_of_a, std::int32_t points_of_b,
                                              const PointMemory& last) {
  const Bodies& b = f.bodies;
  const std::int32_t i = contact.a, j = contact.b;
  const bool ice = b.kind[i] == BodyKind::floe || b.kind[j] == BodyKind::floe;
  const CrushingPowers &of_a = f.crushing[i], &of_b = f.crushing[j];
  const double cap =
      largest_impulse(f.constants.events, ice, crushed_thickness(b.kind[i], of_a.thickness, of_b.thickness),
                      smaller(of_a.width, of_b.width), contact.count);
  return point_geometry(f.constants, contact, slot, shared_mass(collision_mass(b, i), points_of_a),
                        shared_mass(collision_mass(b, j), points_of_b), last, cap);
}

inline void resolve_alone(const FieldState& f, Contact& contact) {
  resolve_alone(f.constants, collision_mass(f.bodies, contact.a), collision_mass(f.bodies, contact.b), contact);
}

/// Applies the position repair of body i, limited by within_reach().
inline void apply_repair(FieldState& f, std::size_t i, const BodyRepair& repair) {
  const BodyRepair done = within_reach(repair, f.bodies.radius[i], f.constants.repair_reach);
  f.repair_shift[i] = done.shift;
  f.repair_turn[i] = done.turn;
}

/// Applies an impulse to B and the opposite impulse to A; `a` is the owner of A.
inline void apply_impulse(Bodies& b, std::int32_t a, const Contact& contact, const ContactSlot& slot,
                          ContactImpulse p) {
  const Vec2 impulse = p.normal * contact.normal + p.tangential * turned_left(contact.normal);
  b.velocity[contact.b] += b.inverse_mass[contact.b] * impulse;
  b.spin[contact.b] += b.inverse_inertia[contact.b] * cross(slot.arm_b, impulse);
  b.velocity[a] -= b.inverse_mass[a] * impulse;
  b.spin[a] -= b.inverse_inertia[a] * cross(slot.arm_a, impulse);
}

/// Applies all impulses of a contact.
inline void apply_impulses(FieldState& f, const Contact& contact) {
  for (int k = 0; k < contact.count; ++k)
    apply_impulse(f.bodies, f.constants.owner_of(contact.a), contact, contact.slot[k], contact.slot[k].impulse);
}

}  // namespace gem
