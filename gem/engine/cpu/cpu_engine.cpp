// Runs the stages of a time step (gem/engine/step/stages.h) on a team of threads.
#include "gem/engine/cpu/cpu_engine.h"

#include <utility>

#include "gem/engine/cpu/kick_floes.h"
#include "gem/engine/cpu/move_floes.h"
#include "gem/engine/step/books.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/solo_stages.h"
#include "gem/scene/scene_drive.h"

namespace gem {

CpuEngine::CpuEngine(const SceneDef& scene, Bodies bodies, int threads, std::size_t contacts_worth_a_thread)
    : drives_(drive_schedule(scene)),
      mooring_(mooring_tables(scene.mooring.law, scene.mooring_design)),
      dp_(dp_law_of(scene, bodies)),
      all_threads_(threads),
      coupled_(contacts_worth_a_thread) {
  check_solver(scene.contact.solver, {ContactSolver::independent, ContactSolver::coupled}, "cpu");
  const StepConstants constants = step_constants(scene, bodies, mooring_.view(), &dp_);
  field_ = make_field_state(std::move(bodies), constants);
  field_.drive = drives_.at(step_);
  ledger_.start = total(field_);
}

void CpuEngine::advance(std::int64_t steps, StepLog& log) {
  check_finite(field_, step_);
  while (steps > 0) {
    const std::int64_t stretch = all_threads_.size() == 1 ? steps : choice_.stretch(steps);
    ThreadTeam& team = choice_.all_threads() ? all_threads_ : one_thread_;
    choice_.start();
    team.run([&](int rank) {
      for (std::int64_t i = 0; i < stretch; ++i) one_step(team, rank, log);
    });
    if (all_threads_.size() > 1) choice_.note(stretch);
    steps -= stretch;
  }
}

void CpuEngine::one_step(ThreadTeam& team, int rank, StepLog& log) {
  for_each_stage([&](auto stage) { run<stage.value>(team, rank, log); });
}

template <Stage stage>
void CpuEngine::run(ThreadTeam& team, int rank, StepLog& log) {
  FieldState& f = field_;
  const bool coupled = f.constants.solver == ContactSolver::coupled;
  if constexpr (stage == Stage::list) pairs_.renew(f, team, rank);
  if constexpr (stage == Stage::candidates) pairs_.choose(team, rank);
  if constexpr (stage == Stage::narrow_phase) pairs_.find_contacts(f, team, rank);
  if constexpr (stage == Stage::solo_events) solo_events(team, rank);
  if constexpr (stage == Stage::contact_events) {
    before_contact_events();
    if (!coupled) resolve_independent(team, rank);
  }
  if constexpr (stage == Stage::gather)
    if (coupled) coupled_.gather(f, pairs_.contacts(), team, rank);
  if constexpr (stage == Stage::iterate)
    if (coupled) coupled_.iterate(f, pairs_.contacts(), team, rank);
  if constexpr (stage == Stage::settle)
    if (coupled) coupled_.settle(f, pairs_.contacts(), team, rank, quality_);
  if constexpr (stage == Stage::books) {
    after_contact_events();
    enter_books(team, rank, log);
  }
  if constexpr (stage == Stage::move) move(team, rank, log);
}

/// Rank 0 moves the platform and prepares memory while the other threads start on the floes.
void CpuEngine::solo_events(ThreadTeam& team, int rank) {
  FieldState& f = field_;
  const Contacts contacts = pairs_.contacts();
  team.on_rank_zero(rank, [&] {
    before_ = platform_impulses(f);
    platform_first_half(f);
    quality_ = {};
    outcomes_.resize(contacts.size());
    if (f.constants.solver == ContactSolver::coupled) coupled_.lay_out(f, contacts, team.size());
  });
  team.for_each_range(static_cast<std::int64_t>(f.bodies.count()),
                      [&](std::int64_t begin, std::int64_t end) { kick_floes(f, begin, end); });
  team.barrier();
}

void CpuEngine::resolve_independent(ThreadTeam& team, int rank) {
  FieldState& f = field_;
  const Contacts contacts = pairs_.contacts();
  team.for_each(rank, static_cast<std::int64_t>(contacts.size()), [&](std::int64_t i) {
    prepare_contact(f, *contacts[i]);
    resolve_alone(f, *contacts[i]);
  });
  team.single(rank, [&] {
    for (const Contact* contact : contacts) apply_impulses(f, *contact);
    carry_pieces(f);
  });
}

/// The books and the log must be filled in order of the contacts, by one thread each. The two threads run side by side.
void CpuEngine::enter_books(ThreadTeam& team, int rank, StepLog& log) {
  FieldState& f = field_;
  const Contacts contacts = pairs_.contacts();
  team.for_each(rank, static_cast<std::int64_t>(contacts.size()),
                [&](std::int64_t c) { find_outcome(f, *contacts[c], outcomes_[c]); });
  if (rank == team.size() - 1) note_outcomes(f, outcomes_, work_, quality_, log);
  team.single(rank, [&] {
    for (std::size_t c = 0; c < contacts.size(); ++c) book_contact(f, *contacts[c], outcomes_[c]);
    log_events(f, contacts, step_, log);
  });
}

void CpuEngine::move(ThreadTeam& team, int rank, StepLog& log) {
  FieldState& f = field_;
  const auto n = static_cast<std::int64_t>(f.bodies.count());
  if (!move_floes(f, team.begin_of(rank, n), team.begin_of(rank + 1, n))) lost_ = true;
  team.barrier();
  team.single(rank, [&] {
    platform_second_half(f);
    ++step_;
    f.drive = drives_.at(step_);
    if (lost_.exchange(false) || !finite_or_inactive(f.bodies, 0)) check_finite(f, step_);
    log_step(f, pairs_.contacts(), before_, quality_, log);
    if (log.wants_forces) log_forces(contact_forces(), f.bodies, step_ - 1, log);
  });
}

Ledger CpuEngine::ledger() { return closed_books(field_, ledger_); }

EngineState CpuEngine::save() {
  return {step_,         field_.bodies, saved_books(field_, ledger_), field_.books, coupled_.keys(), coupled_.memory(),
          field_.broken, field_.dp};
}

void CpuEngine::restore(const EngineState& state) {
  field_ = make_field_state(state.bodies, field_.constants);
  open_books(field_, state);
  ledger_ = state.ledger;
  step_ = state.step;
  field_.drive = drives_.at(step_);
  coupled_.restore(state.impulse_key, state.impulse_value);
  pairs_.clear();
}

}  // namespace gem
