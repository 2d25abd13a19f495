// The steps to which places and speeds of floes are rounded for the page.
#pragma once

#include <vector>

#include "gem/base/vec2.h"

namespace gem::view {

/// A value is kept as the nearest multiple of its step.
struct Rounding {
  double place_m = 0.01;
  double angle_rad = 0.0;  ///< a whole number of steps makes a turn
  double speed_m_per_s = 0.001;
  double spin_rad_per_s = 1e-4;
};

/// Steps of an angle in one turn.
inline constexpr int turn_steps = 16384;

/// Place: a power of ten between 1/10000 and 1/1000 of the smallest floe. Speeds: fine enough to foretell the place a
/// frame later to one step. `interval_s` lies between two frames.
Rounding rounding_for(const std::vector<std::vector<Vec2>>& outlines, double interval_s);

}  // namespace gem::view
