// Gathers the loads of every time step; at the end of a half load time splits floes in the saved state.
#include "gem/engine/breakup/breakup_engine.h"

#include <algorithm>
#include <utility>

#include "gem/field/floe_reserve.h"

namespace gem {
namespace {

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
  if (loaded.empty() || first_unborn(engine_->bodies()) + 2 > engine_->bodies().count()) return;
  std::vector<FloeCrack> cracks;
  for (const LoadedCrack& one : loaded) cracks.push_back(one.crack);
  EngineState state = engine_->save();
  const std::vector<FloeSplit> splits = split_floes(state.bodies, scene_, cracks);
  bool changed = false;
  for (std::size_t k = 0; k < splits.size(); ++k) {
    if (splits[k].result == FloeSplit::Result::too_small) continue;
    changed = changed || splits[k].result == FloeSplit::Result::split;
    const Bodies& b = state.bodies;
    const std::int32_t floe = cracks[k].floe;
    log.splits.push_back({double(state.step) * scene_.numerics.time_step_s, floe, splits[k],
                          b.position[floe] + rotate(b.rotation[floe], cracks[k].point),
                          rotate(b.rotation[floe], cracks[k].along), loaded[k].force, loaded[k].splitting_force,
                          crack_energy(scene_.breakup, b.thickness[floe], splits[k].length)});
  }
  if (!changed) return;
  drop_impulses(state);
  engine_->restore(state);
  loads_.drop_inactive(engine_->bodies());
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
