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

/// Place of a body at the start of the time step: the platform moves in every substep [m].
Vec2 start_of(const FieldState& f, std::int32_t body) {
  return f.constants.is_platform(body) ? f.platform_position : f.bodies.position[body];
}

/// How far two bodies may close in a time step, from their present motion and what drives them [m]. It tells which
/// corners share the mass of a body, so it hangs on nothing distant; others are seen too when a neighbour is hit.
double reach_of(const FieldState& f, std::int32_t a, std::int32_t b) {
  const Bodies& s = f.bodies;
  const double closing =
      length(s.velocity[b] - s.velocity[a]) + magnitude(s.spin[a]) * s.radius[a] + magnitude(s.spin[b]) * s.radius[b];
  return f.constants.dt * (closing + f.constants.drive_speed);
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

void CompliantContacts::find(const FieldState& f, Contacts contacts, const ThreadTeam& team, int rank) {
  std::vector<Found>& found = part_[rank].found;
  found.clear();
  const auto n = static_cast<std::int64_t>(contacts.size());
  for (std::int64_t c = team.begin_of(rank, n); c < team.begin_of(rank + 1, n); ++c) {
    const Contact& contact = *contacts[c];
    const double near = reach_of(f, contact.a, contact.b), reach = f.constants.contact_margin;
    const auto take = [&](bool of_b, std::int32_t corner, SideDistance outer) {
      const std::int32_t vertex = f.bodies.vertex_begin[body_p(contact, of_b)] + corner;
      if (!no_corner_.empty() && f.constants.is_platform(body_p(contact, of_b)) && no_corner_[vertex]) return;
      found.push_back({static_cast<std::int32_t>(c), corner, outer.side, of_b, outer.distance < near});
    };
    const Outline a = f.outline(contact.a), b = f.outline(contact.b);
    const Vec2 offset = f.bodies.position[contact.b] - f.bodies.position[contact.a], axis = contact.normal;
    double top = -1e300, bottom = 1e300;  // of a and of b along the axis
    for (int k = 0; k < a.count; ++k) top = larger(top, dot(axis, a.corner[k]));
    for (int k = 0; k < b.count; ++k) bottom = smaller(bottom, dot(axis, offset + b.corner[k]));
    if (!(bottom - top < reach)) continue;
    corners_near(b, surface_of(f, contact.a), offset, axis, top + reach, reach,
                 [&](std::int32_t corner, SideDistance outer) { take(true, corner, outer); });
    corners_near(a, surface_of(f, contact.b), -offset, -axis, dot(axis, offset) - bottom + reach, reach,
                 [&](std::int32_t corner, SideDistance outer) { take(false, corner, outer); });
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
  s.velocity = s.start_velocity = velocity_before_[body];
  s.spin = s.start_spin = spin_before_[body];
  s.radius = b.radius[body] + f.constants.contact_margin;
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
  for (SubPair& pair : pair_) {
    const Contact& contact = *contacts[pair.contact];
    pair.a = enter(f, f.constants.owner_of(contact.a));
    pair.b = enter(f, contact.b);
    for (std::int32_t k = pair.first; k < pair.first + pair.count; ++k) {
      corners_[pair.a] += found_[k].counts;
      corners_[pair.b] += found_[k].counts;
    }
  }
  stray_.assign(body_.size(), 0.0);
  touched_.assign(body_.size(), 0);
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

void CompliantContacts::watch_pair(const FieldState& f, Contacts contacts, SubPair& pair) {
  pair.gap = 1e300;
  pair.closing = -1e300;
  for (std::int32_t k = pair.first; k < pair.first + pair.count; ++k) {
    const Found& found = found_[k];
    const Contact& of_piece = *contacts[found.contact];
    const std::int32_t p = body_p(of_piece, found.of_b), q = body_q(of_piece, found.of_b);
    const Outline side_of = f.outline(q);
    const Vec2 corner = f.outline(p).corner[found.corner];
    const Vec2 arm_q = start_of(f, p) - start_of(f, q) + corner, normal = side_of.normal[found.side];
    watch(pair, body_[found.of_b ? pair.b : pair.a], body_[found.of_b ? pair.a : pair.b], corner, arm_q, normal,
          dot(normal, arm_q - side_of.corner[found.side]), h_);
  }
  pair.gap -= motion_rounding;
}

/// Fills the points of a pair: geometry at the start of the time step, law, memory.
void CompliantContacts::open(const FieldState& f, Contacts contacts, SubPair& pair) {
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
  pair.is_open = true;
  for (std::int32_t k = pair.first; k < pair.first + pair.count; ++k) {
    const Found& found = found_[k];
    SubPoint& s = point_[k];
    s = {};
    s.of_b = found.of_b;
    const Contact& of_piece = *contacts[found.contact];
    const std::int32_t p = body_p(of_piece, found.of_b), q = body_q(of_piece, found.of_b);
    const std::int32_t entry_p = s.of_b ? pair.b : pair.a, entry_q = s.of_b ? pair.a : pair.b;
    const Outline own = f.outline(p);
    s.surface = surface_of(f, q);
    s.first_side = b.vertex_begin[q] - b.vertex_begin[f.constants.owner_of(q)];
    s.corner = own.corner[found.corner];
    s.flank[0] = own.corner[found.corner > 0 ? found.corner - 1 : own.count - 1] - s.corner;
    s.flank[1] = own.corner[found.corner + 1 < own.count ? found.corner + 1 : 0] - s.corner;
    s.between = start_of(f, p) - start_of(f, q);
    const Vec2 arm_q = s.between + s.corner;
    s.near = near_sides(s.surface, arm_q, s.flank, f.constants.contact_margin);
    const SideDistance nearest = nearest_side(s.near, arm_q, s.of_b ? tie : -tie);
    const Vec2 normal = s.near.side[nearest.side < 0 ? 0 : nearest.side].normal;
    const SubBody &of_p = body_[entry_p], &of_q = body_[entry_q];
    const CollisionMass mass_p = shared_mass({of_p.inverse_mass, of_p.inverse_inertia}, std::max(1, corners_[entry_p]));
    const CollisionMass mass_q = shared_mass({of_q.inverse_mass, of_q.inverse_inertia}, std::max(1, corners_[entry_q]));
    const ContactCompliance compliance = contact_compliance(mass_p, s.corner, mass_q, arm_q, normal);
    s.full_stiffness = stiffness;
    s.law = stable_law({stiffness, corner_damping(e.contact, stiffness, inverse_mass),
                        friction_of_pair(e, f.constants.is_platform(contact.a))},
                       h_, larger(compliance.nn, compliance.tt));
    const std::int32_t owner = f.constants.owner_of(contact.a);
    const std::int32_t vertex = b.vertex_begin[p] - b.vertex_begin[found.of_b ? contact.b : owner] + found.corner;
    point_key_[k] = corner_key(owner, contact.b, vertex, found.of_b);
    // a corner at a joint is near several pieces; the one that it is in has its memory
    if (f.constants.pieces == 1 || nearest.side >= 0) keep(s, point_key_[k]);
  }
}

/// Lists the points of every body, in order of the points.
void CompliantContacts::sum_rows() {
  row_begin_.assign(body_.size() + 1, 0);
  for (const SubPair& pair : pair_) row_begin_[pair.a + 1] += pair.count, row_begin_[pair.b + 1] += pair.count;
  for (std::size_t i = 1; i < row_begin_.size(); ++i) row_begin_[i] += row_begin_[i - 1];
  row_.resize(2 * point_.size());
  std::vector<std::int32_t> next(row_begin_.begin(), row_begin_.end() - 1);
  for (const SubPair& pair : pair_)
    for (std::int32_t k = pair.first; k < pair.first + pair.count; ++k) {
      point_[k].overlaps = false;
      row_[next[pair.a]++] = 2 * k;
      row_[next[pair.b]++] = 2 * k + 1;
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
  find(f, contacts, team, rank);
  team.barrier();
  team.single(rank, [&] { lay_out(f, contacts, team.size()); });
  team.for_each(rank, static_cast<std::int64_t>(pair_.size()),
                [&](std::int64_t i) { watch_pair(f, contacts, pair_[i]); });
  team.single(rank, [&] { sum_rows(); });
}

/// Impulse and twist of all corners on a body. Returns whether any overlaps.
bool CompliantContacts::sum_of(std::int64_t entry, Vec2& impulse, double& twist) const {
  bool any = false;
  for (std::int32_t r = row_begin_[entry]; r < row_begin_[entry + 1]; ++r) {
    const SubPoint& s = point_[row_[r] / 2];
    if (!s.overlaps) continue;
    const bool is_p = s.of_b == (row_[r] % 2 == 1);
    impulse += is_p ? s.impulse : -s.impulse;
    twist += is_p ? s.twist_p : s.twist_q;
    any = true;
  }
  return any;
}

void CompliantContacts::move_platform(FieldState& f) {
  Vec2 impulse;
  double twist = 0.0;
  SubBody& b = body_[platform_];
  if (sum_of(platform_, impulse, twist)) push(b, impulse, twist);
  const PlatformSpeed alone{b.velocity, b.spin};
  const double angle = platform_substep(f, of_substep_, alone);
  b.velocity = f.bodies.velocity[0];
  b.spin = f.bodies.spin[0];
  b.shift = f.bodies.position[0] - f.platform_position;
  set_turn(b, b.turn + angle);
}

void CompliantContacts::move_bodies(FieldState& f, std::int64_t substep, const ThreadTeam& team, int rank) {
  const auto n = static_cast<std::int64_t>(body_.size());
  for (std::int64_t i = team.begin_of(rank, n); i < team.begin_of(rank + 1, n); ++i) {
    SubBody& b = body_[i];
    if (i == platform_)
      move_platform(f);
    else if (touched_[i] == 0 || !(b.inverse_mass > 0.0))
      continue;
    else {
      if (touched_[i] == 1) end_free_motion(b, static_cast<double>(substep), h_);
      touched_[i] = 2;
      Vec2 impulse;
      double twist = 0.0;
      sum_of(i, impulse, twist);
      move(b, impulse, twist, h_);
    }
    stray_[i] = stray_of(b, static_cast<double>(substep + 1), h_);
  }
}

void CompliantContacts::press_range(const FieldState& f, Contacts contacts, std::int64_t substep, std::int64_t begin,
                                    std::int64_t end) {
  const auto n = static_cast<double>(substep);
  const double t = n * h_;
  for (std::int64_t i = begin; i < end; ++i) {
    SubPair& pair = pair_[i];
    if (!pair.presses && is_apart(pair, t, stray_[pair.a], stray_[pair.b])) continue;
    if (!pair.is_open) open(f, contacts, pair);
    const auto is_free = [&](std::int32_t entry) { return touched_of(entry) < 2 && entry != platform_; };
    const auto motion_of = [&](std::int32_t entry) -> SubMotion {
      return is_free(entry) ? after_free_motion(body_[entry], n, h_) : static_cast<const SubMotion&>(body_[entry]);
    };
    if (!press_pair(pair, &point_[pair.first], motion_of(pair.a), motion_of(pair.b), h_)) continue;
    for (const std::int32_t entry : {pair.a, pair.b})
      if (touched_of(entry) == 0) note_touch(entry);
  }
}

void CompliantContacts::run(FieldState& f, Contacts contacts, ThreadTeam& team, int rank) {
  const auto pairs = static_cast<std::int64_t>(pair_.size());
  for (std::int64_t s = 0; s < substeps_; ++s) {
    press_range(f, contacts, s, team.begin_of(rank, pairs), team.begin_of(rank + 1, pairs));
    team.barrier();
    move_bodies(f, s, team, rank);
    team.barrier();
  }
}

/// A floe keeps its substeps' motion; move_floes() adds the path of its last velocity, so the rest is a shift.
void CompliantContacts::hand_back(FieldState& f, std::int32_t entry) {
  const SubBody& s = body_[entry];
  Bodies& b = f.bodies;
  const std::int32_t i = body_id_[entry];
  f.book(Channel::impact, i).energy += s.contact_work;
  if (entry == platform_ || b.kind[i] != BodyKind::floe || touched_[entry] == 0) return;
  // the books of the other loads were made as if they acted alone
  Quantity& drag = f.book(Channel::drag, i);
  const Vec2 impulse = s.mass * (b.velocity[i] - velocity_before_[i]);
  const double twist = s.inertia * (b.spin[i] - spin_before_[i]);
  const double alone =
      0.5 * dot(impulse, b.velocity[i] + velocity_before_[i]) + 0.5 * twist * (b.spin[i] + spin_before_[i]);
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
  quality.maximum_depth = larger(quality.maximum_depth, deepest);
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
  slot.arm_a = slot.arm_b + start_of(f, contact.b) - start_of(f, contact.a);
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
  for (const SubPair& pair : pair_)
    if (pair.is_open) tell_pair(f, pair, *contacts[pair.contact], quality, log);
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
    if (!key_.empty() && key_.back() == key) continue;  // two pieces of the platform have the same corner
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
