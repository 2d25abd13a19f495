// An engine whose floes split: it looks at the contacts of another engine, and splits floes between its time steps.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gem/engine/breakup/contact_loads.h"
#include "gem/engine/engine.h"

namespace gem {

/// Splitting is written once, on the host, on the state that engines save and restore: engines with the same bits and
/// contact forces make the same pieces. The engine inside must tell contact_forces(). It runs to the end of each half
/// load time; floes split only there.
class BreakupEngine : public Engine {
 public:
  /// Throws Error(usage) if `engine` does not tell its contact forces.
  BreakupEngine(const SceneDef& scene, std::unique_ptr<Engine> engine);

  std::string name() const override { return engine_->name(); }
  std::string method() const override { return engine_->method(); }
  std::string device() const override { return engine_->device(); }
  double asked_residual() const override { return engine_->asked_residual(); }
  void advance(std::int64_t steps, StepLog& log) override;
  /// For a batch, which advances the engine inside by itself: the most time steps that it may make next. `log` will ask
  /// for the forces that look_at() needs.
  std::int64_t begin(std::int64_t steps, StepLog& log);
  /// Takes the forces of the time steps made since begin() out of `log`; splits floes if a half load time has ended.
  void look_at(StepLog& log);
  std::int64_t step() const override { return engine_->step(); }
  const Bodies& bodies() override { return engine_->bodies(); }
  /// The books of the engine inside; the energy of cracks is moved from the contacts to an entry of its own.
  Ledger ledger() override;
  LineSet broken_lines() const override { return engine_->broken_lines(); }
  const DpState* dp_state() const override { return engine_->dp_state(); }
  KeptCorners kept_corners() const override { return engine_->kept_corners(); }
  bool has_contact_forces() const override { return true; }
  std::vector<ContactForce> contact_forces() override { return forces_; }
  EngineState save() override;
  void restore(const EngineState& state) override;

 private:
  void split(StepLog& log);
  void name_pieces(const std::vector<SplitEvent>& splits);

  SceneDef scene_;
  std::unique_ptr<Engine> engine_;
  ContactLoads loads_;
  std::vector<ContactForce> forces_;  // of the last time step
  std::int64_t begun_ = -1;           // time step at the last begin()
};

}  // namespace gem
