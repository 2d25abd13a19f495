// The substep: what every corner feels at the present places, and how bodies move under it. No iteration, no order:
// every corner reads the same places and velocities, every body sums its own corners.
//
//   v' = v + M^-1 h sum F + kick,   x' = x + h v'        h: length of a substep [s]; symplectic Euler
//
// The kick is the substep's share of all other loads of the time step. Places are kept as motion since the start of the
// time step, turns as cosine and sine, so outlines stay as they were then and corners are brought into their axes.
//
// Only what touches is computed. A floe that nothing has touched in this time step is free: its place follows from the
// kicks alone. A pair is looked at when its gap could be closed:
//
//     gap - closing t - curve t^2 > stray_a + stray_b        no corner overlaps
//
//   gap, closing, curve   smallest gap of its corners, largest closing speed, half of a bound on its change in free
//                         motion [m], [m/s], [m/s2]
//   stray                 bound on how far any point of a body is from where it would be if it had stayed free [m]
#pragma once

#include <cstdint>

#include "gem/base/strict_math.h"
#include "gem/base/vec2.h"
#include "gem/engine/contact/corners.h"
#include "gem/events/compliant_contact.h"

namespace gem {

/// Place and speed of a body in a substep.
struct SubMotion {
  Vec2 shift;                       // since the start of the time step [m]
  double turn = 0.0;                // [rad]
  double cosine = 1.0, sine = 0.0;  // of the turn
  Vec2 velocity;                    // [m/s]
  double spin = 0.0;                // [rad/s]
};

/// A body during the substeps.
struct SubBody : SubMotion {
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

/// Energy of contacts since the start of the time step [J]; stored: at present. Losses are > 0.
struct ContactWork {
  double stored = 0.0, crushed = 0.0, damped = 0.0, friction = 0.0;
};

/// A corner of one body of a pair, p, near a side of the other, q. Forces and impulses are those on p; q gets the
/// opposite.
struct SubPoint {
  bool of_b = false;  // p is b of the pair, else a
  Vec2 corner;        // from p's centroid at the start [m]
  Vec2 between;       // from q's centroid to p's at the start [m]
  NearSides near;     // sides of q
  bool overlaps = false;
  bool entered = false;  // it did not overlap in the last substep
  CornerLaw law;
  CornerMemory memory;
  double full_stiffness = 0.0;  // of the ice; the law may have less [N/m]
  Vec2 flank[2];                // to the neighbour corners at the start [m]
  Surface surface;              // q at the start
  std::int32_t first_side = 0;  // of this piece of the platform, among all
  // of this substep
  double depth = 0.0, speed_n = 0.0, speed_t = 0.0, trial = 0.0;
  std::int32_t side = -1;  // of q, that it presses
  Vec2 axis;               // its outward normal
  Vec2 arm_p, arm_q;       // to the corner [m]
  Vec2 crossing[2];        // of the outlines, beside the corner, from p's centroid at the start [m]
  Vec2 impulse;            // [N s]
  double twist_p = 0.0, twist_q = 0.0;
  // sums of the time step
  Vec2 impulse_sum, normal_sum;  // [N s]; normal_sum: normal part alone
  double pressed = 0.0;          // sum of the magnitudes of the normal part [N s]
  double moment = 0.0;           // about q's centroid at the start [N m s]
  double twist_p_sum = 0.0, twist_q_sum = 0.0;
  Vec2 point_sum;                            // places from q's centroid at the start, times pressed [m N s]
  double softened = 0.0;                     // part of `pressed` with a stiffness below that of the ice [N s]
  double deepest = 0.0, most_elastic = 0.0;  // [m]
  ContactWork work;
};

/// Two bodies, of several pieces maybe, and the corners that one of them may have in the other.
struct SubPair {
  std::int32_t a = 0, b = 0;  // entries of the bodies
  double gap = 0.0, closing = 0.0, curve = 0.0;
  bool is_open = false;               // its points are filled
  bool presses = false;               // a corner overlapped in the last substep
  std::int32_t first = 0, count = 0;  // its points
  std::int32_t contact = 0;           // among the contacts of the time step: of the first piece
  double bound = 0.0;                 // P0 h^(1+ex): crushing force on a chord of 1 m [N]; < 0: no ice
  double exponent = 1.0;              // 1 + ex
  // largest normal force in a substep of this time step, and the chord and depth then
  double largest_force = 0.0, chord = 0.0, depth = 0.0;
  std::int32_t corners = 0;  // that overlapped then
};

/// Turns `x` as the body has turned.
GEM_HD GEM_INLINE Vec2 turned_with(const SubMotion& b, Vec2 x) {
  return {b.cosine * x.x - b.sine * x.y, b.sine * x.x + b.cosine * x.y};
}
/// A vector of the world in the axes that the body had at the start.
GEM_HD GEM_INLINE Vec2 in_axes_of(const SubMotion& b, Vec2 x) {
  return {b.cosine * x.x + b.sine * x.y, b.cosine * x.y - b.sine * x.x};
}

/// The corner ends its contact: what was stored and the last force did not give back is lost, and other ice is in front
/// of it when it comes back.
GEM_HD inline void leave(SubPoint& s, double h) {
  const CornerMemory& m = s.memory;
  const double stored = 0.5 * m.stiffness * (m.elastic * m.elastic + m.stretch * m.stretch);
  s.work.damped += stored - 0.5 * h * m.normal * s.speed_n;
  s.work.friction -= 0.5 * h * m.side * s.speed_t;
  s.work.stored -= stored;
  s.memory = {};
  s.impulse = {};
  s.twist_p = s.twist_q = 0.0;
}

/// Depth and speeds at the present places. Returns whether the corner overlaps.
GEM_HD inline bool touch(SubPoint& s, const SubMotion& p, const SubMotion& q) {
  const Vec2 arm_p = turned_with(p, s.corner);
  const Vec2 arm_q = s.between + p.shift - q.shift + arm_p;
  const Vec2 y = in_axes_of(q, arm_q);
  const SideDistance nearest = nearest_side(s.near, y, s.of_b ? tie : -tie);
  if (nearest.side < 0) return false;
  s.depth = -nearest.distance;
  s.side = s.near.side[nearest.side].side;
  s.axis = turned_with(q, s.near.side[nearest.side].normal);
  s.arm_p = arm_p;
  s.arm_q = arm_q;
  const Vec2 u = p.velocity + cross(p.spin, arm_p) - q.velocity - cross(q.spin, arm_q);
  s.speed_n = dot(u, s.axis);
  s.speed_t = dot(u, turned_left(s.axis));
  return true;
}

/// The two crossings of the outlines beside a corner that overlaps.
GEM_HD inline void find_crossings(SubPoint& s, const SubMotion& p, const SubMotion& q) {
  const Vec2 y = in_axes_of(q, s.arm_q);
  for (int k = 0; k < 2; ++k) {
    const Vec2 flank = turned_with(p, s.flank[k]);
    s.crossing[k] = p.shift + s.arm_p + exit_of(s.surface, s.side, y, in_axes_of(q, flank)) * flank;
  }
}

/// Books the work since the last force of the corner: means of the forces before and after, times what sprang, crushed
/// and slid between. `closed` and `slid`: motion of the last substep, across and along the side [m].
GEM_HD inline void book_corner(SubPoint& s, const CornerMemory& before, double elastic, double closed, double slid,
                               double lost) {
  CornerMemory& now = s.memory;
  const double k = s.law.stiffness, k_before = before.stiffness;
  const double spring = 0.5 * (k_before * before.elastic + k * elastic);
  const double dashpot = 0.5 * (before.normal - k_before * before.elastic + now.normal - k * elastic);
  const double crushed = now.crushed - before.crushed;
  const double pull = 0.5 * (k_before * before.stretch + k * now.stretch);
  const double drag = -0.5 * (before.side + k_before * before.stretch + now.side + k * now.stretch);
  s.work.crushed += spring * crushed;
  s.work.damped += dashpot * closed + lost;
  s.work.friction += pull * (slid - (now.stretch - before.stretch)) + drag * slid;
  s.work.stored += 0.5 * k * (elastic * elastic + now.stretch * now.stretch) -
                   0.5 * k_before * (before.elastic * before.elastic + before.stretch * before.stretch);
  now.elastic = elastic;
  now.stiffness = k;
}

/// The force of a corner, which crushing has bound to `force` if `crushes` [N].
GEM_HD inline void press(SubPoint& s, const SubMotion& q, double force, bool crushes, double h) {
  CornerMemory before = s.memory;
  CornerMemory& m = s.memory;
  // a stiffness that has fallen since the corner was last loaded takes energy with it
  double lost = 0.0;
  if (before.stiffness > s.law.stiffness) {
    lost = 0.5 * (before.stiffness - s.law.stiffness) *
           (before.elastic * before.elastic + before.stretch * before.stretch);
    before.stiffness = s.law.stiffness;
    s.work.stored -= lost;
  }
  if (crushes) m.crushed = crushed_depth(s.law, m.crushed, s.depth, force);
  const double slid = h * s.speed_t;
  m.normal = force;
  m.stretch = corner_stretch(s.law, m.stretch, slid, force);
  m.side = corner_friction(s.law, m.stretch, s.speed_t, force);
  book_corner(s, before, larger(0.0, s.depth - m.crushed), -h * s.speed_n, slid, lost);

  const Vec2 tangent = turned_left(s.axis);
  const Vec2 normal_part = (h * force) * s.axis;
  s.impulse = normal_part + (h * m.side) * tangent;
  s.twist_p = cross(s.arm_p, s.impulse);
  s.twist_q = -cross(s.arm_q, s.impulse);
  s.impulse_sum += s.impulse;
  s.normal_sum += normal_part;
  s.twist_p_sum += s.twist_p;
  s.twist_q_sum += s.twist_q;
  const double pressed = h * force;
  const Vec2 place = q.shift + s.arm_q;
  s.moment += cross(place, s.impulse);
  s.pressed += pressed;
  s.point_sum += pressed * place;
  if (s.law.stiffness < s.full_stiffness) s.softened += pressed;
  s.deepest = larger(s.deepest, s.depth);
  s.most_elastic = larger(s.most_elastic, m.elastic);
}

/// Spring and dashpot of a corner. Where it has entered, or presses another side than before, its spring has changed by
/// its motion of the last substep alone: the rest of its depth came from beside, or a contact was found late.
GEM_HD inline double try_corner(SubPoint& s, double h) {
  CornerMemory& m = s.memory;
  const std::int64_t side = s.first_side + s.side;
  if (side != m.pressed_side) m.crushed = larger(0.0, s.depth - larger(0.0, m.elastic - h * s.speed_n));
  m.pressed_side = side;
  return corner_pressure(s.law, s.depth - m.crushed, s.speed_n);
}

/// An ongoing contact whose touching corner changes goes on: a corner that enters in the substep in which another
/// corner of the pair leaves takes over its spring.
GEM_HD inline void hand_over(SubPoint* points, int count, const CornerMemory& left) {
  for (int k = 0; k < count; ++k) {
    SubPoint& s = points[k];
    if (!s.overlaps || !s.entered) continue;
    const double share = smaller(1.0, left.stiffness / s.law.stiffness);
    CornerMemory& m = s.memory;
    m = left;
    m.pressed_side = s.first_side + s.side;
    m.stiffness = s.law.stiffness;
    m.elastic = smaller(s.depth, share * left.elastic);
    m.stretch = share * left.stretch;
    m.crushed = s.depth - m.elastic;
    const double stored = 0.5 * m.stiffness * (m.elastic * m.elastic + m.stretch * m.stretch);
    s.work.stored += stored;
    s.work.damped -= stored;
    s.trial = corner_pressure(s.law, m.elastic, s.speed_n);
    return;
  }
}

/// Longest distance between the crossings of a pair: the chord of the overlap [m].
GEM_HD inline double chord_of(const SubPoint* points, int count) {
  double longest = 0.0;
  const bool base = points[0].of_b;
  const Vec2 to_first = points[0].between;
  for (int i = 0; i < count; ++i) {
    if (!points[i].overlaps) continue;
    for (int j = i; j < count; ++j) {
      if (!points[j].overlaps) continue;
      // crossings are told from the centroid of their own p, which is one of two bodies
      const Vec2 shift = points[i].of_b == points[j].of_b ? Vec2{} : points[i].of_b == base ? to_first : -to_first;
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) {
          const Vec2 d = points[i].crossing[k] - points[j].crossing[l] + shift;
          longest = larger(longest, dot(d, d));
        }
    }
  }
  return std::sqrt(longest);
}

/// Forces of one pair in a substep of length h [s]. Returns whether a corner overlaps.
GEM_HD inline bool press_pair(SubPair& pair, SubPoint* points, const SubMotion& a, const SubMotion& b, double h) {
  int inside = 0;
  CornerMemory left;
  for (int k = 0; k < pair.count; ++k) {
    SubPoint& s = points[k];
    const bool overlapped = s.overlaps;
    s.overlaps = s.of_b ? touch(s, b, a) : touch(s, a, b);
    s.entered = s.overlaps && !overlapped;
    inside += s.overlaps;
    if (s.overlaps) s.trial = try_corner(s, h);
    if (!s.overlaps && overlapped) {
      if (s.memory.normal > left.normal) left = s.memory;
      leave(s, h);
    }
  }
  pair.presses = inside > 0;
  if (!pair.presses) return false;
  if (left.normal > 0.0) hand_over(points, pair.count, left);
  double sum = 0.0, depth = 0.0;
  for (int k = 0; k < pair.count; ++k)
    if (points[k].overlaps) {
      sum += points[k].trial;
      depth = larger(depth, points[k].depth);
    }
  double share = 1.0, chord = 0.0;
  if (sum > 0.0 && pair.bound >= 0.0) {
    for (int k = 0; k < pair.count; ++k)
      if (points[k].overlaps) points[k].of_b ? find_crossings(points[k], b, a) : find_crossings(points[k], a, b);
    chord = chord_of(points, pair.count);
    const double bound = chord > 0.0 ? pair.bound * strict::power_short(chord, pair.exponent) : 0.0;
    if (sum > bound) share = bound / sum;
  }
  for (int k = 0; k < pair.count; ++k) {
    SubPoint& s = points[k];
    if (s.overlaps) press(s, s.of_b ? a : b, share * s.trial, share < 1.0, h);
  }
  if (share * sum > pair.largest_force) {
    pair.largest_force = share * sum;
    pair.chord = chord;
    pair.depth = depth;
    pair.corners = inside;
  }
  return true;
}

/// Velocity of the platform after the impulses of the contacts; its other loads follow.
GEM_HD inline void push(SubBody& b, Vec2 impulse, double twist) {
  const Vec2 velocity = b.velocity;
  const double spin = b.spin;
  b.velocity += b.inverse_mass * impulse;
  b.spin += b.inverse_inertia * twist;
  b.contact_work += 0.5 * dot(impulse, velocity + b.velocity);
  if (b.inverse_inertia > 0.0) b.contact_work += 0.5 * twist * (spin + b.spin);
}

/// Sets the turn of a body. The polynomials are exact to 1e-10 up to 0.2 rad; a small floe may be struck into a faster
/// spin.
GEM_HD inline void set_turn(SubMotion& b, double turn) {
  b.turn = turn;
  if (magnitude(turn) > 0.2) {
    const Rotation q = strict::rotation_of_angle(turn);
    b.cosine = q.cosine;
    b.sine = q.sine;
    return;
  }
  const double t2 = turn * turn;
  b.cosine = 1.0 - t2 * (1.0 / 2.0 - t2 * (1.0 / 24.0 - t2 * (1.0 / 720.0)));
  b.sine = turn * (1.0 - t2 * (1.0 / 6.0 - t2 * (1.0 / 120.0 - t2 * (1.0 / 5040.0))));
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

/// Ends the free motion of a body after `n` substeps; its books follow.
GEM_HD inline void end_free_motion(SubBody& b, double n, double h) {
  static_cast<SubMotion&>(b) = after_free_motion(b, n, h);
  b.shift_sum = h * ((0.5 * n * (n - 1.0)) * b.start_velocity + ((n - 1.0) * n * (n + 1.0) / 6.0) * b.kick);
  b.kick_work = n * (b.mass * dot(b.kick, b.start_velocity + (0.5 * n) * b.kick) +
                     b.inertia * b.kick_spin * (b.start_spin + 0.5 * n * b.kick_spin));
}

/// Bound on how far any point of a body is from its free motion after `n` substeps [m].
GEM_HD inline double stray_of(const SubBody& b, double n, double h) {
  const FreeMotion m = free_motion(b, n, h);
  const Vec2 d = b.shift - m.shift;
  return magnitude(d.x) + magnitude(d.y) + b.radius * magnitude(b.turn - m.turn);
}

/// Whether no corner of a pair can overlap after `n` substeps.
GEM_HD GEM_INLINE bool is_apart(const SubPair& pair, double t, double stray_a, double stray_b) {
  return pair.gap - t * (pair.closing + pair.curve * t) > stray_a + stray_b;
}

/// Takes a corner into the bound of its pair. `gap` outside the side [m], `u_n` its speed away from it [m/s]; `arm_q`
/// from q's centroid to the corner.
GEM_HD inline void watch(SubPair& pair, const SubBody& p, const SubBody& q, Vec2 corner, Vec2 arm_q, Vec2 normal,
                         double gap, double h) {
  const Vec2 u = p.start_velocity + cross(p.start_spin, corner) - q.start_velocity - cross(q.start_spin, arm_q);
  const double far = length(arm_q), rim = length(corner), turn = magnitude(q.start_spin);
  const double kicks = length(p.kick) + length(q.kick) + magnitude(p.kick_spin) * rim + magnitude(q.kick_spin) * far;
  // twice the acceleration at the start: the speeds that it depends on change by less than that within a time step
  const double acceleration =
      2.0 * (p.start_spin * p.start_spin * rim + turn * (turn * far + 2.0 * length(u)) + kicks / h);
  pair.gap = smaller(pair.gap, gap);
  pair.closing = larger(pair.closing, kicks - dot(u, normal));
  pair.curve = larger(pair.curve, 0.5 * acceleration);
}

/// Impulses of the contacts on a floe, its other loads and its motion over a substep. All work with the mean velocity
/// of the substep: one after the other they would seem to give and take energy where a floe rests.
GEM_HD inline void move(SubBody& b, Vec2 impulse, double twist, double h) {
  const Vec2 velocity = b.velocity;
  const double spin = b.spin;
  b.velocity += b.inverse_mass * impulse + b.kick;
  b.spin += b.inverse_inertia * twist + b.kick_spin;
  const Vec2 mean = 0.5 * (velocity + b.velocity);
  const double mean_spin = 0.5 * (spin + b.spin);
  b.contact_work += dot(impulse, mean) + twist * mean_spin;
  b.kick_work += b.mass * dot(b.kick, mean) + b.inertia * b.kick_spin * mean_spin;
  b.shift_sum += b.shift;
  b.shift += h * b.velocity;
  set_turn(b, b.turn + h * b.spin);
}

}  // namespace gem
