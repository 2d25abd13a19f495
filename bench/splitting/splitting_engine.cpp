#include "bench/splitting/splitting_engine.h"

#include <algorithm>
#include <ctime>

#include "gem/engine/step/contact_stages.h"

namespace gem::bench {
namespace {

SceneDef with_one_iteration(SceneDef scene) {
  scene.numerics.iterations_maximum = 1;
  return scene;
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

SplittingEngine::SplittingEngine(const SceneDef& scene, Bodies bodies, double tolerance, int iterations_maximum)
    : CpuEngine(with_one_iteration(scene), std::move(bodies), 1, 256),
      tolerance_(tolerance),
      iterations_maximum_(iterations_maximum) {}

EngineState SplittingEngine::save() {
  EngineState state = CpuEngine::save();
  state.impulse_key = keys_;
  state.impulse_value = memory_;
  return state;
}

void SplittingEngine::restore(const EngineState& state) {
  CpuEngine::restore(state);
  keys_ = state.impulse_key;
  memory_ = state.impulse_value;
}

void SplittingEngine::before_contact_events() {
  velocity_ = field().bodies.velocity;
  spin_ = field().bodies.spin;
}

/// Keys ascend by pair; the features of a pair stand in any order.
PointMemory SplittingEngine::memory_of(std::uint64_t key) const {
  const std::uint64_t pair = key >> feature_bits << feature_bits;
  for (auto at = std::lower_bound(
           keys_.begin(), keys_.end(), pair,
           [](std::uint64_t one, std::uint64_t first) { return one >> feature_bits << feature_bits < first; });
       at != keys_.end() && *at >> feature_bits << feature_bits == pair; ++at)
    if (*at == key) return memory_[at - keys_.begin()];
  return {};
}

/// Hands bodies and points to the iteration.
void SplittingEngine::gather() {
  FieldState& f = field();
  const Bodies& b = f.bodies;
  place_.assign(b.count(), SplitIteration::fixed);
  moving_.clear();
  std::int32_t points = 0;
  for (const Contact* contact : contacts()) {
    for (const std::int32_t i : {contact->a, contact->b})
      if (b.inverse_mass[i] > 0.0) place_[i] = 0;
    points += contact->count;
  }
  for (std::size_t i = 0; i < b.count(); ++i) {
    if (place_[i] == SplitIteration::fixed) continue;
    place_[i] = static_cast<std::int32_t>(moving_.size());
    moving_.push_back(static_cast<std::int32_t>(i));
  }
  iteration_.begin(static_cast<std::int32_t>(moving_.size()), points);
  for (const std::int32_t i : moving_)
    iteration_.set_body(place_[i], {b.position[i], velocity_[i], spin_[i], b.inverse_mass[i], b.inverse_inertia[i]});
  geometry_.resize(points);
  next_keys_.resize(points);
  next_memory_.resize(points);
  std::int32_t point = 0;
  for (Contact* contact : contacts())
    for (int k = 0; k < contact->count; ++k, ++point) {
      const std::uint64_t key = contact_key(contact->a, contact->b, contact->slot[k].feature);
      next_keys_[point] = key;
      const PointMemory last = memory_of(key);
      recall(f.constants, *contact, contact->slot[k], collision_mass(b, contact->a), collision_mass(b, contact->b),
             last);
      PointGeometry<double>& g = geometry_[point];
      g = point_of_contact(f, *contact, contact->slot[k], 1, 1, last);
      PointImpulse<double>& p = next_memory_[point].impulse;
      p = last.impulse;
      p.repair = repair_to_go_on(f.constants, p.repair, g.nn);
      iteration_.set_point(point, {place_[contact->a], place_[contact->b], &g, &p, contact->slot[k].spare});
    }
}

/// Writes impulses to the contacts, and velocities and repairs to the bodies.
void SplittingEngine::settle() {
  FieldState& f = field();
  std::vector<Push<double>> push(moving_.size(), Push<double>{});
  std::int32_t point = 0;
  for (Contact* contact : contacts())
    for (int k = 0; k < contact->count; ++k, ++point) {
      const PointGeometry<double>& g = geometry_[point];
      const PointImpulse<double>& p = next_memory_[point].impulse;
      next_memory_[point].rise = rise_of_load(contact->slot[k].last_normal, p.normal);
      contact->slot[k].cap = g.cap;
      contact->slot[k].impulse = {p.normal, p.tangential};
      contact->slot[k].repair = p.repair;
      const std::int32_t a = place_[contact->a], b = place_[contact->b];
      if (a != SplitIteration::fixed) add(push[a], -1.0, push_of(g, p, g.lever_a_n, g.lever_a_t));
      if (b != SplitIteration::fixed) add(push[b], 1.0, push_of(g, p, g.lever_b_n, g.lever_b_t));
    }
  for (const std::int32_t i : moving_) {
    const Motion<double> m = moved_by(push[place_[i]], velocity_[i].x, velocity_[i].y, spin_[i],
                                      f.bodies.inverse_mass[i], f.bodies.inverse_inertia[i]);
    f.bodies.velocity[i] = {m.x, m.y};
    f.bodies.spin[i] = m.spin;
    apply_repair(f, i, {{m.shift_x, m.shift_y}, m.turn});
  }
  keys_.swap(next_keys_);
  memory_.swap(next_memory_);
}

void SplittingEngine::after_contact_events() {
  const double start = processor_seconds();
  gather();
  results_.push_back(
      iteration_.iterate({field().constants.point_friction, tolerance_, field().constants.dt, iterations_maximum_}));
  settle();
  seconds_ += processor_seconds() - start;
}

}  // namespace gem::bench
