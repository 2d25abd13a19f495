// The event of one touching pair as pure functions of values: the same code on host and device.
//
// | function      | from                               | to                                        |
// | open_contact  | geometry of the contact            | contact without impulses                  |
// | prepare       | contact, its bodies                | arms, compliance, velocities before       |
// | resolve_alone | contact, its bodies                | its impulses                              |
// | slot_work     | contact, velocity after the events | energy change by each kind of impulse     |
// | book_fixed    | contact                            | momentum from a fixed body                |
#pragma once

#include "gem/engine/solver/coupled_point.h"
#include "gem/engine/step/contact.h"
#include "gem/engine/step/ledger.h"
#include "gem/engine/step/step_constants.h"
#include "gem/events/events.h"
#include "gem/geometry/convex_contact.h"

namespace gem {

/// The two bodies of a contact at the time of the events.
struct PairBodies {
  CollisionMass mass_a, mass_b;
  Vec2 velocity_a, velocity_b;        // [m/s]
  double spin_a = 0.0, spin_b = 0.0;  // [rad/s]
  double thickness = 0.0;             // of the ice that crushes [m]
};

/// Thickness of the ice that crushes: the thinner floe. A platform or a fixed body A does not crush [m]. The same of
/// any power of the thickness.
GEM_HD inline double crushed_thickness(BodyKind kind_a, double thickness_a, double thickness_b) {
  return kind_a == BodyKind::floe && thickness_a < thickness_b ? thickness_a : thickness_b;
}

/// Velocity of B relative to A at a contact point [m/s].
GEM_HD inline Vec2 relative_velocity(const PairBodies& p, const ContactSlot& slot) {
  return p.velocity_b + cross(p.spin_b, slot.arm_b) - p.velocity_a - cross(p.spin_a, slot.arm_a);
}

/// Stores the contact geometry. Sets all members that later stages add to to zero.
GEM_HD inline void open_contact(Contact& contact, std::int32_t a, std::int32_t b, const ContactGeometry& geometry,
                                Vec2 offset) {
  contact.a = a;
  contact.b = b;
  contact.count = geometry.count;
  contact.normal = geometry.normal;
  contact.width = geometry.width;
  contact.growth = geometry.growth;
  contact.largest_force = 0.0;
  for (int k = 0; k < 2 && k < geometry.count; ++k) {
    contact.slot[k].arm_a = geometry.point[k].position;
    contact.slot[k].arm_b = geometry.point[k].position - offset;
    contact.slot[k].separation = geometry.point[k].separation;
    contact.slot[k].feature = geometry.point[k].feature;
    contact.slot[k].target = 0.0;
    contact.slot[k].cap = no_cap;
    contact.slot[k].impulse = {};
    contact.slot[k].elastic = 0.0;
    contact.slot[k].repair = 0.0;
    contact.slot[k].last_normal = 0.0;
    contact.slot[k].spare = {};
  }
}

/// Sets velocity and compliance at the time of the events. `shift` is the motion of A since the geometry was found [m].
GEM_HD inline void prepare(const StepConstants& c, const PairBodies& p, Vec2 shift, Contact& contact) {
  contact.friction = friction_of_pair(c.events, c.is_platform(contact.a));
  const Vec2 tangent = turned_left(contact.normal);
  for (int k = 0; k < 2 && k < contact.count; ++k) {
    ContactSlot& slot = contact.slot[k];
    slot.arm_a -= shift;
    const Vec2 velocity = relative_velocity(p, slot);
    slot.normal_before = dot(velocity, contact.normal);
    slot.tangential_before = dot(velocity, tangent);
    if (c.solver == ContactSolver::coupled) {
      slot.target = slot.separation > 0.0 ? -slot.separation / c.dt : 0.0;
      continue;
    }
    slot.compliance = contact_compliance(p.mass_a, slot.arm_a, p.mass_b, slot.arm_b, contact.normal);
    if (c.events.contact.elastic_stiffness_N_per_m > 0.0 && slot.separation < 0.0)
      slot.target = static_stress_speed(c.events, -slot.separation, slot.compliance.nn, contact.width, p.thickness);
  }
}

/// The impulse of a point in world axes [N s].
GEM_HD inline Vec2 world_impulse(const Contact& contact, ContactImpulse p) {
  return p.normal * contact.normal + p.tangential * turned_left(contact.normal);
}

/// Velocity at point k from the impulses of point j of the same pair [m/s].
GEM_HD inline Vec2 cross_response(const Contact& contact, CollisionMass a, CollisionMass b, int k, int j) {
  const ContactSlot& at = contact.slot[k];
  const ContactSlot& from = contact.slot[j];
  const Vec2 impulse = world_impulse(contact, from.impulse);
  return (a.inverse_mass + b.inverse_mass) * impulse + cross(a.inverse_inertia * cross(from.arm_a, impulse), at.arm_a) +
         cross(b.inverse_inertia * cross(from.arm_b, impulse), at.arm_b);
}

/// Resolves the event of one pair from the state at the start of the step, independent of other contacts. Two points of
/// one pair are one event: they are iterated together.
GEM_HD inline void resolve_alone(const StepConstants& c, CollisionMass a, CollisionMass b, Contact& contact) {
  // Each Gauss-Seidel sweep multiplies the error by ((1 - q) / (1 + q))^2, with q = (half distance of the points /
  // radius of gyration)^2 for a contact opposite the centroid: 1/25 for the side of a square (V14), 1/4 for the long
  // side of a thin floe. 24 sweeps reduce both to rounding (4^-24 = 4e-15). The error of a short facing stretch falls
  // more slowly: q = 0.1 leaves 7e-5 of it, a remaining rotation.
  constexpr int sweeps = 24;
  const Vec2 tangent = turned_left(contact.normal);
  for (int sweep = 0; sweep < (contact.count == 1 ? 1 : sweeps); ++sweep) {
    for (int k = 0; k < 2 && k < contact.count; ++k) {
      ContactSlot& slot = contact.slot[k];
      Vec2 other;
      if (contact.count == 2) other = cross_response(contact, a, b, k, 1 - k);
      slot.impulse =
          pair_impulse(c.events, slot.compliance, contact.friction, slot.normal_before + dot(other, contact.normal),
                       slot.tangential_before + dot(other, tangent), slot.target);
    }
  }
  for (int k = 0; k < 2 && k < contact.count; ++k) {
    ContactSlot& slot = contact.slot[k];
    const double closing = slot.normal_before < 0.0 ? -slot.normal_before : 0.0;
    const double asked = slot.target + closing;
    slot.elastic = asked > 0.0 && slot.target > 0.0 ? slot.impulse.normal * (slot.target / asked) : 0.0;
  }
}

/// The mass of a body divided among its contact points.
GEM_HD inline CollisionMass shared_mass(CollisionMass mass, std::int32_t points) {
  const double share = points;
  return {share * mass.inverse_mass, share * mass.inverse_inertia};
}

/// Sets what a point has from the last time step. `a` and `b` are the masses of the bodies.
GEM_HD inline void recall(const StepConstants& c, const Contact& contact, ContactSlot& slot, CollisionMass a,
                          CollisionMass b, const PointMemory& last) {
  slot.last_normal = last.impulse.normal;
  slot.spare = {};
  const double closing = slot.target - slot.normal_before;
  if (c.point_friction != PointFriction::coulomb || !(last.rise > 0.0 && closing > 0.0)) return;
  slot.spare = spare_friction(contact.friction, {last.impulse.normal, last.impulse.tangential}, last.rise,
                              contact_compliance(a, slot.arm_a, b, slot.arm_b, contact.normal), closing);
}

/// A contact point for the coupled iterations. `a` and `b` are masses divided among the points, see shared_mass();
/// `last` is what it has from the last time step.
GEM_HD inline PointGeometry<double> point_geometry(const StepConstants& c, const Contact& contact,
                                                   const ContactSlot& slot, CollisionMass a, CollisionMass b,
                                                   const PointMemory& last, double cap) {
  const Vec2 normal = contact.normal, tangent = turned_left(normal);
  PointGeometry<double> g{};
  g.normal_x = normal.x;
  g.normal_y = normal.y;
  g.lever_a_n = cross(slot.arm_a, normal);
  g.lever_a_t = cross(slot.arm_a, tangent);
  g.lever_b_n = cross(slot.arm_b, normal);
  g.lever_b_t = cross(slot.arm_b, tangent);
  set_compliance(g, a.inverse_mass + b.inverse_mass, a.inverse_inertia, b.inverse_inertia);
  g.friction = contact.friction;
  if (c.point_friction == PointFriction::fixed_direction) {
    const double slip = slip_of_hit(slot.tangential_before, {last.impulse.normal, last.impulse.tangential}, last.rise);
    g.friction = slip > 0.0 ? -contact.friction : slip < 0.0 ? contact.friction : 0.0;
    const double sliding = g.nn + g.friction * g.nt;
    if (sliding > 0.0)
      g.nn = sliding;
    else
      g.friction = 0.0;
  }
  g.target = slot.target;
  g.cap = cap;
  if (slot.separation < 0.0) g.repair_target = smaller(-c.repair_share * slot.separation, c.repair_speed * c.dt);
  return g;
}

/// Fraction of the last repair that a time step starts from. Below 1, so that a finished repair fades and does not open
/// gaps. Measured in validation/solver_study.md, "Repair": 1 instead of 0.9 lowers the overlap but opens gaps.
constexpr double repair_memory = 0.9;

/// Repair that a point starts from [kg m]; `last` is the repair of the last time step. A repair is dropped if it
/// shifts the bodies by less than 1e-9 or more than 1e4 times the largest shift of a time step (both chosen by hand).
/// The first is negligible. The second is more than single precision can carry: where no shift removes all overlaps,
/// repairs grow from time step to time step (H21).
GEM_HD inline double repair_to_go_on(const StepConstants& c, double last, double nn) {
  constexpr double negligible = 1e-9, too_large = 1e4;
  const double repair = repair_memory * last, largest_shift = c.repair_speed * c.dt;
  return repair * nn > negligible * largest_shift && repair * nn < too_large * largest_shift ? repair : 0.0;
}

/// Velocity change of a body from an impulse at `arm`; the other body of the pair gets the opposite impulse.
struct VelocityChange {
  Vec2 velocity;      // [m/s]
  double spin = 0.0;  // [rad/s]
};

GEM_HD inline VelocityChange velocity_change(CollisionMass mass, Vec2 arm, Vec2 impulse) {
  return {mass.inverse_mass * impulse, mass.inverse_inertia * cross(arm, impulse)};
}

/// Whether a point has any impulse or repair.
GEM_HD inline bool acted(const ContactSlot& slot) {
  return slot.impulse.normal != 0.0 || slot.impulse.tangential != 0.0 || slot.repair != 0.0;
}

/// Whether a resolved contact presses.
GEM_HD inline bool presses(const Contact& contact) {
  for (int k = 0; k < 2 && k < contact.count; ++k)
    if (contact.slot[k].impulse.normal > 0.0) return true;
  return false;
}

/// Work of the impulses at one point, by kind; negative: energy lost [J].
struct SlotWork {
  double impact = 0.0, elastic = 0.0, friction = 0.0;
};

/// `velocity` is that of B relative to A at the point after the events [m/s].
GEM_HD inline SlotWork slot_work(const Contact& contact, const ContactSlot& slot, Vec2 velocity) {
  const double after_n = dot(velocity, contact.normal), after_t = dot(velocity, turned_left(contact.normal));
  return {impulse_work(slot.impulse.normal - slot.elastic, slot.normal_before, after_n),
          impulse_work(slot.elastic, slot.normal_before, after_n),
          impulse_work(slot.impulse.tangential, slot.tangential_before, after_t)};
}

/// The contact channels of one body's books.
struct ContactBooks {
  Quantity& impact;
  Quantity& elastic;
  Quantity& friction;
};

/// Books the momentum that a fixed body gives at one point: A acts on B with +impulse, B on A with -impulse.
/// `position_b` is the position of B when the geometry was found [m].
GEM_HD inline void book_fixed(const ContactBooks& books, const Contact& contact, const ContactSlot& slot,
                              Vec2 position_b, bool b_is_fixed) {
  const double given = b_is_fixed ? -1.0 : 1.0;
  const Vec2 point = position_b + slot.arm_b;
  const auto enter = [&](Quantity& book, Vec2 impulse) {
    book.momentum += given * impulse;
    book.angular_momentum += given * cross(point, impulse);
  };
  enter(books.impact, (slot.impulse.normal - slot.elastic) * contact.normal);
  enter(books.elastic, slot.elastic * contact.normal);
  enter(books.friction, slot.impulse.tangential * turned_left(contact.normal));
}

}  // namespace gem
