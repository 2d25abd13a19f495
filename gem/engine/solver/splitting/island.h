// An island of a time step on the host: its bodies, its contact points, and what is asked of its solver.
#pragma once

#include <cstdint>

#include "gem/base/vec2.h"
#include "gem/engine/solver/coupled_point.h"
#include "gem/engine/solver/splitting/split_point.h"

namespace gem {

/// A moving body before the impulses of the time step.
struct IslandBody {
  Vec2 position;      // [m]
  Vec2 velocity;      // [m/s]
  double spin = 0.0;  // [rad/s]
  InverseMass inverse;
};

/// A contact point: its bodies, its constants, and its impulse: the last one on entry, the result on return.
struct IslandPoint {
  static constexpr std::int32_t fixed = -1;
  std::int32_t a = 0, b = 0;  // `fixed`: a fixed body
  const PointGeometry<double>* geometry = nullptr;
  PointImpulse<double>* impulse = nullptr;
  SpareFriction spare;
  bool first_of_contact;
};

struct IslandControl {
  PointFriction friction = PointFriction::coulomb;
  double tolerance = 1e-3;  // of the velocities [m/s]
  double dt = 0.0;          // [s]
  std::int64_t iterations_maximum = 0;
  bool gradient_first = true;  // not where the tolerance of the case is below the resolution of single precision
  bool jam = false;            // IslandSize::is_jam(): how gradient iterations end
};

struct IslandResult {
  std::int64_t iterations = 0;
  double error = 0.0;  // estimate of the largest error of a velocity [m/s]
};

}  // namespace gem
