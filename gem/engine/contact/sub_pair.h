// A pair of bodies in the substeps: its corners share one bound of crushing. No iteration, no order: every corner reads
// the same places and velocities, every body sums its own pairs.
#pragma once

#include "gem/base/short_power.h"
#include "gem/engine/contact/sub_body.h"
#include "gem/engine/contact/sub_corner.h"

namespace gem {

/// Two bodies, and the corners that one of them may have in the other. Sums are those of the time step; places are told
/// from a's centroid at its start.
template <class Real>
struct alignas(sizeof(Real)) SubPair {
  std::int32_t first = 0, count = 0;  // corners
  Real bound{};                       // P0 h^(1+ex): crushing force on a chord of 1 m [N]; < 0: no ice
  Real half_exponent{};               // (1 + ex) / 2
  VecOf<Real> impulse, normal_part;   // on b [N s]
  Real moment{}, twist_a{};           // of the impulse on b, about the origin; of that on a, about its centroid [N m s]
  Real pressed{};                     // sum of the normal forces, times h [N s]
  Real softened{};                    // part of it with less than half the stiffness of the ice [N s]
  VecOf<Real> point;                  // places, times `pressed` [m N s]
  Real deepest{}, most_elastic{};     // [m]
  ContactWorkOf<Real> work;
  // largest normal force in a substep, and then: the chord squared, the depth, how many corners overlapped
  Real largest_force{}, chord_2{}, depth{}, corners{};
};

/// What a pair gives in a substep.
template <class Real>
struct alignas(sizeof(Real)) PairPushOf {
  MaskOf<Real> presses{};
  VecOf<Real> impulse;  // on b [N s]
  Real twist_a{}, twist_b{};
};

/// From a's centroid at the start to the corner [m].
template <class Real>
GEM_HD GEM_INLINE VecOf<Real> corner_place(const SubCorner<Real>& c, const MotionOf<Real>& p) {
  return pick(c.of_b, c.between, VecOf<Real>{}) + p.shift + c.arm_p;
}

/// An ongoing contact whose touching corner changes goes on: a corner that enters in the substep in which another
/// corner of the pair leaves takes over its spring.
template <class Real>
GEM_HD GEM_INLINE void hand_over(SubCorner<Real>* corners, int count, const SubMemory<Real>& left,
                                 ContactWorkOf<Real>& work) {
  auto wanted = left.normal > 0.0;
  for (int k = 0; k < count; ++k) {
    SubCorner<Real>& c = corners[k];
    const auto takes = both(wanted, both(c.overlaps, c.entered));
    wanted = but_not(wanted, takes);
    const Real share = smaller(Real{} + 1.0, left.stiffness / c.law.stiffness);
    SubMemory<Real> m = left;
    m.pressed_side = c.memory.pressed_side;
    m.stiffness = c.law.stiffness;
    m.elastic = smaller(c.depth, share * left.elastic);
    m.stretch = share * left.stretch;
    m.crushed = c.depth - m.elastic;
    c.memory = pick(takes, m, c.memory);
    const Real stored = pick(takes, 0.5 * m.stiffness * (m.elastic * m.elastic + m.stretch * m.stretch), Real{});
    work.stored += stored;
    work.damped -= stored;
    c.trial = pick(takes, corner_pressure(c.law, m.elastic, c.speed_n), c.trial);
  }
}

/// Places every corner and tries its spring. Returns where a corner of the pair overlaps.
template <class Real>
GEM_HD GEM_INLINE MaskOf<Real> place_corners(SubPair<Real>& pair, SubCorner<Real>* corners, const SubSide<Real>* sides,
                                             const MotionOf<Real>& a, const MotionOf<Real>& b, MaskOf<Real> looked,
                                             Real h) {
  MaskOf<Real> presses{}, any_left{};
  SubMemory<Real> last;
  for (int k = 0; k < pair.count; ++k) {
    SubCorner<Real>& c = corners[k];
    const CornerPlace<Real> place = place_of(c, sides, pick(c.of_b, b, a), pick(c.of_b, a, b));
    const MaskOf<Real> overlaps = both(looked, place.overlaps), left = but_not(c.overlaps, overlaps);
    if (any(left)) {
      last = pick(both(left, c.memory.normal > last.normal), c.memory, last);
      leave(c, left, h, pair.work);
      any_left = any_left | left;
    }
    c.entered = but_not(overlaps, c.overlaps);
    c.overlaps = overlaps;
    c.acted = c.acted | overlaps;
    c.depth = place.depth;
    c.speed_n = place.speed_n;
    c.speed_t = place.speed_t;
    c.axis = place.axis;
    c.arm_p = place.arm_p;
    c.arm_q = place.arm_q;
    c.at = place.at;
    try_corner(c, place.side, h);
    presses = presses | overlaps;
  }
  if (any(both(any_left, presses))) hand_over(corners, pair.count, last, pair.work);
  return presses;
}

/// Square of the longest distance between the crossings of a pair: the chord of the overlap [m2].
template <class Real>
GEM_HD GEM_INLINE Real chord_squared(const SubPair<Real>& pair, SubCorner<Real>* corners, const SubSide<Real>* sides,
                                     const MotionOf<Real>& a, const MotionOf<Real>& b) {
  Real longest{};
  for (int i = 0; i < pair.count; ++i) {
    SubCorner<Real>& c = corners[i];
    const MotionOf<Real> p = pick(c.of_b, b, a), q = pick(c.of_b, a, b);
    find_crossings(c, sides, p, q);
    const VecOf<Real> place = corner_place(c, p);
    for (int k = 0; k < 2; ++k) c.crossing[k] += place;
    for (int j = 0; j <= i; ++j) {
      const auto overlap = both(c.overlaps, corners[j].overlaps);
      for (int k = 0; k < 2; ++k)
        for (int l = 0; l < 2; ++l) {
          const VecOf<Real> d = c.crossing[k] - corners[j].crossing[l];
          longest = larger(longest, pick(overlap, dot(d, d), Real{}));
        }
    }
  }
  return longest;
}

/// Adds what a corner gives under the normal force `force` [N].
template <class Real>
GEM_HD GEM_INLINE void add_corner(const SubCorner<Real>& c, VecOf<Real> place, Real force, Real h, SubPair<Real>& pair,
                                  PairPushOf<Real>& push) {
  const Real pressed = h * force;
  const VecOf<Real> normal_part = pressed * c.axis;
  const VecOf<Real> impulse = normal_part + (h * c.memory.side) * turned_left(c.axis);
  const Real twist_p = cross(c.arm_p, impulse), twist_q = -cross(c.arm_q, impulse);
  const Real sign = pick(c.of_b, Real{} + 1.0, Real{} - 1.0);
  const VecOf<Real> on_b = sign * impulse;
  push.impulse += on_b;
  const Real twist_a = pick(c.of_b, twist_q, twist_p);
  push.twist_a += twist_a;
  push.twist_b += pick(c.of_b, twist_p, twist_q);
  pair.impulse += on_b;
  pair.normal_part += sign * normal_part;
  pair.moment += cross(place, on_b);
  pair.twist_a += twist_a;
  pair.pressed += pressed;
  pair.softened += pick(c.law.stiffness < 0.5 * c.full_stiffness, pressed, Real{});
  pair.point += pressed * place;
  pair.deepest = larger(pair.deepest, pick(c.overlaps, c.depth, Real{}));
  pair.most_elastic = larger(pair.most_elastic, c.memory.elastic);
}

/// Forces of a pair in a substep of length h [s]. `looked`: it may overlap.
template <class Real>
GEM_HD GEM_INLINE PairPushOf<Real> press_pair(SubPair<Real>& pair, SubCorner<Real>* corners, const SubSide<Real>* sides,
                                              const MotionOf<Real>& a, const MotionOf<Real>& b, MaskOf<Real> looked,
                                              Real h) {
  PairPushOf<Real> push;
  push.presses = place_corners(pair, corners, sides, a, b, looked, h);
  if (!any(push.presses)) return push;
  Real sum{}, depth{}, inside{};
  for (int k = 0; k < pair.count; ++k) {
    sum += corners[k].trial;
    depth = larger(depth, pick(corners[k].overlaps, corners[k].depth, Real{}));
    inside += pick(corners[k].overlaps, Real{} + 1.0, Real{});
  }
  const Real chord_2 = chord_squared(pair, corners, sides, a, b);
  const Real most = pick(chord_2 > 0.0, pair.bound * strict::short_power(chord_2, pair.half_exponent), Real{});
  const auto crushes = both(pair.bound >= 0.0, sum > most);
  const Real share = pick(crushes, most / sum, Real{} + 1.0);
  for (int k = 0; k < pair.count; ++k) {
    SubCorner<Real>& c = corners[k];
    const Real force = share * c.trial;
    load(c, force, both(c.overlaps, crushes), h, pair.work);
    add_corner(c, corner_place(c, pick(c.of_b, b, a)), force, h, pair, push);
  }
  const Real whole = share * sum;
  const auto larger_now = whole > pair.largest_force;
  pair.largest_force = pick(larger_now, whole, pair.largest_force);
  pair.chord_2 = pick(larger_now, chord_2, pair.chord_2);
  pair.depth = pick(larger_now, depth, pair.depth);
  pair.corners = pick(larger_now, inside, pair.corners);
  return push;
}

}  // namespace gem
