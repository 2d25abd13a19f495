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
  /// The residual that ends the iterations [m/s]; NaN: the solver has none.
  double asked_residual() const { return asked_residual_; }

  /// What it has gathered. It can be copied byte by byte.
  struct State {
    std::int64_t step = 0;
    std::int64_t contact_steps = 0;
    std::int64_t unfinished = 0;
    double energy_created = 0.0;  // NaN as soon as a time step does not measure it [J]
    OverlapCount residuals;       // of the time steps with contact points [m/s]
    NyquistShare force;
    RunMeasures measures;
  };
  const State& state() const { return now_; }
  void restore(const State& state) { now_ = state; }

 private:
  void add(const StepQuality& quality, double time);
  void look_at_contacts(const ContactEnergy& contact);

  double time_step_;
  bool has_platform_;
  double asked_residual_;  // NaN: the solver does not iterate to a residual [m/s]
  State now_;
};

}  // namespace gem
