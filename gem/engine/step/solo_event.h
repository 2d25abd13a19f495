// The solo events of one body as pure functions of values: the same code on host and device.
#pragma once

#include "gem/engine/step/ledger.h"
#include "gem/engine/step/step_constants.h"
#include "gem/events/events.h"

namespace gem {

/// Kinetic energy [J].
GEM_HD inline double kinetic_energy(double mass, double inertia, Vec2 velocity, double spin) {
  return 0.5 * mass * dot(velocity, velocity) + 0.5 * inertia * spin * spin;
}

/// Momentum, angular momentum and energy of one body.
GEM_HD inline Quantity quantity_of(double mass, double inertia, Vec2 position, Vec2 velocity, double spin) {
  const Vec2 momentum = mass * velocity;
  return {momentum, cross(position, momentum) + inertia * spin, kinetic_energy(mass, inertia, velocity, spin)};
}

/// A floe after the drag of one time step.
struct Kick {
  Vec2 velocity;                  // [m/s]
  double spin = 0.0;              // [rad/s]
  Vec2 path_correction;           // exact path of the drag minus velocity x dt [m]
  double angle_correction = 0.0;  // [rad]
};

GEM_HD inline Kick kick_of(const StepConstants& c, const DragSolution& solved, SpinDragSolution turn) {
  return {c.current - solved.slip, turn.spin, -solved.path_correction, turn.angle_correction};
}

/// Drag of the current over one time step; `drag` and `spin_drag` are the floe's coefficients.
GEM_HD inline Kick kick(const StepConstants& c, double drag, double spin_drag, Vec2 velocity, double spin) {
  const Vec2 slip = c.current - velocity;
  DragSolution solved;
  SpinDragSolution turn{spin, 0.0};
  if (c.drag_law == DragLaw::quadratic) {
    solved = drag_quadratic(drag, slip, length(slip), c.dt);
    if (spin_drag > 0.0) turn = spin_drag_quadratic(spin_drag, spin, c.dt);
  } else {
    solved = drag_linear(drag, slip, c.linear_decay, c.dt);
    if (spin_drag > 0.0) turn = spin_drag_linear(spin_drag, spin, c.linear_decay, c.dt);
  }
  return kick_of(c, solved, turn);
}

/// Enters a kick in the floe's drag book.
GEM_HD inline void book_kick(Quantity& book, double mass, double inertia, Vec2 position, Vec2 velocity, double spin,
                             const Kick& kick) {
  const Vec2 impulse = mass * (kick.velocity - velocity);
  const double twist = inertia * (kick.spin - spin);
  book.momentum += impulse;
  book.angular_momentum += cross(position, impulse) + twist;
  book.energy += 0.5 * dot(impulse, kick.velocity + velocity) + 0.5 * twist * (kick.spin + spin);
}

/// The platform as its own motion sees it, with the books of that motion.
struct PlatformMotion {
  double mass;
  Vec2& position;
  Vec2& velocity;
  Quantity& drag_book;
  Quantity& mooring_book;
  Quantity& mooring_force;
};

GEM_HD inline void platform_in_water(const StepConstants& c, const PlatformMotion& p) {
  if (!(c.platform_drag_rate > 0.0)) return;
  const Vec2 before = p.velocity;
  p.velocity = platform_drag(c.platform_drag_rate, before, c.platform_water, 0.5 * c.dt);
  const Vec2 impulse = p.mass * (p.velocity - before);
  p.drag_book.momentum += impulse;
  p.drag_book.angular_momentum += cross(p.position, impulse);
  p.drag_book.energy += 0.5 * dot(impulse, p.velocity + before);
}

/// One half of the platform's own motion; `toward_events` says which half: drag first, then mooring, or the reverse.
GEM_HD inline void platform_half(const StepConstants& c, const PlatformMotion& p, bool toward_events) {
  if (toward_events) platform_in_water(c, p);
  const Vec2 velocity = p.velocity;
  const double moment_of_momentum = cross(p.position, velocity);
  Vec2 offset = p.position - c.anchor;
  const double energy = 0.5 * p.mass * dot(velocity, velocity) + 0.5 * c.stiffness * dot(offset, offset);
  apply(c.half_mooring, offset, p.velocity);
  p.position = c.anchor + offset;
  p.mooring_force.momentum += p.mass * (p.velocity - velocity);
  p.mooring_force.angular_momentum += p.mass * (cross(p.position, p.velocity) - moment_of_momentum);
  if (c.mooring_damped)
    p.mooring_book.energy +=
        0.5 * p.mass * dot(p.velocity, p.velocity) + 0.5 * c.stiffness * dot(offset, offset) - energy;
  if (!toward_events) platform_in_water(c, p);
}

}  // namespace gem
