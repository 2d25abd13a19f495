// Added mass: the water that a platform sets in motion, as a constant matrix in the platform's axes.
//
//   (M + A) d(v_r) / dt = F,   p = (M + A) v_r        A = [a_surge 0 0; 0 a_sway a_c; 0 a_c a_yaw]
//
//   kick   a law that gives the platform alone the change d gives, with the water,  d' = (M + A)^-1 M d
//   turn   p_xy keeps its direction in the world;   dL/dt = p_x v_y - p_y v_x  (Munk moment)
//
//   M    mass, mass and moment of inertia of the platform alone [kg], [kg m2]
//   v_r  velocity through the water, and yaw rate [m/s], [rad/s]
//   a    added mass of surge, sway [kg], yaw [kg m2], and the coupling of sway and yaw [kg m]
//   p    momentum of platform and water: surge, sway [N s]       L  the same of the yaw [N m s]
//
// Every law of the platform finds its impulse as if the platform were alone. Then the water takes its part. An impulse
// of drag, wind or mooring is exact for the speed at its start, so this costs a term of second order in a time step. In
// a hit, ice meets the platform's own mass: with a floe of mass m its impulse is wrong by less than m / M. The water's
// part of a push of the ice is given after the pair events; a floe that presses on is stopped in the next time step.
// The Munk moment acts half before the platform turns and half after it. So p is kept to rounding, and the energy to
// second order without a drift. With a_c the energy is of first order: 1e-4 of it in an hour of turning freely, with
// time steps of 0.2 s.
//
// Sources: Lamb, Hydrodynamics (6th ed., 1932), art. 118 to 124; Newman, Marine Hydrodynamics (1977), ch. 4; Fossen,
// Handbook of Marine Craft Hydrodynamics and Motion Control (2nd ed., 2021), ch. 6. For a ship: a_surge about 0.05 M,
// a_sway 0.5 M to M, a_yaw 0.3 I to I.
// Range: constant A, so slow motion against waves. Neglected: its dependence on frequency, the acceleration of the
// water itself, viscous moments, which oppose the Munk moment of a real hull.
#pragma once

#include "gem/base/vec2.h"
#include "gem/events/quantity.h"

namespace gem {

struct AddedMassDef {
  double surge_kg = 0.0, sway_kg = 0.0;
  double yaw_kg_m2 = 0.0;
  double sway_yaw_kg_m = 0.0;
};

/// Velocity [m/s] and yaw rate [rad/s].
struct PlatformSpeed {
  Vec2 velocity;
  double spin = 0.0;
};

/// Constants of the law. `present` is false without added mass.
struct AddedMass {
  bool present = false;
  bool turns = false;
  double mass = 0.0, inertia = 0.0;  // of the platform alone [kg], [kg m2]
  double surge = 0.0, sway = 0.0;    // of platform and water [kg]
  double yaw = 0.0, coupling = 0.0;  // [kg m2], [kg m]
  double surge_left = 1.0;           // d'_surge from d_surge [-]
  double sway_left = 1.0, spin_left = 1.0;
  double sway_from_spin = 0.0;  // [m]
  double spin_from_sway = 0.0;  // [1/m]
};

/// The constants for a platform of `mass` [kg] and `inertia` [kg m2] that turns or not. Host only, once per run.
inline AddedMass added_mass(const AddedMassDef& def, double mass, double inertia, bool turns) {
  AddedMass a;
  a.present = def.surge_kg != 0.0 || def.sway_kg != 0.0 || def.yaw_kg_m2 != 0.0 || def.sway_yaw_kg_m != 0.0;
  if (!a.present) return a;
  a.turns = turns;
  a.mass = mass;
  a.inertia = inertia;
  a.surge = mass + def.surge_kg;
  a.sway = mass + def.sway_kg;
  a.surge_left = mass / a.surge;
  a.sway_left = mass / a.sway;
  if (!turns) return a;
  a.yaw = inertia + def.yaw_kg_m2;
  a.coupling = def.sway_yaw_kg_m;
  const double determinant = a.sway * a.yaw - a.coupling * a.coupling;
  a.sway_left = mass * a.yaw / determinant;
  a.spin_left = inertia * a.sway / determinant;
  a.sway_from_spin = -inertia * a.coupling / determinant;
  a.spin_from_sway = -mass * a.coupling / determinant;
  return a;
}

/// What is left of a change from `before` to `after` when the water moves along. The platform lies as `q` says.
GEM_HD constexpr PlatformSpeed with_water(const AddedMass& a, Rotation q, const PlatformSpeed& before,
                                          const PlatformSpeed& after) {
  const Vec2 change = rotate({q.cosine, -q.sine}, after.velocity - before.velocity);
  const double turn = after.spin - before.spin;
  const Vec2 left{a.surge_left * change.x, a.sway_left * change.y + a.sway_from_spin * turn};
  return {before.velocity + rotate(q, left), before.spin + (a.spin_left * turn + a.spin_from_sway * change.y)};
}

/// The speed through the water after the Munk moment of `h` seconds, with the platform as `q` says.
GEM_HD constexpr PlatformSpeed before_turn(const AddedMass& a, Rotation q, const PlatformSpeed& speed, double h) {
  const Vec2 v = rotate({q.cosine, -q.sine}, speed.velocity);
  const Vec2 momentum{a.surge * v.x, a.sway * v.y + a.coupling * speed.spin};
  const double yaw = a.coupling * v.y + a.yaw * speed.spin + h * (momentum.x * v.y - momentum.y * v.x);
  const double determinant = 1.0 / (a.sway * a.yaw - a.coupling * a.coupling);
  const double sway = determinant * (a.yaw * momentum.y - a.coupling * yaw);
  return {rotate(q, {v.x, sway}), determinant * (a.sway * yaw - a.coupling * momentum.y)};
}

/// The speed through the water after the platform has turned from `q` to `next` and met the Munk moment of `h` seconds
/// there. Without coupling it undoes before_turn() in reversed time.
GEM_HD constexpr PlatformSpeed after_turn(const AddedMass& a, Rotation q, Rotation next, const PlatformSpeed& speed,
                                          double h) {
  const Vec2 v = rotate({q.cosine, -q.sine}, speed.velocity);
  const Vec2 start{a.surge * v.x, a.sway * v.y + a.coupling * speed.spin};
  const Vec2 momentum = rotate({next.cosine, -next.sine}, rotate(q, start));
  const double surge = momentum.x / a.surge;
  // a.sway w + a.coupling r = momentum.y,   (a.coupling - h momentum.x) w + a.yaw r = yaw
  const double yaw = a.coupling * v.y + a.yaw * speed.spin - h * momentum.y * surge;
  const double slope = a.coupling - h * momentum.x;
  const double determinant = 1.0 / (a.sway * a.yaw - a.coupling * slope);
  const double sway = determinant * (a.yaw * momentum.y - a.coupling * yaw);
  return {rotate(next, {surge, sway}), determinant * (a.sway * yaw - slope * momentum.y)};
}

/// Momentum and energy that the water gives to a platform at `position` [m] that it brings from `before` to `after`.
GEM_HD inline Quantity given_by_water(const AddedMass& a, Vec2 position, const PlatformSpeed& before,
                                      const PlatformSpeed& after) {
  const Vec2 impulse = a.mass * (after.velocity - before.velocity);
  const double twist = a.inertia * (after.spin - before.spin);
  return {impulse, cross(position, impulse) + twist,
          0.5 * dot(impulse, after.velocity + before.velocity) + 0.5 * twist * (after.spin + before.spin)};
}

/// Adds what is given to a book.
GEM_HD inline void book_given(Quantity& book, const Quantity& given) {
  book.momentum += given.momentum;
  book.angular_momentum += given.angular_momentum;
  book.energy += given.energy;
}

}  // namespace gem
