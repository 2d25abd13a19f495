#include "gem/engine/cpu/compliant_contacts.h"

#include <algorithm>

#include "gem/engine/contact/platform_substep.h"
#include "gem/engine/step/contact_stages.h"

namespace gem {

void CompliantContacts::set_up(std::int64_t substeps, const StepConstants& of_substep) {
  substeps_ = substeps;
  of_substep_ = of_substep;
  h_ = of_substep.dt;
}

void CompliantContacts::restore(const EngineState& state) {
  key_ = state.corner_key;
  memory_ = state.corner_value;
  energy_ = state.ledger.contact;
}

/// State of every pair and body at the start of the time step; the pairs of every body, in their order.
void CompliantContacts::lay_out() {
  const auto pairs = near_.pairs();
  opened_.assign(pairs.size(), {});
  push_.assign(pairs.size(), {});
  presses_.assign(pairs.size(), 0);
  // corners that overlapped at the end of the last time step: looked at, so that the books see how their contact ends
  for (std::size_t i = 0, k = 0; i < pairs.size() && k < key_.size();) {
    const std::uint64_t of_pair = contact_key(near_.body_id()[pairs[i].a], near_.body_id()[pairs[i].b], 0);
    const std::uint64_t of_key = contact_key(body_a_of(key_[k]), body_b_of(key_[k]), 0);
    presses_[i] = of_key == of_pair;
    if (of_key < of_pair)
      ++k;
    else
      ++i;
  }
  corner_key_.resize(near_.corners().size());
  const std::size_t bodies = near_.bodies().size();
  stray_.assign(bodies, 0.0);
  state_.clear();
  motion_.clear();
  for (std::size_t i = 0; i < bodies; ++i) {
    const SubBody& b = near_.bodies()[i];
    motion_.push_back({{}, 1.0, 0.0, b.start_velocity, b.start_spin, 0.0});
    const bool is_free = b.inverse_mass > 0.0 && static_cast<std::int32_t>(i) != near_.platform();
    state_.push_back(is_free ? free : moves);
  }
  row_begin_.assign(bodies + 1, 0);
  for (const PairInReach& pair : pairs) ++row_begin_[pair.a + 1], ++row_begin_[pair.b + 1];
  for (std::size_t i = 1; i < row_begin_.size(); ++i) row_begin_[i] += row_begin_[i - 1];
  row_.resize(2 * pairs.size());
  std::vector<std::int32_t> next(row_begin_.begin(), row_begin_.end() - 1);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    row_[next[pairs[i].a]++] = static_cast<std::int32_t>(2 * i);
    row_[next[pairs[i].b]++] = static_cast<std::int32_t>(2 * i + 1);
  }
}

void CompliantContacts::begin(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  near_.find(f, contacts, substeps_, team, rank);
  team.barrier();
  team.single(rank, [&] {
    part_.resize(std::max(part_.size(), static_cast<std::size_t>(team.size())));
    for (Part& part : part_) part.blocks.clear();
    lay_out();
  });
}

/// What a corner keeps from the last time step; null: nothing.
CornerMemory* CompliantContacts::remembered(std::uint64_t key) {
  const auto at = std::lower_bound(key_.begin(), key_.end(), key);
  return at != key_.end() && *at == key ? &memory_[at - key_.begin()] : nullptr;
}

/// Fills the lane of a pair: geometry at the start of the time step, law, memory.
void CompliantContacts::open(const FieldState& f, Contacts contacts, std::int32_t id, int part) {
  const PairInReach& pair = near_.pairs()[id];
  const Bodies& b = f.bodies;
  const Events& e = f.constants.events;
  const Contact& contact = *contacts[pair.contact];
  const bool ice = b.kind[contact.a] == BodyKind::floe || b.kind[contact.b] == BodyKind::floe;
  const double thickness = crushed_thickness(f, contact);
  const CrushingIce of_pair = crushing_ice(e, thickness);
  const double bound = ice && e.contact.crushing_limit ? crushing_force(of_pair, 1.0) : -1.0;
  PairBlocks& blocks = part_[part].blocks;
  const PairLane lane = blocks.add(id, pair.count, bound, 1.0 + of_pair.exponent);
  opened_[id] = {part, lane};
  const double inverse_mass = b.inverse_mass[contact.a] + b.inverse_mass[contact.b];
  const std::int32_t owner = f.constants.owner_of(contact.a);
  CornerAtStart s;
  s.full_stiffness = corner_stiffness(e.contact, thickness, ice);
  const CornerLaw of_ice{s.full_stiffness, corner_damping(e.contact, s.full_stiffness, inverse_mass),
                         friction_of_pair(e, f.constants.is_platform(contact.a))};
  for (std::int32_t k = 0; k < pair.count; ++k) {
    const CornerInReach& one = near_.corners()[pair.first + k];
    const Contact& of_piece = *contacts[one.contact];
    const std::int32_t p = one.p(of_piece), q = one.q(of_piece);
    s.of_b = one.of_b;
    s.surface = near_.surface_of(f, q);
    s.first_side = b.vertex_begin[q] - b.vertex_begin[f.constants.owner_of(q)];
    s.tip = tip_of(f.outline(p), one.corner);
    s.between = start_of(f, p) - start_of(f, q);
    const Vec2 arm_q = s.between + s.tip.at;
    const auto mass_of = [&](std::int32_t entry) {
      const SubBody& body = near_.bodies()[entry];
      return shared_mass({body.inverse_mass, body.inverse_inertia}, near_.share(entry));
    };
    const ContactCompliance compliance =
        contact_compliance(mass_of(s.of_b ? pair.b : pair.a), s.tip.at, mass_of(s.of_b ? pair.a : pair.b), arm_q,
                           s.surface.outline.normal[nearest_met_side(s.surface, arm_q, s.tip).side]);
    s.law = stable_law(of_ice, h_, larger(compliance.nn, compliance.tt));
    const std::int32_t vertex = b.vertex_begin[p] - b.vertex_begin[one.of_b ? contact.b : owner] + one.corner;
    const std::uint64_t key = corner_key_[pair.first + k] = corner_key(owner, contact.b, vertex, one.of_b);
    const CornerMemory* memory = remembered(key);
    // a corner at a joint is near several pieces; the one that it is in has its memory
    s.overlapped = memory && (f.constants.pieces == 1 || outermost_side(s.surface, arm_q).distance < tie);
    s.memory = s.overlapped ? *memory : CornerMemory{};
    // a stiffness does not rise while its spring is stretched, even if its dashpot holds it
    if (s.memory.elastic > 0.0) s.law.stiffness = smaller(s.law.stiffness, s.memory.stiffness);
    blocks.set_corner(lane, k, s);
  }
}

void CompliantContacts::look_and_press(const FieldState& f, Contacts contacts, std::int64_t substep, std::int64_t begin,
                                       std::int64_t end, int rank) {
  const auto n = static_cast<double>(substep);
  const double t = n * h_;
  const auto pairs = near_.pairs();
  SubMotion alone[2];
  const auto mover = [&](std::int32_t entry, SubMotion& room) -> MotionRow {
    if (state_of(entry) == moves) return {&motion_[entry], true};
    room = after_free_motion(near_.bodies()[entry], n, h_);
    return {&room, false};
  };
  PairBlocks& blocks = part_[rank].blocks;
  for (std::int64_t i = begin; i < end; ++i) {
    const PairInReach& pair = pairs[i];
    if (!presses_[i] && is_apart(pair.watch, t, stray_[pair.a], stray_[pair.b])) continue;
    if (opened_[i].part < 0) open(f, contacts, static_cast<std::int32_t>(i), rank);
    blocks.look(opened_[i].lane, mover(pair.a, alone[0]), mover(pair.b, alone[1]));
  }
  blocks.press(h_, push_, presses_);
  for (const std::int32_t i : blocks.pressed()) {
    note_touch(pairs[i].a);
    note_touch(pairs[i].b);
  }
}

/// Impulse and twists of all pairs on a body, as on a b.
PairPush CompliantContacts::sum_of(std::int64_t entry) const {
  PairPush sum;
  for (std::int32_t r = row_begin_[entry]; r < row_begin_[entry + 1]; ++r) {
    const PairPush& one = push_[row_[r] / 2];
    const bool is_b = row_[r] % 2 != 0;
    sum.impulse += is_b ? one.impulse : -one.impulse;
    sum.twist_b += is_b ? one.twist_b : one.twist_a;
  }
  return sum;
}

void CompliantContacts::move_platform(FieldState& f) {
  SubBody& b = near_.bodies()[near_.platform()];
  SubMotion& m = motion_[near_.platform()];
  const PairPush sum = sum_of(near_.platform());
  push(b, m, sum.impulse, sum.twist_b);
  const double angle = platform_substep(f, of_substep_, {m.velocity, m.spin});
  m.velocity = f.bodies.velocity[0];
  m.spin = f.bodies.spin[0];
  m.shift = f.bodies.position[0] - f.platform_position;
  set_turn(m, m.turn + angle);
}

void CompliantContacts::move_bodies(FieldState& f, std::int64_t substep, const ThreadTeam& team, int rank) {
  const auto n = static_cast<std::int64_t>(state_.size());
  const auto done = static_cast<double>(substep);
  for (std::int64_t i = team.begin_of(rank, n); i < team.begin_of(rank + 1, n); ++i) {
    SubBody& b = near_.bodies()[i];
    SubMotion& m = motion_[i];
    if (i == near_.platform())
      move_platform(f);
    else if (state_[i] == free || !(b.inverse_mass > 0.0))
      continue;
    else {
      if (state_[i] == touched) {
        m = after_free_motion(b, done, h_);
        book_free_motion(b, done, h_);
        state_[i] = moves;
      }
      const PairPush sum = sum_of(i);
      move(b, m, sum.impulse, sum.twist_b, h_);
    }
    stray_[i] = stray_of(b, m, done + 1.0, h_);
  }
}

void CompliantContacts::run(FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  const auto pairs = static_cast<std::int64_t>(near_.pairs().size());
  for (std::int64_t s = 0; s < substeps_; ++s) {
    look_and_press(f, contacts, s, team.begin_of(rank, pairs), team.begin_of(rank + 1, pairs), rank);
    team.barrier();
    move_bodies(f, s, team, rank);
    team.barrier();
  }
}

void CompliantContacts::remember() {
  std::vector<std::pair<std::uint64_t, CornerMemory>> order;
  for (std::size_t i = 0; i < opened_.size(); ++i) {
    const Opened& at = opened_[i];
    if (at.part < 0) continue;
    const PairInReach& pair = near_.pairs()[i];
    const PairBlocks& blocks = part_[at.part].blocks;
    for (std::int32_t k = 0; k < pair.count; ++k)
      if (blocks.overlaps(at.lane, k)) order.emplace_back(corner_key_[pair.first + k], blocks.memory(at.lane, k));
  }
  std::stable_sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  key_.clear();
  memory_.clear();
  for (const auto& [key, memory] : order) {
    if (!key_.empty() && key_.back() == key) continue;  // two pieces of the platform have the same corner
    key_.push_back(key);
    memory_.push_back(memory);
  }
}

void CompliantContacts::finish(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, StepQuality& quality,
                               StepLog& log) {
  team.single(rank, [&] {
    tell(f, contacts, quality, log);
    remember();
  });
  team.for_each(rank, static_cast<std::int64_t>(state_.size()),
                [&](std::int64_t i) { hand_back(f, static_cast<std::int32_t>(i)); });
}

}  // namespace gem
