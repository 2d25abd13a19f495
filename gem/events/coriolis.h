// Coriolis force on the floes, exact over a time step: the velocity through the water turns.
//
//   dv/dt = -f k x (v - U),   so   v - U   turns by   -f dt
//
//   v  velocity of the floe [m/s]     U  velocity of the water [m/s]     k  upward unit vector
//   f  Coriolis parameter, 2 Omega sin(latitude), Omega = 7.2921e-5 [1/s]; positive on the northern hemisphere
//
// The water's own Coriolis force is held by the slope of its surface, on which the floes lie too: that is the +f k x U.
// So a floe that moves with the water feels nothing, and without drag floes run in inertial circles of radius
// |v - U| / f about the moving water. Source: Leppaeranta, The Drift of Sea Ice (Springer, 2011). Range: |f|
// <= 1.46e-4. Neglected: the slope that turns or speeds up the water (tide), and the platform: f is far below its own
// frequency.
#pragma once

#include "gem/base/vec2.h"
#include "gem/events/motion.h"

namespace gem {

struct CoriolisDef {
  double parameter_per_s = 0.0;  ///< f; 0: none
};

/// The turn of a velocity through the water in `dt` [s], accurate as motion.h says. Once per run.
constexpr Rotation coriolis_turn(double parameter, double dt) { return turned({}, -parameter * dt); }

}  // namespace gem
