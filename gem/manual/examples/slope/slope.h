// Slope of the sea surface: floes slide down it. Steady and the same everywhere; exact over a time step of any length.
//
//   dv/dt = -g S        v' = v - g S dt,   path of v = v dt - g S dt^2 / 2
//
//   v   velocity of the floe [m/s]     S   slope, rise of the surface over distance [-]     g   9.81 [m/s2]
//
// Source: Leppaeranta, The Drift of Sea Ice (Springer, 2011). Range: |S| up to 1e-5 (a metre in 100 km). Neglected: the
// slope that holds a current in balance (gem/events/coriolis.h has it), and the platform.
#pragma once

#include "gem/base/vec2.h"

namespace gem {

/// The surface rises by this much per metre in x and in y; level if both are zero.
struct SlopeDef {
  Vec2 rise = {0.0, 0.0};
};

constexpr double gravity = 9.81;  // [m/s2]

/// Whether the surface slopes at all.
GEM_HD inline bool slopes(const SlopeDef& slope) { return slope.rise.x != 0.0 || slope.rise.y != 0.0; }

/// A floe after a time step on the slope.
struct SlopeSlide {
  Vec2 velocity;         // [m/s]
  Vec2 path_correction;  // exact path minus velocity x dt [m]
};

/// `velocity` [m/s] of the floe; `dt` [s].
GEM_HD inline SlopeSlide slide(const SlopeDef& slope, Vec2 velocity, double dt) {
  const Vec2 gain = (-gravity * dt) * slope.rise;
  return {velocity + gain, (-0.5 * dt) * gain};
}

}  // namespace gem
