// Stages that act on one pair: find where it touches, see how heavy it feels, resolve its event, enter it in the books.
//
// | stage              | reads                                   | writes                                  |
// | find_contact       | positions, outlines of a and b          | the contact's geometry                  |
// | prepare_contact    | velocities, platform shift              | arms, velocities before                 |
// | prepare_alone      | the same and masses                     | the same, compliance, elastic stress    |
// | resolve_alone      | the contact                             | its impulses                            |
// | apply_impulses     | the contact's impulses                  | velocities of a and b                   |
// | point_geometry     | the contact, masses                     | nothing: returns what iterations need   |
// | book_contact       | velocities after                        | ledger, struck flags                    |
#pragma once

#include "gem/engine/contact.h"
#include "gem/engine/coupled_point.h"
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

/// Friction, arms and relative velocity at the instant of the events; a coupled moment lets gaps close and no more.
inline void prepare_contact(const FieldState& f, Contact& contact) {
  const Bodies& b = f.bodies;
  Vec2 shift;
  if (contact.a == 0) shift = b.position[0] - f.platform_position;
  const bool coupled = f.constants.resolution == Resolution::coupled;
  contact.friction = contact.a == 0 ? f.constants.friction_structure : f.constants.friction_ice;
  const Vec2 tangent = turned_left(contact.normal);
  for (int k = 0; k < contact.count; ++k) {
    ContactSlot& slot = contact.slot[k];
    slot.arm_a -= shift;
    const Vec2 velocity = relative_velocity(b, contact, slot);
    slot.normal_before = dot(velocity, contact.normal);
    slot.tangential_before = dot(velocity, tangent);
    if (coupled && slot.separation > 0.0) slot.target = -slot.separation / f.constants.dt;
  }
}

/// Compliance of a contact's points and the elastic stress that they ask for: `independent` only.
inline void prepare_alone(const FieldState& f, Contact& contact) {
  const MomentConstants& c = f.constants;
  prepare_contact(f, contact);
  const CollisionMass mass_a = collision_mass(f.bodies, contact.a), mass_b = collision_mass(f.bodies, contact.b);
  for (int k = 0; k < contact.count; ++k) {
    ContactSlot& slot = contact.slot[k];
    slot.compliance = contact_compliance(mass_a, slot.arm_a, mass_b, slot.arm_b, contact.normal);
    if (!(c.elastic_stiffness > 0.0 && slot.separation < 0.0)) continue;
    const double asked =
        elastic_separating_speed(c.elastic_stiffness, -slot.separation, 1.0 / slot.compliance.nn, c.dt);
    const double cap = crushing_force(crushing_ice(f, contact), contact.width) * c.dt * slot.compliance.nn;
    slot.target = asked < cap ? asked : cap;
  }
}

/// Largest impulse that one point of a contact can carry in a moment: it crushes the smaller body across its whole size
/// [N s]. The power of the law is only worked out for a point that carried `last_impulse` of its order a moment ago; a
/// bound from below does for all others.
inline double impulse_cap(const FieldState& f, const Contact& contact, double last_impulse) {
  constexpr double none = 1e300;
  const bool ice = f.bodies.kind[contact.a] == BodyKind::floe || f.bodies.kind[contact.b] == BodyKind::floe;
  if (!ice || !f.constants.crushing_limit) return none;
  const CrushingIce crushing = crushing_ice(f, contact);
  const double area_a = f.bodies.area[contact.a], area_b = f.bodies.area[contact.b];
  const double width = std::sqrt(area_a < area_b ? area_a : area_b);
  const double share = f.constants.dt / contact.count;
  const double least = share * crushing_force_at_least(crushing, width);
  return last_impulse < 0.5 * least ? least : share * crushing_force(crushing, width);
}

/// A contact point as the iterations of a coupled moment see it, with the mass of each body shared out among its
/// points.
inline PointGeometry<double> point_geometry(const FieldState& f, const Contact& contact, const ContactSlot& slot,
                                            std::int32_t points_of_a, std::int32_t points_of_b, double last_impulse) {
  const MomentConstants& c = f.constants;
  const Vec2 normal = contact.normal, tangent = turned_left(normal);
  PointGeometry<double> g{};
  g.normal_x = normal.x;
  g.normal_y = normal.y;
  g.lever_a_n = cross(slot.arm_a, normal);
  g.lever_a_t = cross(slot.arm_a, tangent);
  g.lever_b_n = cross(slot.arm_b, normal);
  g.lever_b_t = cross(slot.arm_b, tangent);
  const double share_a = points_of_a, share_b = points_of_b;
  const double mass = share_a * f.bodies.inverse_mass[contact.a] + share_b * f.bodies.inverse_mass[contact.b];
  const double turn_a = share_a * f.bodies.inverse_inertia[contact.a];
  const double turn_b = share_b * f.bodies.inverse_inertia[contact.b];
  enter_compliance(g, mass, turn_a, turn_b);
  g.friction = contact.friction;
  if (c.friction_law == FrictionLaw::fixed_direction) {
    g.friction = slot.tangential_before > 0.0   ? -contact.friction
                 : slot.tangential_before < 0.0 ? contact.friction
                                                : 0.0;
    const double sliding = g.nn + g.friction * g.nt;
    if (sliding > 0.0)
      g.nn = sliding;
    else
      g.friction = 0.0;
  }
  g.inverse_nn = 1.0 / g.nn;
  g.inverse_tt = 1.0 / g.tt;
  g.target = slot.target;
  g.cap = impulse_cap(f, contact, last_impulse);
  if (slot.separation < 0.0) g.repair_target = smaller(-c.repair_share * slot.separation, c.repair_speed * c.dt);
  return g;
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
inline Vec2 cross_response(const FieldState& f, const Contact& contact, int k, int j) {
  const ContactImpulse& p = contact.slot[j].impulse;
  const Vec2 impulse = p.normal * contact.normal + p.tangential * turned_left(contact.normal);
  const CollisionMass a = collision_mass(f.bodies, contact.a), b = collision_mass(f.bodies, contact.b);
  const ContactSlot& at = contact.slot[k];
  const ContactSlot& from = contact.slot[j];
  return (a.inverse_mass + b.inverse_mass) * impulse + cross(a.inverse_inertia * cross(from.arm_a, impulse), at.arm_a) +
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
      if (contact.count == 2) other = cross_response(f, contact, k, 1 - k);
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

/// Adds an impulse on B, and its opposite on A.
inline void apply_impulse(Bodies& b, const Contact& contact, const ContactSlot& slot, ContactImpulse p) {
  const Vec2 impulse = p.normal * contact.normal + p.tangential * turned_left(contact.normal);
  b.velocity[contact.b] += b.inverse_mass[contact.b] * impulse;
  b.spin[contact.b] += b.inverse_inertia[contact.b] * cross(slot.arm_b, impulse);
  b.velocity[contact.a] -= b.inverse_mass[contact.a] * impulse;
  b.spin[contact.a] -= b.inverse_inertia[contact.a] * cross(slot.arm_a, impulse);
}

/// All impulses of a contact at once.
inline void apply_impulses(Bodies& b, const Contact& contact) {
  for (int k = 0; k < contact.count; ++k) apply_impulse(b, contact, contact.slot[k], contact.slot[k].impulse);
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
