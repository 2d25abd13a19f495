// Keeps what the thrusters gave between two samples of the platform, and the offset that they left.
#pragma once

#include <vector>

#include "gem/engine/engine.h"

namespace gem {

struct Slab;

/// Whether thrusters hold the platform of the case.
bool has_dp(const SceneDef& scene);

/// Of a case without thrusters: nothing is kept.
class ThrusterRecord {
 public:
  explicit ThrusterRecord(const SceneDef& scene);

  /// Appends the row of t = 0: no thrust, and the offset of the start.
  void start(const SceneDef& scene, const PlatformStep& start, Slab& slab);
  /// Adds a time step.
  void add(const PlatformStep& step, const DpState& dp);
  /// Appends the means over the time steps since the last row and the offset of the last one, and starts anew.
  void take(Slab& slab);
  /// What a run carries from one time step to the next: sums of thrust x, y and time steps at the limit of each
  /// thruster, of the demand by surge, sway, yaw, and of time steps; the offset of the last one by surge, sway, yaw.
  const std::vector<double>& sums() const { return sums_; }
  void restore(const std::vector<double>& sums) { sums_ = sums; }

 private:
  void set_offset(const PlatformStep& step, double yaw);

  std::size_t thrusters_;
  Vec2 place_;  // set point [m]
  std::vector<double> sums_;
};

}  // namespace gem
