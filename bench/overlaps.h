// Overlaps of the true outlines, measured independently of the engines.
#pragma once

#include <cstdint>

#include "gem/field/bodies.h"

namespace gem::bench {

/// Over all pairs of active bodies, at least one of them free to move, whose outlines are closer than `near`.
struct Overlaps {
  std::int64_t near_pairs = 0;
  std::int64_t overlapping_pairs = 0;
  double maximum = 0.0;       // deepest overlap [m]
  double quantile_999 = 0.0;  // of the depth over near pairs; pairs apart count as 0 [m]
  double mean = 0.0;          // depth over near pairs [m]
  double mean_gap = 0.0;      // gap over near pairs that are apart: shows the skin of an engine [m]
};

constexpr double near = 0.025;  // more than Box2D's two skins [m]

/// Measured with separating axes in double precision.
Overlaps overlaps_of(const Bodies& bodies);

}  // namespace gem::bench
