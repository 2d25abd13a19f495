// Closed-form crushing of a power-law contact: depth, peak force and duration of an impact without rebound.
//
//   pressure   p = P0 A^ex,   A(z) = h w(z)       chord w grows with depth: w = min(g z, L)
//   force      F(z) = P0 (h w)^(1+ex)
//   corner     w = g z:  K = P0 (h g)^(1+ex), n = 2 + ex,  E(z) = K z^n / n,  z_m = (n E / K)^(1/n),  F_m = n E / z_m
//   flat       w = L:    F_m = P0 (h L)^(1+ex),            z_m = E / F_m
//   duration   t_c = (z_m / v) sqrt(pi) Gamma(1 + 1/n) / Gamma(1/2 + 1/n)   (to zero closing speed)
//
//   P0  pressure on 1 m2 [Pa]      ex  pressure-area exponent [-], -0.9 to 0.5; ice: -0.7 to 0      h  thickness [m]
//   g   chord growth, cot + cot of the angles between the chord and the two sides [-]; 0: a flat contact
//   L   longest possible chord [m]   E  crushing energy, m_e v^2 / 2 [J]          v  closing speed [m/s]
//
// Source: Popov 1967 with a pressure-area relation after Daley 1999. Valid for vertical sides. Neglected: splitting,
// bending, the rotation of the bodies during the event.
#pragma once

#include <cmath>

#include "gem/base/strict_math.h"

namespace gem {

struct IceDef {
  double density_kg_per_m3 = 900.0;
  double crushing_pressure_Pa = 2.5e6;  ///< P0: pressure on 1 m2
  double pressure_area_exponent = -0.1;
  double friction_ice = 0.35;        ///< floe on floe and floe on boundary
  double friction_structure = 0.10;  ///< floe on platform
};

/// The ice of a contact.
struct CrushingIce {
  double pressure = 0.0;   // P0 [Pa]
  double exponent = 0.0;   // ex [-]
  double thickness = 0.0;  // h [m]
};

struct CrushingPeak {
  double depth = 0.0;  // [m]
  double force = 0.0;  // [N]
};

/// Force on a chord of width w [N].
GEM_HD inline double crushing_force(const CrushingIce& ice, double width) {
  return ice.pressure * strict::power(ice.thickness * width, 1.0 + ice.exponent);
}

/// A bound that crushing_force() is never below, without a power: A^(-ex) <= 1 - ex (A - 1) for -1 < ex <= 0
/// (Bernoulli) [N].
GEM_HD constexpr double crushing_force_at_least(const CrushingIce& ice, double width) {
  constexpr double rounding = 1.0 - 1e-9;
  if (!(ice.exponent > -1.0 && ice.exponent <= 0.0)) return 0.0;
  const double area = ice.thickness * width;
  return rounding * ice.pressure * area / (1.0 - ice.exponent * (area - 1.0));
}

/// Peak of an event of energy `energy` [J] on a flat contact of width `width` [m].
GEM_HD inline CrushingPeak crushing_flat(const CrushingIce& ice, double width, double energy) {
  const double force = crushing_force(ice, width);
  return {force > 0.0 ? energy / force : 0.0, force};
}

/// Peak of an event of energy `energy` [J] on a corner whose chord grows by `growth` [-] per depth.
GEM_HD inline CrushingPeak crushing_corner(const CrushingIce& ice, double growth, double energy) {
  if (!(energy > 0.0)) return {};
  const double n = 2.0 + ice.exponent;
  const double stiffness = crushing_force(ice, growth);
  const double depth = strict::power(n * energy / stiffness, 1.0 / n);
  return {depth, n * energy / depth};
}

/// Peak of an event of energy `energy` [J] on a corner until its chord is `longest` [m], flat from there on. The chord
/// grows by `growth` [-] per depth; 0 stands for a flat contact.
GEM_HD inline CrushingPeak crushing_peak(const CrushingIce& ice, double growth, double longest, double energy) {
  if (!(growth > 0.0)) return crushing_flat(ice, longest, energy);
  const double corner_depth = longest / growth;
  const double corner_energy = crushing_force(ice, longest) * corner_depth / (2.0 + ice.exponent);
  if (energy <= corner_energy) return crushing_corner(ice, growth, energy);
  const CrushingPeak flat = crushing_flat(ice, longest, energy - corner_energy);
  return {corner_depth + flat.depth, flat.force};
}

/// Time from first contact to zero closing speed for F = K z^(n-1): n = 2 + ex for a corner, 1 for a flat contact [s].
/// No run calls it, since an event takes no time; the closed-form tests do. Host only: the gamma functions of the C
/// library are not bit-reproducible.
inline double crushing_duration(double depth, double closing_speed, double n) {
  const double gamma_ratio = std::exp(std::lgamma(1.0 + 1.0 / n) - std::lgamma(0.5 + 1.0 / n));
  return depth / closing_speed * std::sqrt(M_PI) * gamma_ratio;
}

}  // namespace gem
