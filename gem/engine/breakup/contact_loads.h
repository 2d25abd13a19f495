// Mean forces of contacts over the load time, and the cracks that they make.
//
// The load time is cut into halves. At the end of each half the impulses of the last two are summed, so that every load
// shorter than a half lies within one sum, however it falls on the halves. Sums over time do not depend on the time
// step: a hit counts with its impulse, a steady load with its force.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gem/engine/engine.h"

namespace gem {

/// A crack, and the force that makes it.
struct LoadedCrack {
  FloeCrack crack;
  double force = 0.0;            // along the crack, mean over the load time [N]
  double splitting_force = 0.0;  // that the floe bears [N]
};

class ContactLoads {
 public:
  explicit ContactLoads(const SceneDef& scene);

  /// Adds the forces of some time steps, ascending in (step, a, b).
  void add(const std::vector<StepForce>& forces);
  /// Whether a half of the load time ends with the time step before `step`.
  bool ends_with(std::int64_t step) const { return step % half_steps_ == 0; }
  /// Time steps from `step` to the end of its half of the load time.
  std::int64_t steps_to_end(std::int64_t step) const { return half_steps_ - step % half_steps_; }
  /// Cracks of the floes whose force is large enough, ascending by floe: for each floe the one whose force is largest
  /// over the splitting force. Then begins the next half.
  std::vector<LoadedCrack> close_half(const Bodies& bodies);
  /// Forgets the loads of floes that take part no more.
  void drop_inactive(const Bodies& bodies);

  /// Books the energy of a crack [J].
  void add_crack(double energy) { sums_.crack_energy += energy; }
  /// No floe splits any more: there is no room for pieces.
  void set_full() { sums_.full = 1; }
  bool is_full() const { return sums_.full != 0; }

  const LoadSums& sums() const { return sums_; }
  void restore(const LoadSums& sums) { sums_ = sums; }

 private:
  void add_step(std::span<const StepForce> forces);

  BreakupDef def_;
  double dt_;
  std::int64_t half_steps_;
  LoadSums sums_;
  std::vector<ContactLoad> scratch_;
};

}  // namespace gem
