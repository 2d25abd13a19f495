// The CPU engine: near-pair lists and a team of threads. Every number of threads gives the same bits.
#pragma once

#include <atomic>
#include <vector>

#include "gem/engine/cpu/compliant_contacts.h"
#include "gem/engine/cpu/pair_list.h"
#include "gem/engine/cpu/team_choice.h"
#include "gem/engine/cpu/thread_team.h"
#include "gem/engine/engine.h"
#include "gem/engine/solver/coupled_solver.h"
#include "gem/engine/step/books.h"
#include "gem/engine/step/contact_forces.h"
#include "gem/engine/step/contact_outcome.h"
#include "gem/engine/step/field_state.h"
#include "gem/engine/step/stages.h"

namespace gem {

class CpuEngine : public Engine {
 public:
  CpuEngine(const SceneDef& scene, Bodies bodies, int threads, std::size_t contacts_worth_a_thread);

  std::string name() const override { return "cpu"; }
  double asked_residual() const override { return field_.constants.asked_residual(); }
  void advance(std::int64_t steps, StepLog& log) override;
  std::int64_t step() const override { return step_; }
  const Bodies& bodies() override { return field_.bodies; }
  Ledger ledger() override;
  LineSet broken_lines() const override { return field_.broken; }
  const DpState* dp_state() const override { return field_.constants.events.dp ? &field_.dp : nullptr; }
  KeptCorners kept_corners() const override { return {compliant_.keys(), compliant_.memory()}; }
  bool has_contact_forces() const override { return true; }
  std::vector<ContactForce> contact_forces() override { return gem::contact_forces(field_, pairs_.contacts()); }
  EngineState save() override;
  void restore(const EngineState& state) override;

  /// How often it has changed between all threads and one.
  std::int64_t team_changes() const { return choice_.changes(); }

 protected:
  /// Hooks for studies, called by every thread before and after the pair events of a time step.
  virtual void before_contact_events() {}
  virtual void after_contact_events() {}
  FieldState& field() { return field_; }
  /// The contacts of this time step. They carry impulses once they are resolved.
  Contacts contacts() const { return pairs_.contacts(); }

 private:
  void one_step(ThreadTeam& team, int rank, StepLog& log);
  template <Stage stage>
  void run(ThreadTeam& team, int rank, StepLog& log);
  void solo_events(ThreadTeam& team, int rank);
  void resolve_independent(ThreadTeam& team, int rank);
  void set_up_substeps(std::int64_t substeps);
  bool is(ContactSolver solver) const { return field_.constants.solver == solver; }
  void enter_books(ThreadTeam& team, int rank, StepLog& log);
  void move(ThreadTeam& team, int rank, StepLog& log);

  SceneDef scene_;
  FieldState field_;
  DriveSchedule drives_;
  MooringTables mooring_;
  DpLaw dp_, dp_of_substep_;
  ThreadTeam all_threads_;
  ThreadTeam one_thread_{1};
  TeamChoice choice_;
  Ledger ledger_;  // start and scales; the sums are in the books of the bodies
  std::int64_t step_ = 0;
  PairList pairs_;
  CoupledSolver coupled_;
  CompliantContacts compliant_;
  std::vector<ContactOutcome> outcomes_;  // of the contacts of this time step
  std::vector<double> work_;              // scratch memory of note_outcomes()
  std::atomic<bool> lost_{false};         // the state of a floe is not finite
  StepQuality quality_;
  PlatformImpulses before_;  // platform impulses at the start of the time step
};

}  // namespace gem
