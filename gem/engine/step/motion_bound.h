// A bound on motion lets the narrow phase skip a near pair. What is left for rounding, the same in all engines.
#pragma once

#include "gem/base/macros.h"

namespace gem {

/// Allowance for rounding in the bound on motion [m]. Far above the rounding of positions up to 100 km (1.5e-11 m) and
/// far below any overlap that matters.
constexpr double motion_rounding = 1e-9;

/// The clock at which a pair wakes that may still move by `spare` now, at `clock` [m]. The clock is compared in single
/// precision (rounding 6e-8), so the sum is shortened by more than that.
GEM_HD inline float wake_clock(double clock, double spare) {
  constexpr double surely = 1.0 - 1e-6;
  return static_cast<float>(surely * (clock + spare) - motion_rounding);
}

}  // namespace gem
