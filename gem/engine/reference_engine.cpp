#include "gem/engine/reference_engine.h"

#include <algorithm>
#include <set>
#include <utility>

#include "gem/engine/books.h"
#include "gem/engine/contact_stages.h"
#include "gem/engine/solo_stages.h"

namespace gem {

ReferenceEngine::ReferenceEngine(const SceneDef& scene, Bodies bodies)
    : event_speed_(scene.output.event_speed_m_per_s) {
  const MomentConstants constants = moment_constants(scene, bodies);
  field_ = make_field_state(std::move(bodies), constants);
  ledger_.start = total(field_);
}

std::vector<Contact> ReferenceEngine::all_contacts() const {
  const Bodies& b = field_.bodies;
  std::vector<Contact> contacts;
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(b.count()); ++i)
    for (std::int32_t j = i + 1; j < static_cast<std::int32_t>(b.count()); ++j) {
      if (!b.active[i] || !b.active[j] || (b.inverse_mass[i] == 0.0 && b.inverse_mass[j] == 0.0)) continue;
      SeparatingAxes unknown;
      Contact contact;
      if (find_contact(field_, i, j, unknown, 0.0, contact)) contacts.push_back(contact);
    }
  return contacts;
}

void ReferenceEngine::advance(std::int64_t moments, MomentLog& log) {
  FieldState& f = field_;
  check_finite(f, moment_);
  for (std::int64_t m = 0; m < moments; ++m) {
    const PlatformImpulses before = platform_impulses(f);
    std::vector<Contact> contacts = all_contacts();
    std::vector<Contact*> view;
    for (Contact& contact : contacts) view.push_back(&contact);
    for (std::size_t i = 0; i < f.bodies.count(); ++i)
      if (f.bodies.kind[i] == BodyKind::floe) kick_floe(f, i);
    platform_first_half(f);
    MomentQuality quality = contact_quality(view);
    if (f.constants.resolution == Resolution::coupled) {
      resolve_coupled(contacts, quality);
    } else {
      for (Contact& contact : contacts) prepare_contact(f, contact, 1.0);
      for (Contact& contact : contacts) resolve_alone(f, contact);
      for (Contact& contact : contacts) apply_impulses(f.bodies, contact, true);
    }
    for (const Contact& contact : contacts) book_contact(f, contact);
    log_events(f, view, moment_, event_speed_, log);
    for (std::size_t i = 0; i < f.bodies.count(); ++i)
      if (f.bodies.kind[i] == BodyKind::floe) drift_floe(f, i);
    platform_second_half(f);
    ++moment_;
    check_finite(f, moment_);
    retire(f);
    log_moment(f, view, before, quality, log);
  }
}

void ReferenceEngine::sum_on_platform(const std::vector<Contact>& contacts, Vec2 velocity, double spin,
                                      std::int32_t sweep) {
  Vec2 impulse, shift;
  double twist = 0.0, turn = 0.0;
  for (const Contact& contact : contacts)
    for (int k = 0; k < contact.count && contact.a == 0; ++k) {
      const ContactSlot& slot = contact.slot[k];
      const Vec2 p = slot.impulse.normal * contact.normal + slot.impulse.tangential * turned_left(contact.normal);
      impulse += p;
      twist += cross(slot.arm_a, p);
      shift += slot.repair * contact.normal;
      turn += cross(slot.arm_a, slot.repair * contact.normal);
    }
  const CollisionMass mass = collision_mass(field_.bodies, 0);
  place_platform(field_, velocity - mass.inverse_mass * impulse, spin - mass.inverse_inertia * twist, sweep);
  field_.repair_shift[0] = -(mass.inverse_mass * shift);
  field_.repair_turn[0] = -(mass.inverse_inertia * turn);
}

void ReferenceEngine::resolve_coupled(std::vector<Contact>& contacts, MomentQuality& quality) {
  FieldState& f = field_;
  double platform_points = 0.0;
  for (const Contact& contact : contacts)
    if (contact.a == 0) platform_points += contact.count;

  // each contact takes the lowest colour that no earlier contact of its moving bodies has
  std::vector<std::set<int>> taken(f.bodies.count());
  std::map<int, std::vector<Contact*>> colours;
  for (Contact& contact : contacts) {
    prepare_contact(f, contact, platform_points);
    for (int k = 0; k < contact.count; ++k) {
      const auto last = last_.find(contact_key(contact.a, contact.b, contact.slot[k].feature));
      if (last != last_.end()) contact.slot[k].impulse = last->second;
    }
    const bool a_moves = sweeps_write_a(f.bodies, contact), b_moves = f.bodies.inverse_mass[contact.b] > 0.0;
    int colour = 0;
    while ((a_moves && taken[contact.a].count(colour)) || (b_moves && taken[contact.b].count(colour))) ++colour;
    if (a_moves) taken[contact.a].insert(colour);
    if (b_moves) taken[contact.b].insert(colour);
    colours[colour].push_back(&contact);
  }

  const Vec2 velocity = f.bodies.velocity[0];
  const double spin = f.bodies.spin[0];
  for (auto& [colour, group] : colours)
    for (Contact* contact : group) apply_impulses(f.bodies, *contact, sweeps_write_a(f.bodies, *contact));
  sum_on_platform(contacts, velocity, spin, 0);
  std::fill(f.changed.begin(), f.changed.end(), 0);
  bool all = true;
  while (!contacts.empty()) {
    ++quality.iterations;
    quality.residual = 0.0;
    for (auto& [colour, group] : colours)
      for (Contact* contact : group)
        if (all || wants_visit(f, *contact, quality.iterations))
          quality.residual = std::max(quality.residual, resolve_together(f, *contact, quality.iterations));
    sum_on_platform(contacts, velocity, spin, quality.iterations);
    const bool settled = quality.residual <= f.constants.residual_speed;
    if ((settled && all) || quality.iterations >= f.constants.iterations_maximum) break;
    all = settled;
  }
  for (std::int64_t sweep = 0; sweep < f.constants.repair_iterations; ++sweep) {
    for (auto& [colour, group] : colours)
      for (Contact* contact : group) repair_overlap(f, *contact);
    sum_on_platform(contacts, velocity, spin, quality.iterations);
  }

  last_.clear();
  for (const Contact& contact : contacts)
    for (int k = 0; k < contact.count; ++k)
      last_[contact_key(contact.a, contact.b, contact.slot[k].feature)] = contact.slot[k].impulse;
}

Ledger ReferenceEngine::ledger() { return closed_books(field_, ledger_); }

EngineState ReferenceEngine::save() {
  EngineState state{moment_, field_.bodies, closed_books(field_, ledger_), {}, {}};
  for (const auto& [key, impulse] : last_) {
    state.impulse_key.push_back(key);
    state.impulse_value.push_back({impulse.normal, impulse.tangential});
  }
  return state;
}

void ReferenceEngine::restore(const EngineState& state) {
  field_ = make_field_state(state.bodies, field_.constants);
  open_books(field_, state.ledger);
  ledger_ = state.ledger;
  moment_ = state.moment;
  last_.clear();
  for (std::size_t i = 0; i < state.impulse_key.size(); ++i)
    last_[state.impulse_key[i]] = {state.impulse_value[i].x, state.impulse_value[i].y};
}

}  // namespace gem
