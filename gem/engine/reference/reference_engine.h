// The reference engine judges the other engines. It shares the laws of events and what a contact of two outlines is
// (gem/events, gem/geometry), and nothing of how they are carried out: all pairs, one thread, double precision, a
// solver of its own, no memory of the last time step. Slow, and short enough to be checked by hand.
//
// It has its own bits. Another engine agrees with it to a tolerance that the test derives, on scenes whose contacts
// have one answer: without friction always, with it where few enough contacts hold each floe.
#pragma once

#include <string>

#include "gem/engine/engine.h"
#include "gem/engine/reference/reference_state.h"

namespace gem {

class ReferenceEngine : public Engine {
 public:
  ReferenceEngine(const SceneDef& scene, Bodies bodies);

  std::string name() const override { return "reference"; }
  /// Throws Error(numerical_stop) also where the contacts of a time step have no answer that it finds.
  void advance(std::int64_t steps, MomentLog& log) override;
  std::int64_t moment() const override { return state_.steps; }
  const Bodies& bodies() override { return state_.bodies; }
  Ledger ledger() override;
  EngineState save() override;
  void restore(const EngineState& state) override;

 private:
  void one_step(MomentLog& log);
  void check_finite() const;

  ReferenceRules rules_;
  ReferenceState state_;
};

}  // namespace gem
