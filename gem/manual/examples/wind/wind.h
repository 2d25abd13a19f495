// Wind on the top of a floe, steady and the same everywhere; exact over a time step of any length.
//
//   m dv/dt = rho_a C_a A |w| w,   w = W - v,   which is   dw/dt = -k |w| w   with   k = rho_a C_a A / m
//
//   v       velocity of the floe [m/s]               W   wind 10 m above the ice [m/s]
//   rho_a   density of the air [kg/m3]               w   wind as the floe feels it [m/s]
//   C_a     drag coefficient of that wind [-]        A   area of the floe [m2]        m   its mass [kg]
//
// The quadratic law of current_drag.h has the same equation, so its solution serves here. Source of the stress:
// Leppaeranta, The Drift of Sea Ice (Springer, 2011). Range: C_a from 1e-3 (smooth ice) to 4e-3 (ridged ice).
// Neglected: gusts, turn of the wind near the ice, lee of a neighbour, drag on ridges and edges, torque, the platform.
#pragma once

#include "gem/base/vec2.h"
#include "gem/events/current_drag.h"

namespace gem {

/// The wind has this velocity everywhere; none if it is zero.
struct WindDef {
  Vec2 velocity_m_per_s = {0.0, 0.0};
  double drag_coefficient = 2e-3;  ///< C_a
};

/// Air at 0 degrees Celsius [kg/m3].
constexpr double air_density = 1.3;

/// Whether there is any wind.
GEM_HD inline bool blows(const WindDef& wind) {
  return wind.velocity_m_per_s.x != 0.0 || wind.velocity_m_per_s.y != 0.0;
}

/// A floe after a time step in the wind.
struct WindPush {
  Vec2 velocity;         // [m/s]
  Vec2 path_correction;  // exact path minus velocity x dt [m]
};

/// `area` [m2], `mass` [kg], `velocity` [m/s] of the floe; `dt` [s].
GEM_HD inline WindPush wind_push(const WindDef& wind, double area, double mass, Vec2 velocity, double dt) {
  const double k = air_density * wind.drag_coefficient * area / mass;
  const Vec2 felt = wind.velocity_m_per_s - velocity;
  const DragSolution after = drag_quadratic(k, felt, length(felt), dt);
  return {wind.velocity_m_per_s - after.slip, -after.path_correction};
}

}  // namespace gem
