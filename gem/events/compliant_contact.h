// Compliant contact: the force of one corner that overlaps another outline. Ice springs, and crushes where it is loaded
// beyond its crushing pressure.
//
//   normal      f = max(0, k e - c u_n)  where e > 0, else 0      e = d - d_c       spring and dashpot
//               F = f min(1, B / sum of f)                                          bound by crushing
//               B = P0 (h w)^(1+ex)                                                 of all corners of the pair together
//   memory      F < f:  d_c' = max(d_c, d - F / k)                                  crushed ice does not spring back
//   friction    s' = u_t, within +- mu F / k
//               F_t = -(k s + c u_t), within +- mu F
//
//   d    depth of the corner: its distance from the nearest side of the other outline [m]
//   d_c  depth to which the ice in front of the corner is crushed [m]; 0 when the corner no longer overlaps
//   s    tangential stretch [m]; 0 where F is
//   u_n  speed of the corner along the outward normal of that side, relative to it [m/s]; < 0: closing
//   u_t  speed along the tangent, the normal turned left [m/s]
//   k    K / 2 of every corner, K the stiffness of a face on a face [N/m]. So a lone corner has half a face
//   K    E h of ice, h the thickness of the thinner floe: a wall and a structure are rigid beside ice. Two bodies that
//        are both no ice have a stiffness of their own and no bound
//   c    damping [N s/m]: zeta sqrt(2 k m), so that zeta is the damping ratio of a face that moves straight
//   m    mass of the pair [kg], 1 / m = 1 / m_a + 1 / m_b
//   w    chord between the crossings of both outlines, at the present places [m]
//   P0 ex  pressure-area law, see crushing.h       mu  friction coefficient [-]
//
// What a hit takes from the motion comes out of it: crushed, damped and friction energy. The closed form of a crushing
// hit (crushing.h) is its limit for a large k.
//
// The rules keep it from creating energy: k does not depend on how many corners touch; spring and dashpot together, not
// the spring alone, meet Coulomb's limit; the stretch is held within mu F / k; B is that of the present overlap, of
// corners and of faces alike; k does not rise while the spring of a corner is stretched (the stability limit is of the
// scene, not of the ice, and may change); where a corner comes in from beside or presses another side than before, its
// spring has changed by its own motion alone, whatever its depth.
//
// Source: our own. ICETECH 2014 names both parts, "ice crushing impact forces and steady elastic stresses", without
// formulas. Valid for overlaps that are small beside the floes. Neglected: that a corner of steel which slides along a
// floe carries its crushed depth with it; bending, rafting, splitting.
#pragma once

#include <cmath>
#include <cstdint>

#include "gem/base/choose.h"
#include "gem/base/macros.h"
#include "gem/base/pack.h"
#include "gem/events/contact_def.h"

namespace gem {

/// What a corner keeps while it overlaps the other body of its pair.
struct CornerMemory {
  double crushed = 0.0;    // d_c [m]
  double stretch = 0.0;    // s [m]
  double stiffness = 0.0;  // k as it was when the corner was last loaded [N/m]
  // of the last force, for the books: the work of a substep is the mean of the forces before and after it
  double elastic = 0.0;            // e [m]
  double normal = 0.0;             // F [N]
  double side = 0.0;               // F_t [N]
  std::int64_t pressed_side = -1;  // of the other body; 64 bits leave no gap in the record
};

/// Spring, dashpot and friction of a corner.
template <class Real>
struct alignas(sizeof(Real)) CornerLawOf {
  Real stiffness{};  // k [N/m]
  Real damping{};    // c [N s/m]
  Real friction{};   // mu [-]
};
using CornerLaw = CornerLawOf<double>;

/// Stiffness of one corner of a pair [N/m]. `thickness` of the thinner floe [m]; `ice`: one of both bodies is a floe.
GEM_HD inline double corner_stiffness(const ContactDef& def, double thickness, bool ice) {
  return 0.5 * (ice ? def.face_stiffness_Pa * thickness : def.structure_stiffness_N_per_m);
}

/// Damping of one corner [N s/m]. `inverse_mass` is 1/m_a + 1/m_b [1/kg].
GEM_HD inline double corner_damping(const ContactDef& def, double stiffness, double inverse_mass) {
  return def.damping_ratio * std::sqrt(2.0 * stiffness / inverse_mass);
}

/// Force of spring and dashpot alone [N]. `elastic` is d - d_c [m].
template <class Real>
GEM_HD GEM_INLINE Real corner_pressure(const CornerLawOf<Real>& law, Real elastic, Real u_n) {
  return pick(elastic > 0.0, larger(Real{}, law.stiffness * elastic - law.damping * u_n), Real{});
}

/// d_c after a force that crushing has bound to `force` [m].
template <class Real>
GEM_HD GEM_INLINE Real crushed_depth(const CornerLawOf<Real>& law, Real crushed, Real depth, Real force) {
  return larger(crushed, depth - force / law.stiffness);
}

/// Stretch after the corner has slid by `slid` [m] under the force `force` [N].
template <class Real>
GEM_HD GEM_INLINE Real corner_stretch(const CornerLawOf<Real>& law, Real stretch, Real slid, Real force) {
  const Real most = law.friction * force / law.stiffness;
  return smaller(larger(stretch + slid, -most), most);
}

/// Friction on the corner along the tangent [N].
template <class Real>
GEM_HD GEM_INLINE Real corner_friction(const CornerLawOf<Real>& law, Real stretch, Real u_t, Real force) {
  const Real most = law.friction * force;
  return smaller(larger(-(law.stiffness * stretch + law.damping * u_t), -most), most);
}

/// Limits of stiffness and damping for explicit substeps of length h (symplectic Euler):
///
///     k <= kappa^2 / (h^2 q),   c <= (1 - k h^2 q) / (h q)
///
/// q is the larger of both compliances of a corner, along the normal and the tangent, with the mass of each body
/// divided among its corners [1/kg]. All springs of a scene together then have eigenvalues h^2 M^-1 K up to 2 kappa^2,
/// and a hit gains no energy while k h^2 q + c h q <= 1.
inline constexpr double stable_kappa = 0.8;

/// The law within those limits.
GEM_HD inline CornerLaw stable_law(const CornerLaw& law, double h, double q) {
  const double stiffness = smaller(law.stiffness, stable_kappa * stable_kappa / (h * h * q));
  return {stiffness, smaller(law.damping, (1.0 - stiffness * h * h * q) / (h * q)), law.friction};
}

}  // namespace gem
