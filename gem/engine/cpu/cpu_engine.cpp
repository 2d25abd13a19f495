// Runs the stages of a time step (gem/engine/step/stages.h) on a team of threads.
#include "gem/engine/cpu/cpu_engine.h"

#include <utility>

#include "gem/engine/contact/substep_count.h"
#include "gem/engine/cpu/kick_floes.h"
#include "gem/engine/cpu/move_floes.h"
#include "gem/engine/step/books.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/solo_stages.h"
#include "gem/scene/scene_drive.h"

namespace gem {

CpuEngine::CpuEngine(const SceneDef& scene, Bodies bodies, int threads, std::size_t contacts_worth_a_thread)
    : scene_(scene),
      drives_(drive_schedule(scene)),
      mooring_(mooring_tables(scene.mooring.law, scene.mooring_design)),
      dp_(dp_law_of(scene, bodies)),
      all_threads_(threads),
      coupled_(contacts_worth_a_thread) {
  check_solver(scene.contact.solver, {ContactSolver::independent, ContactSolver::coupled, ContactSolver::compliant},
               "cpu");
  const StepConstants constants = step_constants(scene, bodies, mooring_.view(), &dp_);
  field_ = make_field_state(std::move(bodies), constants);
  field_.drive = drives_.at(step_);
  ledger_.start = total(field_);
  if (is(ContactSolver::compliant)) set_up_substeps(substep_count(scene, field_.bodies));
}

/// The platform feels its loads in every substep, so it needs their constants for that time.
void CpuEngine::set_up_substeps(std::int64_t substeps) {
  SceneDef scene = scene_;
  scene.numerics.time_step_s /= static_cast<double>(substeps);
  dp_of_substep_ = dp_law_of(scene, field_.bodies);
  compliant_.set_up(substeps, step_constants(scene, field_.bodies, mooring_.view(), &dp_of_substep_));
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
  const bool coupled = is(ContactSolver::coupled), compliant = is(ContactSolver::compliant);
  if constexpr (stage == Stage::list) pairs_.renew(f, team, rank);
  if constexpr (stage == Stage::candidates) pairs_.choose(team, rank);
  if constexpr (stage == Stage::narrow_phase) pairs_.find_contacts(f, team, rank);
  if constexpr (stage == Stage::solo_events) solo_events(team, rank);
  if constexpr (stage == Stage::contact_events) {
    before_contact_events();
    if (compliant) compliant_.begin(f, pairs_.contacts(), team, rank);
    if (!coupled && !compliant) resolve_independent(team, rank);
  }
  if constexpr (stage == Stage::gather)
    if (coupled) coupled_.gather(f, pairs_.contacts(), team, rank);
  if constexpr (stage == Stage::iterate) {
    if (coupled) coupled_.iterate(f, pairs_.contacts(), team, rank);
    if (compliant) compliant_.run(f, pairs_.contacts(), team, rank);
  }
  if constexpr (stage == Stage::settle) {
    if (coupled) coupled_.settle(f, pairs_.contacts(), team, rank, quality_);
    if (compliant) compliant_.finish(f, pairs_.contacts(), team, rank, quality_, log);
  }
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
    quality_ = {};
    if (is(ContactSolver::compliant)) {
      f.platform_position = f.bodies.position[0];
      tow_platform(f);
      return;
    }
    platform_first_half(f);
    outcomes_.resize(contacts.size());
    if (f.constants.solver == ContactSolver::coupled) coupled_.lay_out(f, contacts, team.size());
  });
  if (is(ContactSolver::compliant)) team.single(rank, [&] { compliant_.note_velocities(f); });
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
  if (is(ContactSolver::compliant)) {
    team.single(rank, [&] { log_events(f, contacts, step_, log); });
    return;
  }
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
    if (is(ContactSolver::compliant))
      platform_after_substeps(f);
    else
      platform_second_half(f);
    ++step_;
    f.drive = drives_.at(step_);
    if (lost_.exchange(false) || !finite_or_inactive(f.bodies, 0)) check_finite(f, step_);
    log_step(f, pairs_.contacts(), before_, quality_, log);
    if (log.wants_forces) log_forces(contact_forces(), f.bodies, step_ - 1, log);
  });
}

Ledger CpuEngine::ledger() {
  ledger_.contact = compliant_.energy();
  return closed_books(field_, ledger_);
}

EngineState CpuEngine::save() {
  ledger_.contact = compliant_.energy();
  return {step_,
          field_.bodies,
          saved_books(field_, ledger_),
          field_.books,
          coupled_.keys(),
          coupled_.memory(),
          field_.broken,
          field_.dp,
          compliant_.keys(),
          compliant_.memory(),
          is(ContactSolver::compliant) ? compliant_.substeps() : 0};
}

void CpuEngine::restore(const EngineState& state) {
  field_ = make_field_state(state.bodies, field_.constants);
  open_books(field_, state);
  ledger_ = state.ledger;
  step_ = state.step;
  field_.drive = drives_.at(step_);
  coupled_.restore(state.impulse_key, state.impulse_value);
  compliant_.restore(state);
  if (is(ContactSolver::compliant) && state.substeps > 0) set_up_substeps(state.substeps);
  pairs_.clear();
}

}  // namespace gem
