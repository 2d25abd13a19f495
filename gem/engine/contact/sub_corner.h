// A corner in the substeps: where it is, and what it gives. Written for numbers and for packs of corners side by side
// (pack.h): a lane whose corner does not overlap gives zero.
//
// A corner belongs to one body of a pair, p, and acts on the other, q. It is looked at in the axes of q. Forces and
// impulses are those on p; q gets the opposite.
#pragma once

#include <cstdint>

#include "gem/base/choose.h"
#include "gem/base/pack.h"
#include "gem/base/vec_of.h"
#include "gem/engine/contact/corners.h"
#include "gem/events/compliant_contact.h"

namespace gem {

template <class Real>
using MaskOf = decltype(Real{} < Real{});

/// Place and speed of a body since the start of the time step, see SubMotion.
template <class Real>
struct alignas(sizeof(Real)) MotionOf {
  VecOf<Real> shift;
  Real cosine{}, sine{};
  VecOf<Real> velocity;
  Real spin{};
};

/// Turns `x` as the body has turned.
template <class Real>
GEM_HD GEM_INLINE VecOf<Real> turned_with(const MotionOf<Real>& m, VecOf<Real> x) {
  return {m.cosine * x.x - m.sine * x.y, m.sine * x.x + m.cosine * x.y};
}
/// A vector of the world in the axes that the body had at the start.
template <class Real>
GEM_HD GEM_INLINE VecOf<Real> in_axes_of(const MotionOf<Real>& m, VecOf<Real> x) {
  return {m.cosine * x.x + m.sine * x.y, m.cosine * x.y - m.sine * x.x};
}
template <class Mask, class Real>
GEM_HD GEM_INLINE MotionOf<Real> pick(Mask mask, const MotionOf<Real>& a, const MotionOf<Real>& b) {
  return {pick(mask, a.shift, b.shift), pick(mask, a.cosine, b.cosine), pick(mask, a.sine, b.sine),
          pick(mask, a.velocity, b.velocity), pick(mask, a.spin, b.spin)};
}

/// A side of q at the start of the time step. A lane that has no such side has a side at infinity.
template <class Real>
struct alignas(sizeof(Real)) SubSide {
  VecOf<Real> normal;
  Real offset = Real{} + 1e300;  // along the normal, from the centroid [m]
  Real role{};                   // one of side_role
};
namespace side_role {
constexpr double bounds = 0.0;  // is inside another piece of the body: no surface
constexpr double shows = 1.0;
constexpr double meets = 2.0;  // shows, and the corner can have come through it
}  // namespace side_role

/// CornerMemory of lanes.
template <class Real>
struct alignas(sizeof(Real)) SubMemory {
  Real crushed{}, stretch{}, stiffness{}, elastic{}, normal{}, side{};
  Real pressed_side = Real{} - 1.0;
};
template <class Mask, class Real>
GEM_HD GEM_INLINE SubMemory<Real> pick(Mask mask, const SubMemory<Real>& a, const SubMemory<Real>& b) {
  return {
      pick(mask, a.crushed, b.crushed),          pick(mask, a.stretch, b.stretch), pick(mask, a.stiffness, b.stiffness),
      pick(mask, a.elastic, b.elastic),          pick(mask, a.normal, b.normal),   pick(mask, a.side, b.side),
      pick(mask, a.pressed_side, b.pressed_side)};
}

template <class Real>
struct alignas(sizeof(Real)) SubCorner {
  VecOf<Real> corner;                 // from p's centroid at the start [m]
  VecOf<Real> between;                // from q's centroid to p's at the start [m]
  VecOf<Real> flank[2];               // to the neighbour corners at the start [m]
  MaskOf<Real> of_b{};                // p is b of the pair, else a
  std::int32_t first = 0, sides = 0;  // of q
  Real first_side{};                  // of this piece of the platform, among all
  CornerLawOf<Real> law{Real{} + 1.0};
  Real full_stiffness{};               // of the ice; the law may have less [N/m]
  MaskOf<Real> overlaps{}, entered{};  // entered: it did not overlap in the last substep
  MaskOf<Real> acted{};                // it has overlapped in this time step
  SubMemory<Real> memory;
  // of this substep, where it overlaps
  Real depth{}, speed_n{}, speed_t{};  // [m], [m/s]
  Real trial{};                        // force of spring and dashpot [N]
  VecOf<Real> axis;                    // outward normal of the pressed side
  VecOf<Real> arm_p, arm_q;            // to the corner [m]
  VecOf<Real> at;                      // the corner in q's axes, from its centroid [m]
  VecOf<Real> crossing[2];             // of both outlines, on the flanks, see find_crossings() [m]
};

/// Energy of contacts since the start of the time step [J]; stored: at present. Losses are > 0.
template <class Real>
struct alignas(sizeof(Real)) ContactWorkOf {
  Real stored{}, crushed{}, damped{}, friction{};
};

/// A corner is inside where all sides lie beyond it. Where two corners are side by side, as those of aligned faces, the
/// one of the pair's second body presses: it counts as inside up to this distance beyond another side, the other one
/// only that far within [m].
inline constexpr double tie = 1e-9;

/// Depth, speeds and pressed side at the present places.
template <class Real>
struct alignas(sizeof(Real)) CornerPlace {
  MaskOf<Real> overlaps;
  Real depth, side, speed_n, speed_t;
  VecOf<Real> axis, arm_p, arm_q, at;
};
template <class Real>
GEM_HD GEM_INLINE CornerPlace<Real> place_of(const SubCorner<Real>& c, const SubSide<Real>* sides,
                                             const MotionOf<Real>& p, const MotionOf<Real>& q) {
  CornerPlace<Real> place;
  place.arm_p = turned_with(p, c.corner);
  place.arm_q = c.between + (p.shift - q.shift) + place.arm_p;
  place.at = in_axes_of(q, place.arm_q);
  Real nearest = Real{} - 1e300, others = Real{} - 1e300, side{};
  VecOf<Real> normal;
  for (std::int32_t j = 0; j < c.sides; ++j) {
    const SubSide<Real>& one = sides[c.first + j];
    const Real distance = dot(one.normal, place.at) - one.offset;
    const auto nearer = both(one.role == side_role::meets, distance > nearest);
    others = larger(others, pick(nearer, nearest, distance));
    nearest = pick(nearer, distance, nearest);
    normal = pick(nearer, one.normal, normal);
    side = pick(nearer, Real{} + static_cast<double>(j), side);
  }
  place.overlaps = both(nearest < 0.0, others < pick(c.of_b, Real{} + tie, Real{} - tie));
  place.depth = -nearest;
  place.side = c.first_side + side;
  place.axis = turned_with(q, normal);
  const VecOf<Real> u = p.velocity + cross(p.spin, place.arm_p) - q.velocity - cross(q.spin, place.arm_q);
  place.speed_n = dot(u, place.axis);
  place.speed_t = dot(u, turned_left(place.axis));
  return place;
}

/// The crossings of both outlines on the two sides that end in the corner, from the corner [m].
template <class Real>
GEM_HD GEM_INLINE void find_crossings(SubCorner<Real>& c, const SubSide<Real>* sides, const MotionOf<Real>& p,
                                      const MotionOf<Real>& q) {
  const VecOf<Real> flank[2] = {turned_with(p, c.flank[0]), turned_with(p, c.flank[1])};
  const VecOf<Real> in_q[2] = {in_axes_of(q, flank[0]), in_axes_of(q, flank[1])};
  // a side is crossed after the share room / rise of a flank
  Real room[2] = {Real{} + 1.0, Real{} + 1.0}, rise[2] = {Real{} + 1.0, Real{} + 1.0};
  for (std::int32_t j = 0; j < c.sides; ++j) {
    const SubSide<Real>& one = sides[c.first + j];
    const Real room_j = one.offset - dot(one.normal, c.at);
    for (int k = 0; k < 2; ++k) {
      const Real rise_j = dot(one.normal, in_q[k]);
      const auto sooner = both(both(one.role >= side_role::shows, rise_j > 0.0), room_j * rise[k] < room[k] * rise_j);
      room[k] = pick(sooner, room_j, room[k]);
      rise[k] = pick(sooner, rise_j, rise[k]);
    }
  }
  for (int k = 0; k < 2; ++k) c.crossing[k] = larger(Real{}, room[k] / rise[k]) * flank[k];
}

/// Where a corner no longer overlaps it ends its contact: what was stored and the last force did not give back is lost,
/// and other ice is in front of it when it comes back.
template <class Real>
GEM_HD GEM_INLINE void leave(SubCorner<Real>& c, MaskOf<Real> left, Real h, ContactWorkOf<Real>& work) {
  const SubMemory<Real>& m = c.memory;
  const Real stored = 0.5 * m.stiffness * (m.elastic * m.elastic + m.stretch * m.stretch);
  work.damped += pick(left, stored - 0.5 * h * m.normal * c.speed_n, Real{});
  work.friction -= pick(left, 0.5 * h * m.side * c.speed_t, Real{});
  work.stored -= pick(left, stored, Real{});
  c.memory = pick(left, SubMemory<Real>{}, m);
}

/// Spring and dashpot of a corner. Where it has entered, or presses another side than before, its spring has changed by
/// its motion of the last substep alone: the rest of its depth came from beside, or a contact was found late.
template <class Real>
GEM_HD GEM_INLINE void try_corner(SubCorner<Real>& c, Real side, Real h) {
  SubMemory<Real>& m = c.memory;
  const Real fresh = larger(Real{}, c.depth - larger(Real{}, m.elastic - h * c.speed_n));
  m.crushed = pick(but_not(c.overlaps, side == m.pressed_side), fresh, m.crushed);
  m.pressed_side = pick(c.overlaps, side, m.pressed_side);
  c.trial = pick(c.overlaps, corner_pressure(c.law, c.depth - m.crushed, c.speed_n), Real{});
}

/// Books the work since the last force of the corner: means of the forces before and after, times what sprang, crushed
/// and slid between. `closed` and `slid`: motion of the last substep, across and along the side [m].
template <class Real>
GEM_HD GEM_INLINE void book_corner(SubMemory<Real>& now, const SubMemory<Real>& before, Real k, Real elastic,
                                   Real closed, Real slid, ContactWorkOf<Real>& work) {
  // a stiffness that has fallen since the corner was last loaded takes energy with it
  const Real k_before = smaller(before.stiffness, k);
  const Real had = before.elastic * before.elastic + before.stretch * before.stretch;
  const Real lost = 0.5 * (before.stiffness - k_before) * had;
  const Real spring = 0.5 * (k_before * before.elastic + k * elastic);
  const Real dashpot = 0.5 * (before.normal - k_before * before.elastic + now.normal - k * elastic);
  const Real pull = 0.5 * (k_before * before.stretch + k * now.stretch);
  const Real drag = -0.5 * (before.side + k_before * before.stretch + now.side + k * now.stretch);
  work.crushed += spring * (now.crushed - before.crushed);
  work.damped += dashpot * closed + lost;
  work.friction += pull * (slid - (now.stretch - before.stretch)) + drag * slid;
  work.stored += 0.5 * k * (elastic * elastic + now.stretch * now.stretch) - 0.5 * k_before * had - lost;
  now.elastic = elastic;
  now.stiffness = k;
}

/// What a corner remembers after a normal force, which crushing has bound to it where `crushes` [N].
template <class Real>
GEM_HD GEM_INLINE void load(SubCorner<Real>& c, Real force, MaskOf<Real> crushes, Real h, ContactWorkOf<Real>& work) {
  const SubMemory<Real> before = c.memory;
  SubMemory<Real> m = before;
  m.crushed = pick(crushes, crushed_depth(c.law, m.crushed, c.depth, force), m.crushed);
  const Real slid = h * c.speed_t;
  m.normal = force;
  m.stretch = corner_stretch(c.law, m.stretch, slid, force);
  m.side = corner_friction(c.law, m.stretch, c.speed_t, force);
  const Real elastic = pick(c.overlaps, larger(Real{}, c.depth - m.crushed), Real{});
  book_corner(m, before, pick(c.overlaps, c.law.stiffness, Real{}), elastic, -h * c.speed_n, slid, work);
  c.memory = pick(c.overlaps, m, before);
}

}  // namespace gem
