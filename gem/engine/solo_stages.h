// Stages that act on one body: the laws' solo events applied to index i, with their entries in the books.
//
// | stage               | reads                      | writes                                                |
// | kick_floe           | velocity, spin             | velocity, spin, path and angle correction, drag book  |
// | platform_first_half | platform position, velocity| the same, half a moment on; start position            |
// | drift_floe          | velocity, struck, repair   | position, rotation, outline, travel, struck = 0       |
// | platform_second_half| platform position, velocity| the same, outline                                     |
#pragma once

#include "gem/engine/field_state.h"
#include "gem/events/events.h"

namespace gem {

/// Kinetic energy [J].
inline double kinetic_energy(double mass, double inertia, Vec2 velocity, double spin) {
  return 0.5 * mass * dot(velocity, velocity) + 0.5 * inertia * spin * spin;
}

/// Drag of the current on floe i over the moment: its velocity at the end, before any event.
inline void kick_floe(FieldState& f, std::size_t i) {
  Bodies& b = f.bodies;
  const MomentConstants& c = f.constants;
  if (c.drag_law == DragLaw::none || !b.active[i]) return;
  const Vec2 velocity = b.velocity[i];
  const double spin = b.spin[i];
  const Vec2 slip = c.current - velocity;
  DragSolution drag;
  SpinDragSolution turn{spin, 0.0};
  if (c.drag_law == DragLaw::quadratic) {
    drag = drag_quadratic(b.drag[i], slip, length(slip), c.dt);
    if (b.spin_drag[i] > 0.0) turn = spin_drag_quadratic(b.spin_drag[i], spin, c.dt);
  } else {
    drag = drag_linear(b.drag[i], slip, c.linear_decay, c.dt);
    if (b.spin_drag[i] > 0.0) turn = spin_drag_linear(b.spin_drag[i], spin, c.linear_decay, c.dt);
  }
  b.velocity[i] = c.current - drag.slip;
  b.spin[i] = turn.spin;
  f.path_correction[i] = -drag.path_correction;
  f.angle_correction[i] = turn.angle_correction;

  const Vec2 impulse = b.mass[i] * (b.velocity[i] - velocity);
  const double twist = b.inertia[i] * (b.spin[i] - spin);
  Quantity& book = f.drag_book[i];
  book.momentum += impulse;
  book.angular_momentum += cross(b.position[i], impulse) + twist;
  book.energy += 0.5 * dot(impulse, b.velocity[i] + velocity) + 0.5 * twist * (b.spin[i] + spin);
}

/// Turns the outline of body i into world axes.
inline void turn_outline(FieldState& f, std::size_t i) {
  const Rotation q = f.bodies.rotation[i];
  for (std::int32_t v = f.bodies.vertex_begin[i]; v < f.bodies.vertex_begin[i + 1]; ++v) {
    f.corner[v] = rotate(q, f.bodies.vertex[v]);
    f.normal[v] = rotate(q, f.body_normal[v]);
  }
}

/// Turns body i by `angle` and follows with its outline.
inline void turn_body(FieldState& f, std::size_t i, double angle) {
  if (angle == 0.0) return;
  f.bodies.rotation[i] = turned(f.bodies.rotation[i], angle);
  f.turn_travel[i] += angle < 0.0 ? -angle : angle;
  turn_outline(f, i);
}

/// Moves floe i over the moment with its velocity after the events. A floe that no event touched follows the exact
/// path of its drag.
inline void drift_floe(FieldState& f, std::size_t i) {
  Bodies& b = f.bodies;
  const double dt = f.constants.dt;
  if (!b.active[i]) return;
  double angle = dt * b.spin[i];
  if (f.struck[i]) {
    b.position[i] += dt * b.velocity[i] + f.repair_shift[i];
    angle += f.repair_turn[i];
    f.repair_book[i].angular_momentum += b.mass[i] * cross(f.repair_shift[i], b.velocity[i]);
    f.struck[i] = 0;
  } else {
    b.position[i] += dt * b.velocity[i] + f.path_correction[i];
    angle += f.angle_correction[i];
    f.drag_book[i].angular_momentum += b.mass[i] * cross(f.path_correction[i], b.velocity[i]);
  }
  f.repair_shift[i] = {};
  f.repair_turn[i] = 0.0;
  turn_body(f, i, angle);
}

/// One half of the platform's own motion; `toward_events` says which half: drag first, then mooring, or the reverse.
inline void platform_half(FieldState& f, Ledger& ledger, bool toward_events) {
  Bodies& b = f.bodies;
  const MomentConstants& c = f.constants;
  const double mass = b.mass[0];
  auto water = [&] {
    if (!(c.platform_drag_rate > 0.0)) return;
    const Vec2 before = b.velocity[0];
    b.velocity[0] = platform_drag(c.platform_drag_rate, before, c.platform_water, 0.5 * c.dt);
    const Vec2 impulse = mass * (b.velocity[0] - before);
    Quantity& book = ledger[Channel::platform_drag];
    book.momentum += impulse;
    book.angular_momentum += cross(b.position[0], impulse);
    book.energy += 0.5 * dot(impulse, b.velocity[0] + before);
  };
  if (toward_events) water();
  const Vec2 velocity = b.velocity[0];
  const double moment_of_momentum = cross(b.position[0], velocity);
  Vec2 offset = b.position[0] - c.anchor;
  const double energy = 0.5 * mass * dot(velocity, velocity) + 0.5 * c.stiffness * dot(offset, offset);
  apply(c.half_mooring, offset, b.velocity[0]);
  b.position[0] = c.anchor + offset;
  ledger.mooring_force.momentum += mass * (b.velocity[0] - velocity);
  ledger.mooring_force.angular_momentum += mass * (cross(b.position[0], b.velocity[0]) - moment_of_momentum);
  if (c.mooring_damped)
    ledger[Channel::mooring].energy +=
        0.5 * mass * dot(b.velocity[0], b.velocity[0]) + 0.5 * c.stiffness * dot(offset, offset) - energy;
  if (!toward_events) water();
}

/// The platform's own motion up to the instant of the events.
inline void platform_first_half(FieldState& f, Ledger& ledger) {
  f.platform_position = f.bodies.position[0];
  if (f.constants.moored_or_free) platform_half(f, ledger, true);
}

/// The platform's own motion after the events.
inline void platform_second_half(FieldState& f, Ledger& ledger) {
  if (!f.constants.moored_or_free) return;
  platform_half(f, ledger, false);
  f.struck[0] = 0;
  const Vec2 shift = f.repair_shift[0];
  const Vec2 offset = f.bodies.position[0] - f.constants.anchor;
  f.bodies.position[0] += shift;
  f.repair_book[0].angular_momentum += f.bodies.mass[0] * cross(shift, f.bodies.velocity[0]);
  f.repair_book[0].energy += f.constants.stiffness * (dot(offset, shift) + 0.5 * dot(shift, shift));
  f.repair_shift[0] = {};
  turn_body(f, 0, f.constants.dt * f.bodies.spin[0] + f.repair_turn[0]);
  f.repair_turn[0] = 0.0;
}

}  // namespace gem
