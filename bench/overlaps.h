// How deep true outlines overlap, measured outside any engine.
#pragma once

#include <cstdint>

#include "gem/field/bodies.h"

namespace gem::bench {

/// Over all pairs of active bodies whose outlines are closer than `near` (one of them free to move).
struct Overlaps {
  std::int64_t near_pairs = 0;
  std::int64_t overlapping_pairs = 0;
  double maximum = 0.0;       // deepest overlap [m]
  double quantile_999 = 0.0;  // of the depth over near pairs, 0 for pairs apart [m]
  double mean = 0.0;          // depth over near pairs [m]
  double mean_gap = 0.0;      // gap over near pairs that are apart: bodies held apart by an engine's skin [m]
};

constexpr double near = 0.025;  // wider than Box2D's two skins [m]

/// By separating axes in double, whatever the engine thinks.
Overlaps overlaps_of(const Bodies& bodies);

}  // namespace gem::bench
