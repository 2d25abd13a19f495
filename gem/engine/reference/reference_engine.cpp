// One time step:
//
// | touches  | found at the positions at its start                                                       |
// | drive    | velocity of every floe at its end without contacts; first half of the platform's motion   |
// | contacts | each pair alone, or all together: impulses on those velocities                            |
// | books    | work and momentum of the contacts                                                         |
// | motion   | floes with their new velocities; second half of the platform's motion                     |
//
// Compliant: all of it in every substep, see compliant_contacts.h.
#include "gem/engine/reference/reference_engine.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gem/base/error.h"
#include "gem/base/number_text.h"
#include "gem/engine/reference/reference_books.h"
#include "gem/engine/reference/reference_contacts.h"
#include "gem/engine/reference/reference_motion.h"

namespace gem {

ReferenceEngine::ReferenceEngine(const SceneDef& scene, Bodies bodies, int refinement)
    : rules_(reference::rules_of(scene, bodies)) {
  check_solver(scene.contact.solver, {ContactSolver::independent, ContactSolver::coupled, ContactSolver::compliant},
               "reference");
  if (rules_.compliant()) compliant_.emplace(scene, bodies, refinement);
  state_.bodies = std::move(bodies);
  state_.ledger.start = total_of(rules_, state_);
}

void ReferenceEngine::advance(std::int64_t steps, StepLog& log) {
  check_finite();
  for (std::int64_t i = 0; i < steps; ++i) one_step(log);
}

std::vector<reference::Touch> ReferenceEngine::move_in_substeps(StepQuality& quality, StepLog& log) {
  const reference::State start = state_;
  std::vector<reference::Touch> touches = compliant_->advance(rules_, state_, quality, log);
  log_platform_events(rules_, start, touches, log);
  return touches;
}

std::vector<reference::Touch> ReferenceEngine::collide(StepQuality& quality, StepLog& log) {
  std::vector<reference::Touch> touches =
      reference::all_touches(state_.bodies, rules_.piece_corner, rules_.scene.contact.manifold, rules_.contact_margin);
  drive_floes(rules_, state_);
  move_platform_before(rules_, state_);

  if (rules_.coupled()) recall_points(touches);
  prepare_touches(rules_, state_, touches);
  if (rules_.coupled()) {
    resolve_together(rules_, state_, touches, quality);
    keep_impulses(touches);
  } else {
    resolve_alone(rules_, state_, touches);
  }
  apply_impulses(rules_, state_, touches);

  book_touches(state_, touches);
  judge_touches(state_.bodies, touches, quality, log);
  log_platform_events(rules_, state_, touches, log);

  move_floes(rules_, state_);
  move_platform_after(rules_, state_);
  return touches;
}

void ReferenceEngine::one_step(StepLog& log) {
  state_.begin_step(rules_);
  StepQuality quality;
  touches_ = rules_.compliant() ? move_in_substeps(quality, log) : collide(quality, log);
  ++state_.steps;
  check_finite();
  retire_floes(rules_, state_);
  log.platform.push_back(platform_sample(state_, touches_));
  if (rules_.dp.thrusters > 0) log.dp.push_back(state_.dp);
  log.quality.push_back(quality);
  if (log.wants_forces) log_forces(log);
}

std::vector<ContactForce> ReferenceEngine::contact_forces() {
  std::vector<ContactForce> forces;
  const Bodies& b = state_.bodies;
  for (const reference::Touch& touch : touches_) {
    if (!b.active[touch.a] || !b.active[touch.b]) continue;
    Vec2 impulse, moment;
    double pressed = 0.0;
    for (const reference::TouchPoint& p : touch.points) {
      impulse += p.impulse.normal * touch.normal + p.impulse.tangential * turned_left(touch.normal);
      moment += p.impulse.normal * p.arm_b;
      pressed += p.impulse.normal;
    }
    if (impulse.x == 0.0 && impulse.y == 0.0) continue;
    const Vec2 arm = pressed > 0.0 ? (1.0 / pressed) * moment : touch.points[0].arm_b;
    forces.push_back({touch.a, touch.b, b.position[touch.b] + arm, (1.0 / rules_.dt) * impulse});
  }
  return forces;
}

void ReferenceEngine::log_forces(StepLog& log) {
  const Bodies& b = state_.bodies;
  const auto seen_by = [&](std::int32_t i, Vec2 point) {
    return rotate({b.rotation[i].cosine, -b.rotation[i].sine}, point - b.position[i]);
  };
  for (const ContactForce& f : contact_forces())
    log.forces.push_back({state_.steps - 1, f, seen_by(f.a, f.point), seen_by(f.b, f.point)});
}

void ReferenceEngine::recall_points(std::vector<reference::Touch>& touches) const {
  for (reference::Touch& touch : touches)
    for (reference::TouchPoint& p : touch.points) {
      const std::uint64_t key = contact_key(touch.a, touch.b, p.feature);
      const auto found = std::find(impulse_key_.begin(), impulse_key_.end(), key);
      if (found == impulse_key_.end()) continue;
      const PointMemory& last = impulse_value_[found - impulse_key_.begin()];
      p.last = {last.impulse.normal, last.impulse.tangential};
      p.rise = last.rise;
    }
}

void ReferenceEngine::keep_impulses(const std::vector<reference::Touch>& touches) {
  impulse_key_.clear();
  impulse_value_.clear();
  for (const reference::Touch& touch : touches)
    for (const reference::TouchPoint& p : touch.points) {
      impulse_key_.push_back(contact_key(touch.a, touch.b, p.feature));
      impulse_value_.push_back(
          {{p.impulse.normal, p.impulse.tangential, p.repair}, rise_of_load(p.last.normal, p.impulse.normal)});
    }
}

void ReferenceEngine::check_finite() const {
  const Bodies& b = state_.bodies;
  for (std::size_t i = 0; i < b.count(); ++i) {
    const double sum = b.position[i].x + b.position[i].y + b.rotation[i].cosine + b.rotation[i].sine + b.velocity[i].x +
                       b.velocity[i].y + b.spin[i];
    if (!b.active[i] || std::isfinite(sum)) continue;
    throw Error(ExitCode::numerical_stop, "body " + std::to_string(i) + " has a non-finite state after time step " +
                                              std::to_string(state_.steps) +
                                              " (t = " + number_text(static_cast<double>(state_.steps) * rules_.dt, 9) +
                                              " s); try a smaller numerics.time_step_s");
  }
}

Ledger ReferenceEngine::ledger() {
  close_ledger(rules_, state_);
  return state_.ledger;
}

EngineState ReferenceEngine::save() {
  EngineState state{state_.steps, state_.bodies,  state_.ledger, {},
                    impulse_key_, impulse_value_, state_.broken, state_.dp};
  if (compliant_) compliant_->save(state);
  return state;
}

void ReferenceEngine::restore(const EngineState& state) {
  state_.bodies = state.bodies;
  state_.ledger = state.ledger;
  state_.steps = state.step;
  state_.broken = state.broken;
  state_.dp = state.dp;
  touches_.clear();
  impulse_key_ = state.impulse_key;
  impulse_value_ = state.impulse_value;
  if (compliant_) compliant_->restore(rules_.scene, state);
}

}  // namespace gem
