// Stages for one body: the laws that act on a single body, applied to body i, with their entries in the books.
//
// | stage                | reads                       | writes                                               |
// | kick_floe            | velocity, spin              | velocity, spin, path and angle correction, drag book |
// | platform_first_half  | platform position, velocity | both after half a time step; start position          |
// | drift_floe           | velocity, struck, repair    | position, rotation, outline, travel, struck = 0      |
// | platform_second_half | platform position, velocity | both at the end of the time step; outline            |
// | retire_floe          | position                    | active, retired book                                 |
#pragma once

#include <cmath>

#include "gem/engine/step/field_state.h"
#include "gem/events/events.h"

namespace gem {

/// The properties of floe i that its solo events read.
inline FloeInEvents floe_in_events(const Bodies& b, std::size_t i) {
  return {b.mass[i],      b.inertia[i],  b.area[i],     b.thickness[i], b.drag[i],
          b.spin_drag[i], b.position[i], b.velocity[i], b.spin[i]};
}

/// Applies the solo events of floe i and books them; `drag`: see floe_events().
inline void apply_kick(FieldState& f, std::size_t i, const FloeDrag& drag) {
  Bodies& b = f.bodies;
  const FloeInEvents floe = floe_in_events(b, i);
  const FloeKick kick = floe_events(f.constants.events, f.drive, floe, drag);
  book_kick(f.book(Channel::drag, i), floe, kick);
  b.velocity[i] = kick.velocity;
  b.spin[i] = kick.spin;
  f.path_correction[i] = kick.path_correction;
  f.angle_correction[i] = kick.angle_correction;
}

/// Solo events of floe i over the time step. Sets its velocity at the end of the step without contacts.
inline void kick_floe(FieldState& f, std::size_t i) {
  if (!acts_on_floes(f.constants.events) || !f.bodies.active[i]) return;
  apply_kick(f, i, floe_drag(f.constants.events, f.drive, floe_in_events(f.bodies, i)));
}

/// Rotates the outline of body i into world axes.
inline void turn_outline(FieldState& f, std::size_t i) {
  const Rotation q = f.bodies.rotation[i];
  for (std::int32_t v = f.bodies.vertex_begin[i]; v < f.bodies.vertex_begin[i + 1]; ++v) {
    f.corner[v] = rotate(q, f.bodies.vertex[v]);
    f.normal[v] = rotate(q, f.body_normal[v]);
  }
}

/// Sets the rotation of body i after a turn by `angle` [rad], and updates its outline.
inline void apply_turn(FieldState& f, std::size_t i, double angle, Rotation rotation) {
  f.bodies.rotation[i] = rotation;
  f.turn_travel[i] += angle < 0.0 ? -angle : angle;
  turn_outline(f, i);
}

/// Turns body i by `angle` [rad].
inline void turn_body(FieldState& f, std::size_t i, double angle) {
  if (angle != 0.0) apply_turn(f, i, angle, turned(f.bodies.rotation[i], angle));
}

/// Moves floe i over the time step with its velocity after the events, without its turn. Returns the angle of the turn
/// [rad]. A floe that is not struck follows the exact path under drag.
inline double shift_floe(FieldState& f, std::size_t i) {
  Bodies& b = f.bodies;
  const double dt = f.constants.dt;
  double angle = dt * b.spin[i];
  if (f.struck[i]) {
    b.position[i] += dt * b.velocity[i] + f.repair_shift[i];
    angle += f.repair_turn[i];
    // substeps have booked their loads where the floe was
    if (f.constants.solver != ContactSolver::compliant)
      f.book(Channel::repair, i).angular_momentum += b.mass[i] * cross(f.repair_shift[i], b.velocity[i]);
    f.struck[i] = 0;
  } else {
    b.position[i] += dt * b.velocity[i] + f.path_correction[i];
    angle += f.angle_correction[i];
    f.book(Channel::drag, i).angular_momentum += b.mass[i] * cross(f.path_correction[i], b.velocity[i]);
  }
  f.repair_shift[i] = {};
  f.repair_turn[i] = 0.0;
  return angle;
}

/// Moves and turns floe i over the time step.
inline void drift_floe(FieldState& f, std::size_t i) {
  if (f.bodies.active[i]) turn_body(f, i, shift_floe(f, i));
}

/// Gives the pieces of the platform the velocity of their owner.
inline void carry_pieces(FieldState& f) {
  Bodies& b = f.bodies;
  for (std::int32_t i = 1; i < f.constants.pieces; ++i) {
    b.velocity[i] = b.velocity[0];
    b.spin[i] = b.spin[0];
  }
}

/// Moves the pieces of the platform to its place. They turn with it: their outlines too.
inline void move_pieces(FieldState& f, bool turned) {
  Bodies& b = f.bodies;
  for (std::int32_t i = 1; i < f.constants.pieces; ++i) {
    b.position[i] = b.position[0];
    b.rotation[i] = b.rotation[0];
    f.turn_travel[i] = f.turn_travel[0];
    if (turned) turn_outline(f, i);
  }
  carry_pieces(f);
}

/// Whether the state of body i is finite. The state of a retired floe does not matter.
inline bool finite_or_inactive(const Bodies& b, std::size_t i) {
  return !b.active[i] || std::isfinite(b.position[i].x + b.position[i].y + b.velocity[i].x + b.velocity[i].y +
                                       b.spin[i] + b.rotation[i].cosine + b.rotation[i].sine);
}

/// Retires floe i if it is past the retire line, and books the momentum and energy that it takes away.
inline void retire_floe(FieldState& f, std::size_t i) {
  Bodies& b = f.bodies;
  if (!b.active[i] || !(b.position[i].x > f.constants.retire_x)) return;
  book_gone(f.book(Channel::retired, i), quantity_of(b.mass[i], b.inertia[i], b.position[i], b.velocity[i], b.spin[i]));
  b.active[i] = 0;
}

/// `next`: the platform's rotation when its mooring pulls.
inline PlatformMotion platform_motion(FieldState& f, Rotation next) {
  Bodies& b = f.bodies;
  return {b.mass[0],
          b.position[0],
          b.velocity[0],
          f.book(Channel::platform_drag, 0),
          f.book(Channel::mooring, 0),
          f.mooring_force,
          b.inertia[0],
          b.inverse_inertia[0],
          b.spin[0],
          b.rotation[0],
          next,
          f.broken};
}

inline PlatformYaw platform_yaw(FieldState& f) {
  Bodies& b = f.bodies;
  return {b.inertia[0], b.rotation[0], b.position[0], b.velocity[0], b.spin[0], f.book(Channel::platform_drag, 0)};
}

inline MovedPlatform moved_platform(FieldState& f) {
  Bodies& b = f.bodies;
  return {b.rotation[0], b.position[0], b.velocity[0], b.spin[0], f.book(Channel::platform_drag, 0)};
}

inline PlatformOnDp platform_on_dp(FieldState& f) {
  Bodies& b = f.bodies;
  return {b.mass[0],
          b.inertia[0],
          b.position[0],
          b.rotation[0],
          b.velocity[0],
          b.spin[0],
          f.book(Channel::mooring, 0),
          f.mooring_force,
          f.book(Channel::platform_drag, 0),
          f.dp};
}

inline PushedPlatform pushed_platform(FieldState& f) {
  Bodies& b = f.bodies;
  return {
      b.mass[0],      b.inertia[0], b.position[0], b.rotation[0], b.velocity[0], b.spin[0], f.book(Channel::mooring, 0),
      f.mooring_force};
}

/// Leads a platform in transit, once a time step.
inline void tow_platform(FieldState& f) {
  tow_platform(f.constants.events, f.drive, pushed_platform(f), f.bodies.inverse_inertia[0] > 0.0);
}

/// All loads on the platform but tow and contacts, half a step of `e` long.
inline void platform_loads_before(FieldState& f, const Events& e) {
  thrust_platform(e, f.drive, pushed_platform(f));
  hold_station(e, f.drive, platform_on_dp(f), true);
  platform_events_before(e, f.drive, platform_motion(f, f.bodies.rotation[0]));
  steer_platform(e, f.drive, platform_yaw(f), true);
  turn_in_water(e, f.drive, moved_platform(f), f.bodies.rotation[0], false);
}

/// Their second half, before the platform turns with `spin`. Returns its rotation when its mooring pulls.
inline Rotation platform_loads_after(FieldState& f, const Events& e, double spin) {
  const Rotation next = yaw_of_pull(e, f.bodies.rotation[0], spin);
  turn_in_water(e, f.drive, moved_platform(f), next, true);
  platform_events_after(e, f.drive, platform_motion(f, next));
  return next;
}

/// The end of their second half, when it has turned.
inline void platform_loads_last(FieldState& f, const Events& e) {
  steer_platform(e, f.drive, platform_yaw(f), false);
  hold_station(e, f.drive, platform_on_dp(f), false);
  thrust_platform(e, f.drive, pushed_platform(f));
}

/// Moves the platform up to the time of the pair events.
inline void platform_first_half(FieldState& f) {
  f.platform_position = f.bodies.position[0];
  tow_platform(f);
  platform_loads_before(f, f.constants.events);
  f.before_contacts = {f.bodies.velocity[0], f.bodies.spin[0]};
  move_pieces(f, false);
}

/// Books what the ground gives to a fixed platform. The device has only the sum over the contacts, so this adds it too.
inline void hold_platform(FieldState& f) {
  f.mooring_force.momentum += f.held_impulse;
  f.mooring_force.angular_momentum += cross(f.bodies.position[0], f.held_impulse);
  f.held_impulse = {};
}

/// Moves the platform from the pair events to the end of the time step.
inline void platform_second_half(FieldState& f) {
  const Events& e = f.constants.events;
  if (!e.platform_present) return hold_platform(f);
  Bodies& b = f.bodies;
  take_water_along(e, moved_platform(f), f.before_contacts);
  const double spin = b.spin[0];  // it turns with the spin after the pair events
  const Rotation next = platform_loads_after(f, e, spin);
  f.struck[0] = 0;
  const Vec2 position = b.position[0], shift = f.repair_shift[0];
  b.position[0] += shift;
  f.repair_shift[0] = {};
  turn_body(f, 0, f.constants.dt * spin + f.repair_turn[0]);
  f.repair_turn[0] = 0.0;
  book_platform_shift(e, b.mass[0], b.velocity[0], f.broken, {position, shift, next, b.rotation[0]},
                      f.book(Channel::repair, 0));
  platform_loads_last(f, e);
  move_pieces(f, true);
}

/// After the substeps of compliant contacts, which have moved the platform: its outline follows.
inline void platform_after_substeps(FieldState& f) {
  if (!f.constants.events.platform_present) return hold_platform(f);
  turn_outline(f, 0);
  move_pieces(f, true);
}

}  // namespace gem
