// Splitting of a floe in its plane by the force of a contact at its edge.
//
// A contact that presses towards the middle of a floe wedges its edge apart. A crack that begins at the contact runs
// across the floe if the force is larger than
//
//     F_split = P / w,     P = C h K sqrt(L),     C = max over a of sqrt(pi a) / (2 g(a)) = 0.2254
//     g(a) = 3.52 (1 - a)^(-3/2) - 4.35 (1 - a)^(-1/2) + 2.13 (1 - a)
//     E_crack = K^2 / E h L
//
//   F_split  force of the contact along the crack at which the floe splits            [N]
//   P        pair of forces at the mouth of the crack that opens it                   [N]
//   w        P / F: how much of the contact force opens the crack [-]
//            1 / (2 tan t) for a wedge of half angle t without friction
//   h, L     thickness of the floe, its length along the crack [m]
//   K        fracture toughness of the ice [Pa sqrt(m)]
//   E        elastic modulus of the ice [Pa]
//   a        depth of the crack over L; the largest P is at a = 0.21 [-]
//   E_crack  energy that the new faces take, plane stress [J]
//
// A short crack first grows only if the force rises. From a = 0.21 on a falling force is enough, so the crack runs
// through: its speed is of another scale than that of floes, and the floe is in two pieces at once.
//
// Source: linear elastic fracture mechanics of a floe that splits: Bhat (1988), Bhat, Choi, Wierzbicki and Karr (1991),
// Lu, Lubbad and Loset (2015), all with F ~ h K sqrt(L). g: stress intensity K_I = 2 P / (h sqrt(pi a L)) g(a) of an
// edge crack with a pair of forces at its mouth, Tada, Paris and Irwin, The Stress Analysis of Cracks Handbook. It has
// both exact limits: 1.30 for short cracks, and bending of a ligament, 3.97 P L / (h (L - aL)^(3/2)), for deep ones.
// Range: floes much wider than thick, K constant, a brittle crack: loads that last from 0.1 s to minutes.
// Neglected: the width of the floe across the crack (a narrow floe splits at a smaller force), cracks that curve,
// bending out of the plane, inertia while the crack runs, and that floes split by tension across a flat face, which
// needs a larger force (w about 0.1).
#pragma once

#include <cmath>
#include <cstdint>

namespace gem {

/// Settings of floes that split. Floes do not split if there are no pieces.
struct BreakupDef {
  std::int64_t maximum_pieces = 0;              ///< most pieces that are made in a run, two for each split
  double fracture_toughness_Pa_sqrt_m = 115e3;  ///< K
  double elastic_modulus_Pa = 5e9;              ///< E, for the energy of the crack
  double wedge_ratio = 0.5;                     ///< w
  double load_time_s = 1.0;                     ///< a floe splits by the mean force over this time
  double minimum_size_m = 5.0;                  ///< no piece is smaller: size = sqrt(area)
};

/// C of F_split: the largest opening pair over the depth of the crack [-].
inline constexpr double splitting_coefficient = 0.22541976777957312;

/// g(a): the stress intensity of an edge crack of depth a over that in a half plane without the constant [-].
inline double crack_mouth_factor(double a) {
  const double rest = 1.0 - a;
  return 3.52 / (rest * std::sqrt(rest)) - 4.35 / std::sqrt(rest) + 2.13 * rest;
}

/// F_split [N] of a floe of a thickness [m] and a length along the crack [m].
inline double splitting_force(const BreakupDef& def, double thickness, double length) {
  return splitting_coefficient / def.wedge_ratio * thickness * def.fracture_toughness_Pa_sqrt_m * std::sqrt(length);
}

/// E_crack [J].
inline double crack_energy(const BreakupDef& def, double thickness, double length) {
  const double toughness = def.fracture_toughness_Pa_sqrt_m;
  return toughness * toughness / def.elastic_modulus_Pa * thickness * length;
}

}  // namespace gem
