// The reference engine judges the other engines. It shares the laws of events and what a contact of two outlines is
// (gem/events, gem/geometry), and nothing of how they are carried out: all pairs, one thread, double precision, a
// solver of its own, which starts every time step from nothing. Slow, and short enough to be checked by hand.
//
// It has its own bits. Another engine agrees with it to a tolerance that the test derives, on scenes whose contacts
// have one answer: without friction always, with it where few enough contacts hold each floe.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/engine/reference/reference_state.h"
#include "gem/engine/reference/touch.h"

namespace gem {

class ReferenceEngine : public Engine {
 public:
  ReferenceEngine(const SceneDef& scene, Bodies bodies);

  std::string name() const override { return "reference"; }
  /// Throws Error(numerical_stop) also where the contacts of a time step have no answer that it finds.
  void advance(std::int64_t steps, StepLog& log) override;
  std::int64_t step() const override { return state_.steps; }
  const Bodies& bodies() override { return state_.bodies; }
  Ledger ledger() override;
  EngineState save() override;
  void restore(const EngineState& state) override;

 private:
  void one_step(StepLog& log);
  void keep_impulses(const std::vector<reference::Touch>& touches);
  void check_finite() const;

  reference::Rules rules_;
  reference::State state_;
  std::vector<std::uint64_t> impulse_key_;  // of the last coupled time step: for who reads a saved state
  std::vector<PointImpulse<double>> impulse_value_;
};

}  // namespace gem
