// Gathers the loads of every time step; at the end of a half load time splits floes in the saved state.
#include "gem/engine/breakup/breakup_engine.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "gem/engine/breakup/corner_heirs.h"
#include "gem/field/floe_reserve.h"

namespace gem {
namespace {

std::vector<FloeSplit> splits_of(const std::vector<SplitEvent>& events) {
  std::vector<FloeSplit> splits;
  for (const SplitEvent& event : events) splits.push_back(event.split);
  return splits;
}

/// The floes that split have no contacts any more: what the solver remembers of them goes.
void drop_impulses(EngineState& state) {
  std::size_t kept = 0;
  const auto& active = state.bodies.active;
  for (std::size_t k = 0; k < state.impulse_key.size(); ++k) {
    const std::uint64_t key = state.impulse_key[k];
    if (!active[body_a_of(key)] || !active[body_b_of(key)]) continue;
    state.impulse_key[kept] = key;
    state.impulse_value[kept++] = state.impulse_value[k];
  }
  state.impulse_key.resize(kept);
  state.impulse_value.resize(kept);
}

}  // namespace

BreakupEngine::BreakupEngine(const SceneDef& scene, std::unique_ptr<Engine> engine)
    : scene_(scene), engine_(std::move(engine)), loads_(scene) {
  if (!engine_->has_contact_forces()) refuse_breakup(engine_->name());
}

void BreakupEngine::advance(std::int64_t steps, StepLog& log) {
  for (std::int64_t end = step() + steps; step() < end;) {
    engine_->advance(begin(end - step(), log), log);
    look_at(log);
  }
}

std::int64_t BreakupEngine::begin(std::int64_t steps, StepLog& log) {
  begun_ = step();
  log.wants_forces = true;
  log.forces.clear();
  return std::min(steps, loads_.steps_to_end(step()));
}

void BreakupEngine::look_at(StepLog& log) {
  loads_.add(log.forces);
  log.wants_forces = false;
  log.forces.clear();
  if (step() == begun_) return;  // a half that ended was looked at
  forces_ = engine_->contact_forces();
  if (loads_.ends_with(step())) split(log);
}

void BreakupEngine::split(StepLog& log) {
  const std::vector<LoadedCrack> loaded = loads_.close_half(engine_->bodies());
  if (loaded.empty() || loads_.is_full() || first_unborn(engine_->bodies()) + 2 > engine_->bodies().count()) return;
  std::vector<FloeCrack> cracks;
  for (const LoadedCrack& one : loaded) cracks.push_back(one.crack);
  EngineState state = engine_->save();
  const std::vector<FloeSplit> splits = split_floes(state.bodies, scene_, cracks);
  std::vector<SplitEvent> made;
  for (std::size_t k = 0; k < splits.size(); ++k) {
    const FloeSplit::Result result = splits[k].result;
    if (result == FloeSplit::Result::too_small) continue;
    const Bodies& b = state.bodies;
    const std::int32_t floe = cracks[k].floe;
    const SplitEvent event = {double(state.step) * scene_.numerics.time_step_s,
                              splits[k],
                              b.position[floe] + rotate(b.rotation[floe], cracks[k].point),
                              rotate(b.rotation[floe], cracks[k].along),
                              loaded[k].force,
                              loaded[k].splitting_force,
                              crack_energy(scene_.breakup, b.thickness[floe], splits[k].length)};
    log.splits.push_back(event);
    if (result == FloeSplit::Result::split) made.push_back(event);
    if (result == FloeSplit::Result::no_room) loads_.set_full();
  }
  if (made.empty()) return;
  for (const SplitEvent& event : made) loads_.add_crack(event.energy);
  drop_impulses(state);
  if (scene_.contact.solver == ContactSolver::compliant) hand_on_corners(state, splits_of(made));
  engine_->restore(state);
  loads_.drop_inactive(engine_->bodies());
  name_pieces(made);
}

/// A force on a floe that has just split is one on the piece that has its point. A point on the crack counts for the
/// left piece.
void BreakupEngine::name_pieces(const std::vector<SplitEvent>& splits) {
  const auto name = [&](std::int32_t& body, Vec2 point) {
    for (const SplitEvent& s : splits)
      if (s.split.floe == body) {
        body = s.split.piece[cross(s.along, point - s.point) < 0.0 ? 1 : 0];
        return;
      }
  };
  for (ContactForce& contact : forces_) {
    name(contact.a, contact.point);
    name(contact.b, contact.point);
    if (contact.a < contact.b) continue;
    std::swap(contact.a, contact.b);
    contact.force = -1.0 * contact.force;
  }
  std::sort(forces_.begin(), forces_.end(),
            [](const ContactForce& p, const ContactForce& q) { return std::tie(p.a, p.b) < std::tie(q.a, q.b); });
}

Ledger BreakupEngine::ledger() {
  Ledger ledger = engine_->ledger();
  ledger.crack_energy = -loads_.sums().crack_energy;
  ledger[Channel::impact].energy -= ledger.crack_energy;
  return ledger;
}

EngineState BreakupEngine::save() {
  EngineState state = engine_->save();
  state.loads = loads_.sums();
  return state;
}

void BreakupEngine::restore(const EngineState& state) {
  engine_->restore(state);
  loads_.restore(state.loads);
  forces_.clear();
}

}  // namespace gem
