// What the substeps of a time step tell the rest of it.
#include <cmath>

#include "gem/engine/cpu/compliant_contacts.h"
#include "gem/engine/step/contact_stages.h"

namespace gem {
namespace {

Vec2 vec(const VecOf<double>& v) { return {v.x, v.y}; }

}  // namespace

/// A floe keeps its substeps' motion; move_floes() adds the path of its last velocity, so the rest is a shift.
void CompliantContacts::hand_back(FieldState& f, std::int32_t entry) {
  const SubBody& s = near_.bodies()[entry];
  const SubMotion& m = motion_[entry];
  Bodies& b = f.bodies;
  const std::int32_t i = near_.body_id()[entry];
  f.book(Channel::impact, i).energy += s.contact_work;
  if (entry == near_.platform() || b.kind[i] != BodyKind::floe || state_[entry] == free) return;
  // the books of the other loads were made as if they acted alone
  Quantity& drag = f.book(Channel::drag, i);
  const Vec2 before = near_.velocity_before(i);
  const double spin_before = near_.spin_before(i);
  const Vec2 impulse = s.mass * (b.velocity[i] - before);
  const double twist = s.inertia * (b.spin[i] - spin_before);
  const double alone = 0.5 * dot(impulse, b.velocity[i] + before) + 0.5 * twist * (b.spin[i] + spin_before);
  drag.energy += s.kick_work - alone;
  drag.angular_momentum += s.mass * cross(s.shift_sum, s.kick);
  b.velocity[i] = m.velocity;
  b.spin[i] = m.spin;
  f.repair_shift[i] = m.shift - f.constants.dt * m.velocity;
  f.repair_turn[i] = m.turn - f.constants.dt * m.spin;
  f.struck[i] = 1;
}

/// Impulses of a pair as one point of its contact, on their common line of action. Books what a fixed body and a held
/// platform give.
void CompliantContacts::tell_pair(FieldState& f, std::int32_t id, Contact& contact, StepQuality& quality,
                                  StepLog& log) {
  const Bodies& bodies = f.bodies;
  const Opened& at = opened_[id];
  const PairBlocks& blocks = part_[at.part].blocks;
  const SubPair<double> s = blocks.sums(at.lane);
  for (std::int32_t k = 0; k < near_.pairs()[id].count; ++k) quality.contacts += blocks.acted(at.lane, k);
  quality.maximum_depth = larger(quality.maximum_depth, s.deepest);
  energy_.load += s.pressed;
  energy_.softened += s.softened;
  energy_.stored += s.work.stored;
  energy_.crushed += s.work.crushed;
  energy_.damped += s.work.damped;
  energy_.friction += s.work.friction;
  Quantity &impact = f.book(Channel::impact, contact.b), &friction = f.book(Channel::friction, contact.b);
  impact.energy += s.work.friction;
  friction.energy -= s.work.friction;
  if (!(s.pressed > 0.0)) return;

  const Vec2 impulse = vec(s.impulse), normal_part = vec(s.normal_part);
  // the sums are told from a's centroid, the contact from b's
  const Vec2 to_b = start_of(f, contact.b) - start_of(f, contact.a);
  const double moment = s.moment - cross(to_b, impulse), chord = std::sqrt(s.chord_2);
  contact.count = 1;
  contact.normal = length(normal_part) > 0.0 ? (1.0 / length(normal_part)) * normal_part : contact.normal;
  contact.width = chord;
  contact.growth = s.corners == 1.0 && s.depth > 0.0 ? chord / s.depth : 0.0;
  contact.friction = friction_of_pair(f.constants.events, f.constants.is_platform(contact.a));
  contact.largest_force = s.largest_force;
  ContactSlot& slot = contact.slot[0];
  slot.impulse = {dot(impulse, contact.normal), dot(impulse, turned_left(contact.normal))};
  slot.elastic = slot.repair = 0.0;
  slot.separation = -s.deepest;
  slot.arm_b = (1.0 / s.pressed) * vec(s.point) - to_b;
  if (dot(impulse, impulse) > 0.0)
    slot.arm_b += ((moment - cross(slot.arm_b, impulse)) / dot(impulse, impulse)) * turned_right(impulse);
  slot.arm_a = slot.arm_b + to_b;
  const std::int32_t owner = f.constants.owner_of(contact.a);
  const auto velocity_at = [&](std::int32_t body, Vec2 arm) {
    return near_.velocity_before(body) + cross(near_.spin_before(body), arm);
  };
  const Vec2 before = velocity_at(contact.b, slot.arm_b) - velocity_at(owner, slot.arm_a);
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
    if (bodies.inverse_inertia[0] == 0.0) f.mooring_force.angular_momentum -= s.twist_a;
    if (bodies.inverse_mass[0] == 0.0) f.held_impulse += impulse;
  }
  const double share = s.most_elastic / std::sqrt(smaller(bodies.area[contact.a], bodies.area[contact.b]));
  if (s.most_elastic > 0.0) {
    log.overlap.add(s.most_elastic);
    log.overlap_share.add(share);
  }
  quality.maximum_overlap = larger(quality.maximum_overlap, s.most_elastic);
  quality.maximum_share = larger(quality.maximum_share, share);
}

void CompliantContacts::tell(FieldState& f, Contacts contacts, StepQuality& quality, StepLog& log) {
  const double left = energy_.left();
  for (Contact* contact : contacts) contact->count = 0;
  for (std::size_t i = 0; i < opened_.size(); ++i)
    if (opened_[i].part >= 0)
      tell_pair(f, static_cast<std::int32_t>(i), *contacts[near_.pairs()[i].contact], quality, log);
  for (const SubBody& b : near_.bodies()) energy_.work += b.contact_work;
  quality.iterations = static_cast<std::int32_t>(substeps_);
  quality.energy_created = larger(0.0, energy_.left() - left);
}

}  // namespace gem
