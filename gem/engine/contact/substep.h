// The substep: what every corner feels at the present places, and how bodies move under it. No iteration, no order:
// every corner reads the same places and velocities, every body sums its own corners.
//
//   v' = v + M^-1 h sum F + kick,   x' = x + h v'        h: length of a substep [s]; symplectic Euler
//
// The kick is the substep's share of all other loads of the time step. Places are kept as motion since the start of the
// time step, turns as cosine and sine, so outlines stay as they were then and corners are brought into their axes.
#pragma once

#include <cstdint>

#include "gem/base/strict_math.h"
#include "gem/base/vec2.h"
#include "gem/engine/contact/corners.h"
#include "gem/events/compliant_contact.h"

namespace gem {

/// A body during the substeps.
struct SubBody {
  Vec2 shift;                        // since the start of the time step [m]
  double turn = 0.0;                 // [rad]
  double cosine = 1.0, sine = 0.0;   // of the turn
  Vec2 velocity;                     // [m/s]
  double spin = 0.0;                 // [rad/s]
  double inverse_mass = 0.0, inverse_inertia = 0.0;
  Vec2 kick;                         // of one substep [m/s]
  double kick_spin = 0.0;            // [rad/s]
  // books of the time step
  double mass = 0.0, inertia = 0.0;
  Vec2 shift_sum;                    // sum of the shifts at the kicks [m]
  double kick_work = 0.0;            // [J]
  double contact_work = 0.0;         // [J]
  bool pressed = false;              // a corner has overlapped
};

/// Energy of contacts since the start of the time step [J]; stored: at present. Losses are > 0.
struct ContactWork {
  double stored = 0.0, crushed = 0.0, damped = 0.0, friction = 0.0;
};

/// A corner of body p near a side of body q. Forces and impulses are those on p; q gets the opposite.
struct SubPoint {
  // read in every substep
  std::int32_t p = 0, q = 0;  // entries of the bodies
  Vec2 corner;                // from p's centroid at the start [m]
  Vec2 between;               // from q's centroid to p's at the start [m]
  Vec2 normal;                // of a side of q: outside it, the corner does not overlap
  double offset = 0.0;        // of that side along its normal, from q's centroid [m]
  double slack = 0.0;         // see pressed_side() [m]
  bool overlaps = false, entered = false;  // now; not in the last substep
  // read where it overlaps
  CornerLaw law;
  CornerMemory memory;
  double full_stiffness = 0.0;  // of the ice; the law may have less [N/m]
  Vec2 flank[2];                // to the neighbour corners at the start [m]
  Surface surface;              // q at the start
  // of this substep
  double depth = 0.0, speed_n = 0.0, speed_t = 0.0, trial = 0.0;
  std::int32_t side = -1;       // of q
  Vec2 axis;                    // its outward normal
  Vec2 arm_p, arm_q;            // to the corner [m]
  Vec2 crossing[2];             // of the outlines, beside the corner, from p's centroid at the start [m]
  Vec2 impulse;                 // [N s]
  double twist_p = 0.0, twist_q = 0.0;
  // sums of the time step
  Vec2 impulse_sum, normal_sum;          // [N s]; normal_sum: normal part alone
  double pressed = 0.0;                  // sum of the magnitudes of the normal part [N s]
  double moment = 0.0;                   // about q's centroid at the start [N m s]
  double twist_p_sum = 0.0, twist_q_sum = 0.0;
  Vec2 point_sum;                        // places from q's centroid at the start, times pressed [m N s]
  double softened = 0.0;                 // part of `pressed` with a stiffness below that of the ice [N s]
  double deepest = 0.0, most_elastic = 0.0;  // [m]
  ContactWork work;
};

/// Two bodies, of several pieces maybe, and the corners that one of them may have in the other.
struct SubPair {
  std::int32_t first = 0, count = 0;  // its points
  std::int32_t contact = 0;           // among the contacts of the time step: of the first piece
  double bound = 0.0;                 // P0 h^(1+ex): crushing force on a chord of 1 m [N]; < 0: no ice
  double exponent = 1.0;              // 1 + ex
  // largest normal force in a substep of this time step, and the chord and depth then
  double largest_force = 0.0, chord = 0.0, depth = 0.0;
  std::int32_t corners = 0;           // that overlapped then
};

/// Turns `x` as the body has turned.
GEM_HD GEM_INLINE Vec2 turned_with(const SubBody& b, Vec2 x) {
  return {b.cosine * x.x - b.sine * x.y, b.sine * x.x + b.cosine * x.y};
}
/// A vector of the world in the axes that the body had at the start.
GEM_HD GEM_INLINE Vec2 in_axes_of(const SubBody& b, Vec2 x) {
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

/// Depth, speeds and the force of spring and dashpot alone, at the present places. Returns whether the corner overlaps.
GEM_HD inline bool touch(SubPoint& s, const SubBody& p, const SubBody& q) {
  const Vec2 arm_p = turned_with(p, s.corner);
  const Vec2 arm_q = s.between + p.shift - q.shift + arm_p;
  const Vec2 y = in_axes_of(q, arm_q);
  if (!(dot(s.normal, y) < s.offset + larger(0.0, s.slack))) return false;
  const Vec2 flank[2] = {in_axes_of(q, turned_with(p, s.flank[0])), in_axes_of(q, turned_with(p, s.flank[1]))};
  const SideDistance nearest = pressed_side(s.surface, y, flank, s.slack);
  if (nearest.side < 0) return false;
  s.depth = -nearest.distance;
  s.side = nearest.side;
  s.axis = turned_with(q, s.surface.outline.normal[nearest.side]);
  s.arm_p = arm_p;
  s.arm_q = arm_q;
  const Vec2 u = p.velocity + cross(p.spin, arm_p) - q.velocity - cross(q.spin, arm_q);
  s.speed_n = dot(u, s.axis);
  s.speed_t = dot(u, turned_left(s.axis));
  return true;
}

/// The two crossings of the outlines beside a corner that overlaps.
GEM_HD inline void find_crossings(SubPoint& s, const SubBody& p, const SubBody& q) {
  const Vec2 world[2] = {turned_with(p, s.flank[0]), turned_with(p, s.flank[1])};
  const Vec2 flank[2] = {in_axes_of(q, world[0]), in_axes_of(q, world[1])};
  const Exits e = exits(s.surface, in_axes_of(q, s.arm_q), flank);
  for (int k = 0; k < 2; ++k) s.crossing[k] = p.shift + s.arm_p + e.share[k] * world[k];
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
GEM_HD inline void press(SubPoint& s, const SubBody& q, double force, bool crushes, double h) {
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
  if (s.side != m.pressed_side) m.crushed = larger(0.0, s.depth - larger(0.0, m.elastic - h * s.speed_n));
  m.pressed_side = s.side;
  return corner_pressure(s.law, s.depth - m.crushed, s.speed_n);
}

/// An ongoing contact whose touching corner changes goes on: a corner that enters in the substep in which another corner
/// of the pair leaves takes over its spring.
GEM_HD inline void hand_over(SubPoint* points, int count, const CornerMemory& left) {
  for (int k = 0; k < count; ++k) {
    SubPoint& s = points[k];
    if (!s.overlaps || !s.entered) continue;
    const double elastic = left.elastic * smaller(1.0, left.stiffness / s.law.stiffness);
    s.memory.crushed = larger(0.0, s.depth - elastic);
    s.memory.stretch = left.stretch;
    s.trial = corner_pressure(s.law, s.depth - s.memory.crushed, s.speed_n);
    return;
  }
}

/// Longest distance between the crossings of a pair: the chord of the overlap [m].
GEM_HD inline double chord_of(const SubPoint* points, int count) {
  double longest = 0.0;
  const std::int32_t base = points[0].p;
  const Vec2 to_first = points[0].between;
  for (int i = 0; i < count; ++i) {
    if (!points[i].overlaps) continue;
    for (int j = i; j < count; ++j) {
      if (!points[j].overlaps) continue;
      // crossings are told from the centroid of their own p, which is one of two bodies
      const Vec2 shift = points[i].p == points[j].p ? Vec2{} : points[i].p == base ? to_first : -to_first;
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) {
          const Vec2 d = points[i].crossing[k] - points[j].crossing[l] + shift;
          longest = larger(longest, dot(d, d));
        }
    }
  }
  return std::sqrt(longest);
}

/// Forces of one pair in a substep of length h [s].
GEM_HD inline void press_pair(SubPair& pair, SubPoint* all, const SubBody* bodies, double h) {
  SubPoint* const points = all + pair.first;
  int inside = 0;
  CornerMemory left;
  for (int k = 0; k < pair.count; ++k) {
    SubPoint& s = points[k];
    const bool overlapped = s.overlaps;
    s.overlaps = touch(s, bodies[s.p], bodies[s.q]);
    s.entered = s.overlaps && !overlapped;
    inside += s.overlaps;
    if (s.overlaps) s.trial = try_corner(s, h);
    if (!s.overlaps && overlapped) {
      if (s.memory.normal > left.normal) left = s.memory;
      leave(s, h);
    }
  }
  if (inside == 0) return;
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
      if (points[k].overlaps) find_crossings(points[k], bodies[points[k].p], bodies[points[k].q]);
    chord = chord_of(points, pair.count);
    const double bound = chord > 0.0 ? pair.bound * strict::power(chord, pair.exponent) : 0.0;
    if (sum > bound) share = bound / sum;
  }
  for (int k = 0; k < pair.count; ++k) {
    SubPoint& s = points[k];
    if (s.overlaps) press(s, bodies[s.q], share * s.trial, share < 1.0, h);
  }
  if (share * sum > pair.largest_force) {
    pair.largest_force = share * sum;
    pair.chord = chord;
    pair.depth = depth;
    pair.corners = inside;
  }
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
GEM_HD inline void set_turn(SubBody& b, double turn) {
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

/// Impulses of the contacts on a floe, its other loads and its motion over a substep. All work with the mean velocity of
/// the substep: one after the other they would seem to give and take energy where a floe rests.
GEM_HD inline void move(SubBody& b, Vec2 impulse, double twist, double h) {
  const Vec2 velocity = b.velocity;
  const double spin = b.spin;
  b.velocity += b.inverse_mass * impulse;
  b.velocity += b.kick;
  b.spin += b.inverse_inertia * twist;
  b.spin += b.kick_spin;
  const Vec2 mean = 0.5 * (velocity + b.velocity);
  const double mean_spin = 0.5 * (spin + b.spin);
  b.contact_work += dot(impulse, mean) + twist * mean_spin;
  b.kick_work += b.mass * dot(b.kick, mean) + b.inertia * b.kick_spin * mean_spin;
  b.shift_sum += b.shift;
  b.shift += h * b.velocity;
  set_turn(b, b.turn + h * b.spin);
}

}  // namespace gem
