// Gathers during a run the numbers by which it will be judged.
#pragma once

#include <cstdint>

#include "gem/analysis/verdict/nyquist_share.h"
#include "gem/analysis/verdict/run_measures.h"
#include "gem/engine/engine.h"
#include "gem/record/schema.h"

namespace gem {

class RunWatch {
 public:
  /// Looks at the state at t = 0.
  RunWatch(const SceneDef& scene, Engine& engine);

  /// Adds the time steps of `log`, which follow those added before.
  void add(const StepLog& log);
  /// Looks at the floes and the books after the last added time step.
  void look_at(const Bodies& bodies, const StatsRow& books);
  /// Energies and speeds are those of the last look.
  RunMeasures measures() const;

 private:
  void add(const StepQuality& quality, double time);

  double time_step_;
  bool has_platform_;
  double asked_residual_;  // NaN: the solver does not iterate to a residual [m/s]
  std::int64_t step_ = 0;
  std::int64_t contact_steps_ = 0;
  std::int64_t unfinished_ = 0;
  double energy_created_ = 0.0;  // NaN as soon as a time step does not measure it [J]
  OverlapCount residuals_;       // of the time steps with contact points [m/s]
  NyquistShare force_;
  RunMeasures measures_;
};

}  // namespace gem
