#include "gem/engine/cpu/compliant_contacts.h"

#include <algorithm>
#include <cmath>

#include "gem/engine/contact/corners.h"
#include "gem/engine/contact/platform_substep.h"
#include "gem/engine/step/contact_stages.h"

namespace gem {
namespace {

std::int32_t body_p(const Contact& c, bool of_b) { return of_b ? c.b : c.a; }
std::int32_t body_q(const Contact& c, bool of_b) { return of_b ? c.a : c.b; }

/// Where two corners are side by side, the one of the pair's second body presses [m].
constexpr double tie = 1e-9;

/// How far two bodies may close in a time step, from their present motion and what drives them [m].
double reach_of(const FieldState& f, std::int32_t a, std::int32_t b) {
  const Bodies& s = f.bodies;
  const double closing = length(s.velocity[b] - s.velocity[a]) + magnitude(s.spin[a]) * s.radius[a] +
                         magnitude(s.spin[b]) * s.radius[b];
  return smaller(f.constants.dt * (closing + f.constants.drive_speed), f.constants.contact_margin);
}

}  // namespace

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

void CompliantContacts::note_velocities(const FieldState& f) {
  velocity_before_ = f.bodies.velocity;
  spin_before_ = f.bodies.spin;
}

Surface CompliantContacts::surface_of(const FieldState& f, std::int32_t body) const {
  const std::uint8_t* hidden = nullptr;
  if (!hidden_side_.empty() && f.constants.is_platform(body)) hidden = &hidden_side_[f.bodies.vertex_begin[body]];
  return {f.outline(body), hidden};
}

/// A floe that is hit may close as fast on the next one, so a pair reaches as far as its floes' pairs do.
void CompliantContacts::find_reach(const FieldState& f, Contacts contacts) {
  approach_.assign(f.bodies.count(), 0.0);
  for (const Contact* contact : contacts) {
    const double reach = reach_of(f, contact->a, contact->b) + 2.0 * tie;
    for (const std::int32_t i : {contact->a, contact->b})
      if (f.bodies.kind[i] == BodyKind::floe) approach_[i] = larger(approach_[i], reach);
  }
}

void CompliantContacts::find(const FieldState& f, Contacts contacts, const ThreadTeam& team, int rank) {
  std::vector<Found>& found = part_[rank].found;
  found.clear();
  const auto n = static_cast<std::int64_t>(contacts.size());
  for (std::int64_t c = team.begin_of(rank, n); c < team.begin_of(rank + 1, n); ++c) {
    const Contact& contact = *contacts[c];
    const auto take = [&](bool of_b, std::int32_t corner, std::int32_t side) {
      const std::int32_t vertex = f.bodies.vertex_begin[body_p(contact, of_b)] + corner;
      if (!no_corner_.empty() && f.constants.is_platform(body_p(contact, of_b)) && no_corner_[vertex]) return;
      found.push_back({static_cast<std::int32_t>(c), corner, side, of_b});
    };
    const Outline a = f.outline(contact.a), b = f.outline(contact.b);
    const Vec2 offset = f.bodies.position[contact.b] - f.bodies.position[contact.a], axis = contact.normal;
    const double reach = larger(approach_[contact.a], approach_[contact.b]);
    double top = -1e300, bottom = 1e300;  // of a and of b along the axis
    for (int k = 0; k < a.count; ++k) top = larger(top, dot(axis, a.corner[k]));
    for (int k = 0; k < b.count; ++k) bottom = smaller(bottom, dot(axis, offset + b.corner[k]));
    if (!(bottom - top < reach)) continue;
    corners_near(b, surface_of(f, contact.a), offset, axis, top + reach, reach,
                 [&](std::int32_t corner, std::int32_t side) { take(true, corner, side); });
    corners_near(a, surface_of(f, contact.b), -offset, -axis, dot(axis, offset) - bottom + reach, reach,
                 [&](std::int32_t corner, std::int32_t side) { take(false, corner, side); });
  }
}

std::int32_t CompliantContacts::enter(const FieldState& f, std::int32_t body) {
  std::int32_t& entry = entry_of_[body];
  if (entry >= 0) return entry;
  entry = static_cast<std::int32_t>(body_.size());
  const Bodies& b = f.bodies;
  SubBody s;
  s.inverse_mass = b.inverse_mass[body];
  s.inverse_inertia = b.inverse_inertia[body];
  s.mass = b.mass[body];
  s.inertia = b.inertia[body];
  s.velocity = velocity_before_[body];
  s.spin = spin_before_[body];
  if (b.kind[body] == BodyKind::floe) {
    const double share = 1.0 / static_cast<double>(substeps_);
    s.kick = share * (b.velocity[body] - velocity_before_[body]);
    s.kick_spin = share * (b.spin[body] - spin_before_[body]);
  }
  body_.push_back(s);
  body_id_.push_back(body);
  corners_.push_back(0);
  return entry;
}

/// Pairs and bodies in order of the contacts, whichever thread found the corners.
void CompliantContacts::lay_out(const FieldState& f, Contacts contacts, int threads) {
  for (const std::int32_t body : body_id_) entry_of_[body] = -1;
  entry_of_.resize(f.bodies.count(), -1);
  found_.clear();
  pair_.clear();
  body_.clear();
  body_id_.clear();
  corners_.clear();
  for (int r = 0; r < threads; ++r) found_.insert(found_.end(), part_[r].found.begin(), part_[r].found.end());
  const auto bodies_of = [&](const Found& one) {
    const Contact& contact = *contacts[one.contact];
    return std::pair(f.constants.owner_of(contact.a), contact.b);
  };
  // what a body has with several pieces of the platform is one contact
  if (f.constants.pieces > 1)
    std::stable_sort(found_.begin(), found_.end(),
                     [&](const Found& a, const Found& b) { return bodies_of(a) < bodies_of(b); });
  for (std::size_t k = 0; k < found_.size(); ++k) {
    if (k == 0 || bodies_of(found_[k]) != bodies_of(found_[k - 1])) {
      pair_.push_back({});
      pair_.back().first = static_cast<std::int32_t>(k);
      pair_.back().contact = found_[k].contact;
    }
    ++pair_.back().count;
  }
  platform_ = f.constants.events.platform_present ? enter(f, 0) : -1;
  for (const SubPair& pair : pair_) {
    const Contact& contact = *contacts[pair.contact];
    corners_[enter(f, f.constants.owner_of(contact.a))] += pair.count;
    corners_[enter(f, contact.b)] += pair.count;
  }
  point_.resize(found_.size());
  point_key_.resize(found_.size());
}

/// What the corner remembers; its stiffness does not rise while its spring is stretched, even if its dashpot holds it.
void CompliantContacts::keep(SubPoint& point, std::uint64_t key) {
  const auto at = std::lower_bound(key_.begin(), key_.end(), key);
  if (at != key_.end() && *at == key) {
    point.memory = memory_[at - key_.begin()];
    point.overlaps = true;
    if (point.memory.elastic > 0.0) point.law.stiffness = smaller(point.law.stiffness, point.memory.stiffness);
  }
}

void CompliantContacts::fill(const FieldState& f, Contacts contacts, SubPair& pair, std::int32_t from) {
  const Bodies& b = f.bodies;
  const Events& e = f.constants.events;
  const Contact& contact = *contacts[pair.contact];
  const bool ice = b.kind[contact.a] == BodyKind::floe || b.kind[contact.b] == BodyKind::floe;
  const double thickness = crushed_thickness(f, contact);
  const CrushingIce of_pair = crushing_ice(e, thickness);
  pair.bound = ice && e.contact.crushing_limit ? crushing_force(of_pair, 1.0) : -1.0;
  pair.exponent = 1.0 + of_pair.exponent;
  const double stiffness = corner_stiffness(e.contact, thickness, ice);
  const double inverse_mass = b.inverse_mass[contact.a] + b.inverse_mass[contact.b];
  for (std::int32_t k = from; k < from + pair.count; ++k) {
    const Found& found = found_[k];
    const Contact& of_piece = *contacts[found.contact];
    SubPoint& s = point_[k];
    s = {};
    const std::int32_t p = body_p(of_piece, found.of_b), q = body_q(of_piece, found.of_b);
    s.p = entry_of_[f.constants.owner_of(p)];
    s.q = entry_of_[f.constants.owner_of(q)];
    const Outline own = f.outline(p);
    s.surface = surface_of(f, q);
    s.corner = own.corner[found.corner];
    s.flank[0] = own.corner[found.corner > 0 ? found.corner - 1 : own.count - 1] - s.corner;
    s.flank[1] = own.corner[found.corner + 1 < own.count ? found.corner + 1 : 0] - s.corner;
    s.between = b.position[p] - b.position[q];
    s.normal = s.surface.outline.normal[found.side];
    s.offset = dot(s.normal, s.surface.outline.corner[found.side]);
    const Vec2 arm_q = s.between + s.corner;
    s.slack = found.of_b ? tie : -tie;
    const SubBody &of_p = body_[s.p], &of_q = body_[s.q];
    const CollisionMass mass_p = shared_mass({of_p.inverse_mass, of_p.inverse_inertia}, corners_[s.p]);
    const CollisionMass mass_q = shared_mass({of_q.inverse_mass, of_q.inverse_inertia}, corners_[s.q]);
    const ContactCompliance compliance = contact_compliance(mass_p, s.corner, mass_q, arm_q, s.normal);
    s.full_stiffness = stiffness;
    s.law = stable_law({stiffness, corner_damping(e.contact, stiffness, inverse_mass),
                        friction_of_pair(e, f.constants.is_platform(contact.a))},
                       h_, larger(compliance.nn, compliance.tt));
    point_key_[k] = contact_key(of_piece.a, of_piece.b, 2 * found.corner + (found.of_b ? 1 : 0));
    keep(s, point_key_[k]);
  }
}

/// Lists the points of every body, in order of the points.
void CompliantContacts::sum_rows() {
  row_begin_.assign(body_.size() + 1, 0);
  for (const SubPoint& s : point_) ++row_begin_[s.p + 1], ++row_begin_[s.q + 1];
  for (std::size_t i = 1; i < row_begin_.size(); ++i) row_begin_[i] += row_begin_[i - 1];
  row_.resize(2 * point_.size());
  std::vector<std::int32_t> next(row_begin_.begin(), row_begin_.end() - 1);
  for (std::size_t k = 0; k < point_.size(); ++k) {
    row_[next[point_[k].p]++] = static_cast<std::int32_t>(2 * k);
    row_[next[point_[k].q]++] = static_cast<std::int32_t>(2 * k + 1);
  }
}

void CompliantContacts::begin(const FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  team.single(rank, [&] {
    part_.resize(std::max(part_.size(), static_cast<std::size_t>(team.size())));
    if (f.piece_corner.empty() || !hidden_side_.empty()) return;
    hidden_side_.resize(f.piece_corner.size());
    no_corner_.resize(f.piece_corner.size());
    find_hidden(f, hidden_side_, no_corner_);
  });
  team.single(rank, [&] { find_reach(f, contacts); });
  find(f, contacts, team, rank);
  team.barrier();
  team.single(rank, [&] { lay_out(f, contacts, team.size()); });
  team.for_each(rank, static_cast<std::int64_t>(pair_.size()),
                [&](std::int64_t i) { fill(f, contacts, pair_[i], pair_[i].first); });
  team.single(rank, [&] { sum_rows(); });
}

void CompliantContacts::move_platform(FieldState& f) {
  Vec2 impulse;
  double twist = 0.0;
  SubBody& b = body_[platform_];
  for (std::int32_t r = row_begin_[platform_]; r < row_begin_[platform_ + 1]; ++r) {
    const SubPoint& s = point_[row_[r] / 2];
    if (!s.overlaps) continue;
    impulse += row_[r] % 2 ? -s.impulse : s.impulse;
    twist += row_[r] % 2 ? s.twist_q : s.twist_p;
  }
  push(b, impulse, twist);
  const PlatformSpeed alone{b.velocity, b.spin};
  const double angle = platform_substep(f, of_substep_, alone);
  b.velocity = f.bodies.velocity[0];
  b.spin = f.bodies.spin[0];
  b.shift = f.bodies.position[0] - f.platform_position;
  set_turn(b, b.turn + angle);
}

void CompliantContacts::move_bodies(FieldState& f, const ThreadTeam& team, int rank) {
  const auto n = static_cast<std::int64_t>(body_.size());
  for (std::int64_t i = team.begin_of(rank, n); i < team.begin_of(rank + 1, n); ++i) {
    if (i == platform_) {
      move_platform(f);
      continue;
    }
    SubBody& b = body_[i];
    if (!(b.inverse_mass > 0.0)) continue;
    Vec2 impulse;
    double twist = 0.0;
    for (std::int32_t r = row_begin_[i]; r < row_begin_[i + 1]; ++r) {
      const SubPoint& s = point_[row_[r] / 2];
      if (!s.overlaps) continue;
      impulse += row_[r] % 2 ? -s.impulse : s.impulse;
      twist += row_[r] % 2 ? s.twist_q : s.twist_p;
      b.pressed = true;
    }
    move(b, impulse, twist, h_);
  }
}

void CompliantContacts::run(FieldState& f, ThreadTeam& team, int rank) {
  const auto pairs = static_cast<std::int64_t>(pair_.size());
  for (std::int64_t s = 0; s < substeps_; ++s) {
    team.for_each(rank, pairs, [&](std::int64_t i) { press_pair(pair_[i], point_.data(), body_.data(), h_); });
    move_bodies(f, team, rank);
    team.barrier();
  }
}

/// A floe that was pressed keeps its substeps' motion; move_floes() adds the path of its last velocity, so the rest is a
/// shift. Any other follows the exact path of its drag, with the bits that it has without neighbours.
void CompliantContacts::hand_back(FieldState& f, std::int32_t entry) {
  const SubBody& s = body_[entry];
  Bodies& b = f.bodies;
  const std::int32_t i = body_id_[entry];
  f.book(Channel::impact, i).energy += s.contact_work;
  if (entry == platform_ || b.kind[i] != BodyKind::floe || !s.pressed) return;
  // the books of the other loads were made as if they acted alone
  Quantity& drag = f.book(Channel::drag, i);
  const Vec2 impulse = s.mass * (b.velocity[i] - velocity_before_[i]);
  const double twist = s.inertia * (b.spin[i] - spin_before_[i]);
  const double alone = 0.5 * dot(impulse, b.velocity[i] + velocity_before_[i]) + 0.5 * twist * (b.spin[i] + spin_before_[i]);
  drag.energy += s.kick_work - alone;
  drag.angular_momentum += s.mass * cross(s.shift_sum, s.kick);
  b.velocity[i] = s.velocity;
  b.spin[i] = s.spin;
  f.repair_shift[i] = s.shift - f.constants.dt * s.velocity;
  f.repair_turn[i] = s.turn - f.constants.dt * s.spin;
  f.struck[i] = 1;
}

/// Impulses of a pair as one point of its contact, on their common line of action. Books what a fixed body and a held
/// platform give.
void CompliantContacts::tell_pair(FieldState& f, const SubPair& pair, Contact& contact, StepQuality& quality,
                                  StepLog& log) {
  const Bodies& bodies = f.bodies;
  Vec2 impulse, normal_sum, point_sum;
  double moment = 0.0, twist_a = 0.0, pressed = 0.0, most_elastic = 0.0, deepest = 0.0;
  ContactWork work;
  for (std::int32_t k = pair.first; k < pair.first + pair.count; ++k) {
    const SubPoint& s = point_[k];
    const bool p_is_b = found_[k].of_b;
    const Vec2 on_b = p_is_b ? s.impulse_sum : -s.impulse_sum;
    impulse += on_b;
    normal_sum += p_is_b ? s.normal_sum : -s.normal_sum;
    twist_a += p_is_b ? s.twist_q_sum : s.twist_p_sum;
    pressed += s.pressed;
    // q's centroid to b's at the start
    const Vec2 to_b = p_is_b ? s.between : Vec2{};
    moment += (p_is_b ? s.moment : -s.moment) - cross(to_b, on_b);
    point_sum += s.point_sum - s.pressed * to_b;
    most_elastic = larger(most_elastic, s.most_elastic);
    deepest = larger(deepest, s.deepest);
    quality.contacts += s.overlaps || s.pressed > 0.0;
    energy_.load += s.pressed;
    energy_.softened += s.softened;
    work.stored += s.work.stored, work.crushed += s.work.crushed;
    work.damped += s.work.damped, work.friction += s.work.friction;
  }
  energy_.stored += work.stored;
  energy_.crushed += work.crushed;
  energy_.damped += work.damped;
  energy_.friction += work.friction;
  Quantity &impact = f.book(Channel::impact, contact.b), &friction = f.book(Channel::friction, contact.b);
  impact.energy += work.friction;
  friction.energy -= work.friction;
  if (!(pressed > 0.0)) return;

  contact.count = 1;
  contact.normal = length(normal_sum) > 0.0 ? (1.0 / length(normal_sum)) * normal_sum : contact.normal;
  contact.width = pair.chord;
  contact.growth = pair.corners == 1 && pair.depth > 0.0 ? pair.chord / pair.depth : 0.0;
  contact.friction = friction_of_pair(f.constants.events, f.constants.is_platform(contact.a));
  contact.largest_force = pair.largest_force;
  ContactSlot& slot = contact.slot[0];
  slot.impulse = {dot(impulse, contact.normal), dot(impulse, turned_left(contact.normal))};
  slot.elastic = slot.repair = 0.0;
  slot.separation = -deepest;
  slot.arm_b = (1.0 / pressed) * point_sum;
  if (dot(impulse, impulse) > 0.0)
    slot.arm_b += ((moment - cross(slot.arm_b, impulse)) / dot(impulse, impulse)) * turned_right(impulse);
  const std::int32_t owner = f.constants.owner_of(contact.a);
  const Vec2 from = owner == 0 ? f.platform_position : bodies.position[owner];
  slot.arm_a = slot.arm_b + bodies.position[contact.b] - from;
  const Vec2 before = velocity_before_[contact.b] + cross(spin_before_[contact.b], slot.arm_b) -
                      velocity_before_[owner] - cross(spin_before_[owner], slot.arm_a);
  slot.normal_before = dot(before, contact.normal);
  slot.tangential_before = dot(before, turned_left(contact.normal));

  const bool fixed_b = bodies.kind[contact.b] == BodyKind::fixed;
  if (fixed_b || bodies.kind[contact.a] == BodyKind::fixed) {
    const double given = fixed_b ? -1.0 : 1.0;
    const Vec2 tangential = slot.impulse.tangential * turned_left(contact.normal), place = bodies.position[contact.b];
    friction.momentum += given * tangential;
    impact.momentum += given * (impulse - tangential);
    impact.angular_momentum += given * (cross(place, impulse) + moment);
  }
  if (f.constants.is_platform(contact.a)) {
    if (bodies.inverse_inertia[0] == 0.0) f.mooring_force.angular_momentum -= twist_a;
    if (bodies.inverse_mass[0] == 0.0) f.held_impulse += impulse;
  }
  const double share = most_elastic / std::sqrt(smaller(bodies.area[contact.a], bodies.area[contact.b]));
  if (most_elastic > 0.0) {
    log.overlap.add(most_elastic);
    log.overlap_share.add(share);
  }
  quality.maximum_overlap = larger(quality.maximum_overlap, most_elastic);
  quality.maximum_share = larger(quality.maximum_share, share);
}

void CompliantContacts::tell(FieldState& f, Contacts contacts, StepQuality& quality, StepLog& log) {
  const double left = energy_.left();
  for (Contact* contact : contacts) contact->count = 0;
  for (const SubPair& pair : pair_) tell_pair(f, pair, *contacts[pair.contact], quality, log);
  for (const SubBody& b : body_) energy_.work += b.contact_work;
  quality.iterations = static_cast<std::int32_t>(substeps_);
  quality.energy_created = larger(0.0, energy_.left() - left);
}

void CompliantContacts::remember() {
  key_.clear();
  memory_.clear();
  std::vector<std::pair<std::uint64_t, std::int32_t>> order;
  for (std::size_t k = 0; k < point_.size(); ++k)
    if (point_[k].overlaps) order.emplace_back(point_key_[k], static_cast<std::int32_t>(k));
  std::sort(order.begin(), order.end());
  for (const auto& [key, k] : order) {
    key_.push_back(key);
    memory_.push_back(point_[k].memory);
  }
}

void CompliantContacts::finish(FieldState& f, Contacts contacts, ThreadTeam& team, int rank, StepQuality& quality,
                               StepLog& log) {
  team.single(rank, [&] {
    tell(f, contacts, quality, log);
    remember();
  });
  team.for_each(rank, static_cast<std::int64_t>(body_.size()),
                [&](std::int64_t i) { hand_back(f, static_cast<std::int32_t>(i)); });
}

}  // namespace gem
