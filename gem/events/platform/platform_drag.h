// Water drag on the platform, quadratic in its velocity through the water: the same in all directions, or by axis.
//
//   round     dw/dt = -b |w| w,         b = rho_w C_D D T / (2 M)          w' = w / (1 + b |w| dt)
//   by axis   dw_k/dt = -b_k |w_k| w_k  for surge and sway, in the platform's axes
//             b_surge = rho_w C_surge B T / (2 M),   b_sway = rho_w C_sway L T / (2 M)
//             dr/dt = -b_yaw |r| r,     b_yaw = rho_w C_yaw T L^4 / (64 I)
//
//   w   platform velocity minus water velocity [m/s]     r  yaw rate [rad/s]     T  draft [m]
//   D   width across the platform's x axis [m]           L, B  length and width of the outline along and across it [m]
//   M   platform mass [kg]                               I  moment of inertia [kg m2]
//   C_D drag coefficient [-]: 0.5 to 1.0 for a short cylinder at full scale
//   C_surge [-]: 0.05 to 0.3 for a ship; the friction of its wetted surface alone (ITTC 1957) is 0.05 of B T
//   C_sway, C_yaw [-]: 0.5 to 1.0, the cross-flow coefficient of a section of B / 2T from 4 down to 0.8
//
// The yaw: a strip of the hull at x from the middle meets the water with r x. Its drag rho_w C T (r x)^2 / 2 has the
// arm x, and both halves of the length together give N = rho_w C T r^2 * integral_0^{L/2} x^3 dx = rho_w C T L^4 r^2
// / 64.
//
// Each solution is exact. By axis they act one after the other, with the axes frozen in the half time step. All is
// split symmetrically around the mooring. The reference paper does not say whether the water that damps the platform
// moves with the current, so both are offered; the water never turns.
//
// Sources of the law by axis: cross-flow principle with strips, Faltinsen, Sea Loads on Ships and Offshore Structures
// (1990), ch. 6; Fossen, Handbook of Marine Craft Hydrodynamics and Motion Control (2nd ed., 2021), ch. 6; sections:
// Leite, Aranha, Umeda and de Conti, Applied Ocean Research 20 (1998).
// Neglected: what sway and yaw change in each other's drag when the hull drifts and turns at once; the moment of a
// drift askew (Munk), the lift of the hull, added mass, and the ends of the hull, whose sections differ from the
// middle's.
#pragma once

#include "gem/base/vec2.h"

namespace gem {

enum class DampingWater { still, current };
enum class PlatformDragLaw { round, by_axis };

struct PlatformDragDef {
  bool present = false;
  double coefficient = 0.8;
  double draft_m = 12.42;
  DampingWater water = DampingWater::still;
  PlatformDragLaw law = PlatformDragLaw::round;
  double surge_coefficient = 0.1;
  double sway_coefficient = 0.7;
  double yaw_coefficient = 0.7;
};

/// b of a platform, or of one of its axes, from the width that faces the water [1/m].
GEM_HD constexpr double platform_drag_rate(double water_density, double coefficient, double width, double draft,
                                           double mass) {
  return 0.5 * water_density * coefficient * width * draft / mass;
}

/// b of the yaw [1/rad].
GEM_HD constexpr double yaw_drag_rate(double water_density, double coefficient, double length, double draft,
                                      double inertia) {
  const double square = length * length;
  return water_density * coefficient * draft * (square * square) / (64.0 * inertia);
}

/// Platform velocity after `dt` seconds of drag alone.
GEM_HD inline Vec2 platform_drag(double rate, Vec2 velocity, Vec2 water, double dt) {
  const Vec2 slip = velocity - water;
  return water + (1.0 / (1.0 + rate * length(slip) * dt)) * slip;
}

/// Drag by axis: b of each axis.
struct AxisDrag {
  double surge = 0.0, sway = 0.0;  // [1/m]
  double yaw = 0.0;                // [1/rad]; 0 for a platform that cannot turn

  GEM_HD constexpr bool present() const { return surge > 0.0 || sway > 0.0 || yaw > 0.0; }
};

/// Speed along one axis, or yaw rate, after `dt` seconds of its drag alone.
GEM_HD constexpr double slowed(double rate, double speed, double dt) {
  return speed / (1.0 + rate * (speed < 0.0 ? -speed : speed) * dt);
}

/// Velocity of a platform with the rotation `q` after `dt` seconds of drag by axis alone.
GEM_HD constexpr Vec2 platform_drag(const AxisDrag& drag, Rotation q, Vec2 velocity, Vec2 water, double dt) {
  const Vec2 slip = rotate({q.cosine, -q.sine}, velocity - water);
  return water + rotate(q, {slowed(drag.surge, slip.x, dt), slowed(drag.sway, slip.y, dt)});
}

}  // namespace gem
