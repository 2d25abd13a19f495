// Wind on floes and on the platform, quadratic in the wind as the body feels it.
//
//   floe       m dv/dt = rho_a (C_f W F / 2 + C_s A) |w| w,   w = U_a - v,   which is   dw/dt = -k |w| w
//   platform   M dv/dt = rho_a C_p A_p / 2 |w| w
//
//   U_a   wind 10 m above the ice [m/s]         v    velocity of the body [m/s]      rho_a  density of the air [kg/m3]
//   C_s   skin drag on the area A [-], [m2]     C_f  form drag on W F [-]            W      sqrt(A) [m]
//   F     freeboard, h (1 - rho_i / rho_w) [m]  h    thickness [m]                   m, M   masses [kg]
//   C_p   drag coefficient of the platform on its projected area above the water A_p [-], [m2]
//
// Each equation has the solution of current_drag.h. Source of the stress: Leppaeranta, The Drift of Sea Ice (Springer,
// 2011); with the water's drag it gives the wind factor v / U_a = sqrt(rho_a C_s / (rho_w C_w)) = 0.02 (Nansen's rule).
// Range: C_s from 1e-3 (smooth ice) to 4e-3 (ridged ice). Neglected: gusts, lee of a neighbour, torque, spin.
#pragma once

#include <cmath>

#include "gem/base/vec2.h"
#include "gem/events/current_drag.h"

namespace gem {

/// The wind has the same velocity everywhere. Without wind it is zero.
struct WindDef {
  Vec2 velocity_m_per_s = {0.0, 0.0};
  double density_kg_per_m3 = 1.3;  ///< of the air at 0 degrees Celsius
  double skin_coefficient = 2e-3;  ///< C_s, on the area of a floe
  double form_coefficient = 0.0;   ///< C_f, on sqrt(area) x freeboard of a floe
  double platform_coefficient = 1.0;
  double platform_area_m2 = 0.0;  ///< projected area of the platform above the water; 0: no wind on it
};

/// k of a floe of `thickness` [m], `area` [m2] and `mass` [kg]; `freeboard`: its share of the thickness [-] [1/m].
GEM_HD inline double floe_wind_rate(const WindDef& wind, double freeboard, double thickness, double area, double mass) {
  const double form = 0.5 * wind.form_coefficient * std::sqrt(area) * (freeboard * thickness);
  return wind.density_kg_per_m3 * (form + wind.skin_coefficient * area) / mass;
}

/// The rate of the platform [1/m].
GEM_HD constexpr double platform_wind_rate(const WindDef& wind, double mass) {
  return 0.5 * wind.density_kg_per_m3 * wind.platform_coefficient * wind.platform_area_m2 / mass;
}

/// Velocity of a body after `dt` seconds of wind alone; `rate` is its k [1/m].
GEM_HD inline Vec2 blown(double rate, Vec2 velocity, Vec2 air, double dt) {
  const Vec2 felt = air - velocity;
  return air - (1.0 / (1.0 + drag_reach(rate, length(felt), dt))) * felt;
}

}  // namespace gem
