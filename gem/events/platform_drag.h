// Water drag on the platform, quadratic in its velocity through the water.
//
//   dw/dt = -b |w| w,   b = rho_w C_D D T / (2 M)       w' = w / (1 + b |w| dt)
//
//   w   platform velocity minus water velocity [m/s]     D, T  diameter and draft [m]
//   C_D drag coefficient, 0.5 to 1.0 for a short cylinder at full scale [-]    M  platform mass [kg]
//
// The solution is exact; it is split symmetrically around the mooring. The reference paper does not say whether the
// water that damps the platform moves with the current, so both are offered.
#pragma once

#include "gem/base/vec2.h"

namespace gem {

enum class DampingWater { still, current };

struct PlatformDragDef {
  bool present = false;
  double coefficient = 0.8;
  double draft_m = 12.42;
  DampingWater water = DampingWater::still;
};

/// b of a platform [1/m].
GEM_HD constexpr double platform_drag_rate(double water_density, double coefficient, double diameter, double draft,
                                           double mass) {
  return 0.5 * water_density * coefficient * diameter * draft / mass;
}

/// Platform velocity after `dt` seconds of drag alone.
GEM_HD inline Vec2 platform_drag(double rate, Vec2 velocity, Vec2 water, double dt) {
  const Vec2 slip = velocity - water;
  return water + (1.0 / (1.0 + rate * length(slip) * dt)) * slip;
}

}  // namespace gem
