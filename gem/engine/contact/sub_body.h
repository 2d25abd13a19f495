// A body in the substeps.
//
//   v' = v + M^-1 h sum F + kick,   x' = x + h v'        h: length of a substep [s]; symplectic Euler
//
// The kick is the substep's share of all other loads of the time step. Places are kept as motion since the start of the
// time step, turns as cosine and sine, so outlines stay as they were then and corners are brought into their axes.
//
// A floe that nothing has touched in this time step is free: its place follows from the kicks alone.
#pragma once

#include "gem/base/choose.h"
#include "gem/base/strict_math.h"
#include "gem/base/vec2.h"

namespace gem {

/// Place and speed of a body in a substep. A row in memory: eight numbers, as packs read them.
struct alignas(64) SubMotion {
  Vec2 shift;                       // since the start of the time step [m]
  double cosine = 1.0, sine = 0.0;  // of the turn
  Vec2 velocity;                    // [m/s]
  double spin = 0.0;                // [rad/s]
  double turn = 0.0;                // [rad]
};

/// A body during the substeps.
struct SubBody {
  Vec2 start_velocity;      // at the start of the time step [m/s]
  double start_spin = 0.0;  // [rad/s]
  double radius = 0.0;      // of every point that a corner may meet [m]
  double inverse_mass = 0.0, inverse_inertia = 0.0;
  Vec2 kick;               // of one substep [m/s]
  double kick_spin = 0.0;  // [rad/s]
  // books of the time step
  double mass = 0.0, inertia = 0.0;
  Vec2 shift_sum;             // sum of the shifts at the kicks [m]
  double kick_work = 0.0;     // [J]
  double contact_work = 0.0;  // [J]
};

/// What the corners of a pair give in a substep: an impulse on b, the opposite on a, and a twist on each.
struct alignas(32) PairPush {
  Vec2 impulse;                         // [N s]
  double twist_a = 0.0, twist_b = 0.0;  // about the centroids [N m s]
};

/// Sets the turn of a body. The polynomials are exact to 1e-10 up to 0.2 rad; a small floe may be struck into a faster
/// spin.
GEM_HD inline void set_turn(SubMotion& m, double turn) {
  m.turn = turn;
  if (magnitude(turn) > 0.2) {
    const Rotation q = strict::rotation_of_angle(turn);
    m.cosine = q.cosine;
    m.sine = q.sine;
    return;
  }
  const double t2 = turn * turn;
  m.cosine = 1.0 - t2 * (1.0 / 2.0 - t2 * (1.0 / 24.0 - t2 * (1.0 / 720.0)));
  m.sine = turn * (1.0 - t2 * (1.0 / 6.0 - t2 * (1.0 / 120.0 - t2 * (1.0 / 5040.0))));
}

/// Motion of a body that is free for `n` substeps: where it then is.
struct FreeMotion {
  Vec2 shift;
  double turn = 0.0;
};
GEM_HD GEM_INLINE FreeMotion free_motion(const SubBody& b, double n, double h) {
  const double kicks = 0.5 * n * (n + 1.0);
  return {h * (n * b.start_velocity + kicks * b.kick), h * (n * b.start_spin + kicks * b.kick_spin)};
}

/// Place and speed of a body after `n` free substeps.
GEM_HD inline SubMotion after_free_motion(const SubBody& b, double n, double h) {
  const FreeMotion free = free_motion(b, n, h);
  SubMotion m;
  m.velocity = b.start_velocity + n * b.kick;
  m.spin = b.start_spin + n * b.kick_spin;
  m.shift = free.shift;
  set_turn(m, free.turn);
  return m;
}

/// Books of the free motion of a body that ends after `n` substeps.
GEM_HD inline void book_free_motion(SubBody& b, double n, double h) {
  b.shift_sum = h * ((0.5 * n * (n - 1.0)) * b.start_velocity + ((n - 1.0) * n * (n + 1.0) / 6.0) * b.kick);
  b.kick_work = n * (b.mass * dot(b.kick, b.start_velocity + (0.5 * n) * b.kick) +
                     b.inertia * b.kick_spin * (b.start_spin + 0.5 * n * b.kick_spin));
}

/// Bound on how far any point of a body is from its free motion after `n` substeps [m].
GEM_HD inline double stray_of(const SubBody& b, const SubMotion& m, double n, double h) {
  const FreeMotion free = free_motion(b, n, h);
  const Vec2 d = m.shift - free.shift;
  return magnitude(d.x) + magnitude(d.y) + b.radius * magnitude(m.turn - free.turn);
}

/// Velocity of the platform after the impulses of the contacts; its other loads follow.
GEM_HD inline void push(SubBody& b, SubMotion& m, Vec2 impulse, double twist) {
  const Vec2 velocity = m.velocity;
  const double spin = m.spin;
  m.velocity += b.inverse_mass * impulse;
  m.spin += b.inverse_inertia * twist;
  b.contact_work += 0.5 * dot(impulse, velocity + m.velocity);
  if (b.inverse_inertia > 0.0) b.contact_work += 0.5 * twist * (spin + m.spin);
}

/// Impulses of the contacts on a floe, its other loads and its motion over a substep. All work with the mean velocity
/// of the substep: one after the other they would seem to give and take energy where a floe rests.
GEM_HD inline void move(SubBody& b, SubMotion& m, Vec2 impulse, double twist, double h) {
  const Vec2 velocity = m.velocity;
  const double spin = m.spin;
  m.velocity += b.inverse_mass * impulse + b.kick;
  m.spin += b.inverse_inertia * twist + b.kick_spin;
  const Vec2 mean = 0.5 * (velocity + m.velocity);
  const double mean_spin = 0.5 * (spin + m.spin);
  b.contact_work += dot(impulse, mean) + twist * mean_spin;
  b.kick_work += b.mass * dot(b.kick, mean) + b.inertia * b.kick_spin * mean_spin;
  b.shift_sum += m.shift;
  m.shift += h * m.velocity;
  set_turn(m, m.turn + h * m.spin);
}

}  // namespace gem
