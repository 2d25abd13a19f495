#include "bench/solver_study/moving.h"

#include <algorithm>

#include "gem/engine/solver/coupled_solver.h"
#include "gem/engine/solver/iteration_control.h"
#include "gem/engine/step/books.h"
#include "gem/engine/step/contact_outcome.h"
#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/solo_stages.h"

namespace gem::bench {

MovingField::MovingField(const SceneDef& scene, const EngineState& state)
    : f(make_field_state(state.bodies, step_constants(scene, state.bodies))),
      start_velocity_(state.bodies.velocity[0]) {
  for (std::size_t i = 0; i < state.impulse_key.size(); ++i) last[state.impulse_key[i]] = state.impulse_value[i];
}

Contacts MovingField::find() {
  team.run([&](int rank) { pairs_.find(f, team, rank); });
  for (const Contact* contact : pairs_.contacts())
    for (int k = 0; k < contact->count; ++k) {
      const double depth = std::max(0.0, -contact->slot[k].separation);
      score.deepest = std::max(score.deepest, depth);
      score.depth_sum += depth;
      score.depth.add(depth);
      ++score.points;
    }
  ++score.steps;
  return pairs_.contacts();
}

void MovingField::kick() {
  (energy_change_ > 0.0 ? score.created : score.lost) += energy_change_;
  energy_change_ = 0.0;
  for (std::size_t i = 0; i < f.bodies.count(); ++i)
    if (f.bodies.kind[i] == BodyKind::floe) kick_floe(f, i);
  platform_first_half(f);
}

void MovingField::note_change(const std::vector<Vec2>& velocity, const std::vector<double>& spin) {
  const Bodies& b = f.bodies;
  for (std::size_t i = 0; i < b.count(); ++i) {
    if (!(b.inverse_mass[i] > 0.0) || !b.active[i]) continue;
    energy_change_ += kinetic_energy(b.mass[i], b.inertia[i], b.velocity[i], b.spin[i]) -
                      kinetic_energy(b.mass[i], b.inertia[i], velocity[i], spin[i]);
    score.fixed_impulse += b.mass[i] * (b.velocity[i] - velocity[i]);
  }
  if (b.inverse_mass[0] > 0.0) score.platform_impulse += b.mass[0] * (b.velocity[0] - velocity[0]);
}

void MovingField::drift() {
  for (std::size_t i = 0; i < f.bodies.count(); ++i)
    if (f.bodies.kind[i] == BodyKind::floe) drift_floe(f, i);
  platform_second_half(f);
  retire(f);
  const double start = length(start_velocity_);
  if (start > 0.0)
    score.fastest_back = std::max(score.fastest_back, -dot(f.bodies.velocity[0], start_velocity_) / start);
}

void MovingField::take(const Problem& problem, const Motions& motions) {
  for (std::size_t k = 0; k < problem.points(); ++k) f.struck[problem.point[k].a] = f.struck[problem.point[k].b] = 1;
  for (std::size_t i = 0; i < problem.bodies(); ++i) {
    if (!(problem.inverse_mass[i] > 0.0)) continue;
    f.bodies.velocity[i] = {motions[i].x, motions[i].y};
    f.bodies.spin[i] = motions[i].spin;
    f.repair_shift[i] = {motions[i].shift_x, motions[i].shift_y};
    f.repair_turn[i] = motions[i].turn;
  }
}

Stepper production(std::int64_t iterations) {
  const auto solver = std::make_shared<CoupledSolver>();
  return {"gem " + std::to_string(iterations), [=](MovingField& field) {
            FieldState& f = field.f;
            f.constants.iterations_maximum = iterations;
            f.carried_ahead = carried_ahead(iterations);
            const Contacts contacts = field.find();
            if (field.score.steps == 1) {
              std::vector<std::uint64_t> keys;
              Impulses impulses;
              for (const auto& [key, impulse] : field.last) {
                keys.push_back(key);
                impulses.push_back(impulse);
              }
              solver->restore(keys, impulses);
            }
            field.kick();
            const auto velocity = f.bodies.velocity;
            const auto spin = f.bodies.spin;
            StepQuality quality;
            solver->lay_out(f, contacts, field.team.size());
            field.team.run([&](int rank) { solver->resolve(f, contacts, field.team, rank, quality); });
            field.note_change(velocity, spin);
            for (const Contact* contact : contacts) {
              ContactOutcome outcome;
              find_outcome(f, *contact, outcome);
              book_contact(f, *contact, outcome);
            }
            field.drift();
          }};
}

Stepper passes_of(const std::string& name, const Candidate& candidate, int passes, const WarmOptions& warm) {
  return {name, [=](MovingField& field) {
            FieldState& f = field.f;
            const Contacts contacts = field.find();
            field.kick();
            for (Contact* contact : contacts) prepare_contact(f, *contact);
            if (!warm.impulses) field.last.clear();
            Impulses impulses = warm_impulses(contacts, field.last, warm.repair);
            const Problem problem = make_problem(f, contacts, impulses);
            keep_best_share(problem, impulses, 1.0);
            const auto method = candidate.make(problem, impulses);
            for (int pass = 0; pass < passes; ++pass) method->pass();
            impulses = method->impulses();
            keep_best_share(problem, impulses, 0.5);
            field.take(problem, motions_of(problem, impulses));
            field.note_change(problem.velocity, problem.spin);
            field.last = remembered(contacts, impulses);
            field.drift();
          }};
}

}  // namespace gem::bench
