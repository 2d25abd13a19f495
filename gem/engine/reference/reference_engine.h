// The reference engine judges the other engines. It shares with them the laws (gem/events), the contact geometry of two
// outlines (gem/geometry), the bounds on speeds of a scene (gem/scene), and no other code. It tests all pairs on one
// thread in double precision, and its own solver has no warm start; from the last time step it takes only the spare
// friction. It is slow, and short enough to be checked by hand.
//
// Its bits differ from those of the other engines. They agree to a tolerance that the test derives, on scenes whose
// contact impulses are unique: always without friction; with friction if few contacts hold each floe.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gem/engine/engine.h"
#include "gem/engine/reference/compliant_contacts.h"
#include "gem/engine/reference/reference_state.h"
#include "gem/engine/reference/touch.h"

namespace gem {

class ReferenceEngine : public Engine {
 public:
  /// `refinement`: compliant: substeps for each one that the scene asks for.
  ReferenceEngine(const SceneDef& scene, Bodies bodies, int refinement = 8);

  std::string name() const override { return "reference"; }
  double asked_residual() const override { return rules_.asked_residual; }
  /// Also throws Error(numerical_stop) if it finds no solution for the contacts of a time step.
  void advance(std::int64_t steps, StepLog& log) override;
  std::int64_t step() const override { return state_.steps; }
  const Bodies& bodies() override { return state_.bodies; }
  Ledger ledger() override;
  LineSet broken_lines() const override { return state_.broken; }
  const DpState* dp_state() const override { return rules_.dp.thrusters > 0 ? &state_.dp : nullptr; }
  bool has_contact_forces() const override { return true; }
  std::vector<ContactForce> contact_forces() override;
  EngineState save() override;
  void restore(const EngineState& state) override;

 private:
  void one_step(StepLog& log);
  /// The contacts of a time step and the motion of all bodies: in substeps, or between the halves of the motion.
  std::vector<reference::Touch> move_in_substeps(StepQuality& quality, StepLog& log);
  std::vector<reference::Touch> collide(StepQuality& quality, StepLog& log);
  /// Gives the points what they have from the last time step.
  void log_forces(StepLog& log);
  void recall_points(std::vector<reference::Touch>& touches) const;
  void keep_impulses(const std::vector<reference::Touch>& touches);
  void check_finite() const;

  reference::Rules rules_;
  reference::State state_;
  std::vector<reference::Touch> touches_;   // of the last time step
  std::vector<std::uint64_t> impulse_key_;  // of the last coupled time step
  std::vector<PointMemory> impulse_value_;
  std::optional<reference::CompliantContacts> compliant_;
};

}  // namespace gem
