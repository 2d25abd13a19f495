#include "gem/engine/step/contact_outcome.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "gem/engine/step/contact_stages.h"
#include "gem/engine/step/ordered_sum.h"

namespace gem {

GEM_CLONES void find_outcome(const FieldState& f, const Contact& contact, ContactOutcome& outcome) {
  const Bodies& bodies = f.bodies;
  const CollisionMass a = collision_mass(bodies, contact.a), b = collision_mass(bodies, contact.b);
  outcome.a = contact.a;
  outcome.b = contact.b;
  outcome.count = contact.count;
  for (int k = 0; k < contact.count; ++k) {
    const ContactSlot& slot = contact.slot[k];
    PointOutcome& point = outcome.point[k];
    const Vec2 velocity = relative_velocity(bodies, contact, slot);
    point.quality = point_quality(contact, slot, a, b, velocity);
    point.work = slot_work(contact, slot, velocity);
    point.acted = acted(slot);
    point.touched = slot.separation <= 0.0 || slot.impulse.normal > 0.0;
    point.depth = point.share = 0.0;
    if (!(slot.separation < 0.0)) continue;
    point.depth = -slot.separation;
    point.share = point.depth / std::sqrt(std::min(bodies.area[contact.a], bodies.area[contact.b]));
  }
}

void book_contact(FieldState& f, const Contact& contact, const ContactOutcome& outcome) {
  const std::int32_t a = outcome.a, b = outcome.b;
  const bool fixed_b = f.bodies.kind[b] == BodyKind::fixed;
  const bool on_fixed = fixed_b || f.bodies.kind[a] == BodyKind::fixed;
  const bool on_platform = f.constants.is_platform(a);
  const bool on_locked = on_platform && f.bodies.inverse_inertia[0] == 0.0;
  const bool on_held = on_platform && f.bodies.inverse_mass[0] == 0.0;
  // Coupled: a body counts as struck if it has a contact within reach, whatever impulse the contact carries. If the
  // impulse decided, an impulse that is rounding in one run and zero in another would separate the two runs by 2e-5 m
  // per time step. A jump of that size remains only where a pair comes within reach.
  if (f.constants.solver == ContactSolver::coupled && outcome.count > 0) f.struck[a] = f.struck[b] = 1;
  const ContactBooks books{f.book(Channel::impact, b), f.book(Channel::elastic, b), f.book(Channel::friction, b)};
  for (int k = 0; k < outcome.count; ++k) {
    const PointOutcome& point = outcome.point[k];
    if (!point.acted) continue;
    f.struck[a] = f.struck[b] = 1;
    books.impact.energy += point.work.impact;
    if (point.work.elastic != 0.0) books.elastic.energy += point.work.elastic;
    books.friction.energy += point.work.friction;
    if (on_fixed) book_fixed(books, contact, contact.slot[k], f.bodies.position[b], fixed_b);
    // the yaw lock of the platform takes this moment
    if (on_locked)
      f.mooring_force.angular_momentum += cross(contact.slot[k].arm_a, world_impulse(contact, contact.slot[k].impulse));
    if (on_held) f.held_impulse += world_impulse(contact, contact.slot[k].impulse);
  }
}

void note_outcomes(const FieldState& f, std::span<const ContactOutcome> outcomes, std::vector<double>& work,
                   StepQuality& quality, StepLog& log) {
  work.assign(f.bodies.count() + sum_width, 0.0);  // per body B, or per body A where B is fixed
  for (const ContactOutcome& outcome : outcomes) {
    double& sum = work[f.bodies.inverse_mass[outcome.b] > 0.0 ? outcome.b : f.constants.owner_of(outcome.a)];
    for (int k = 0; k < outcome.count; ++k) {
      const PointOutcome& point = outcome.point[k];
      quality.complementarity = std::max(quality.complementarity, point.quality.complementarity);
      quality.cone_excess = std::max(quality.cone_excess, point.quality.cone_excess);
      sum += point.quality.work;
      if (point.touched) ++quality.contacts;
      if (!(point.depth > 0.0)) continue;
      log.overlap.add(point.depth);
      log.overlap_share.add(point.share);
      quality.maximum_overlap = std::max(quality.maximum_overlap, point.depth);
      quality.maximum_share = std::max(quality.maximum_share, point.share);
    }
  }
  // the net work of the time step: a gain at one contact does not show where another contact took more
  quality.energy_created = std::max(0.0, ordered_sum(work.data(), f.bodies.count()));
}

}  // namespace gem
