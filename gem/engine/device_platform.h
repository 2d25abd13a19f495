// The platform's part of the bodies phase, by one warp: its contacts are prepared side by side and added in order.
#pragma once

#include "gem/engine/device_bodies.h"

namespace gem {

/// Sums of PlatformTerm::part, in contact order.
struct PlatformSums {
  Vec2 velocity;
  double spin = 0.0;
  Vec2 ice_impulse;
  double ice_yaw = 0.0, twist = 0.0;
};

GEM_DEVICE inline PlatformMotion platform_motion(const DeviceScene& s, double mass, PlatformCell& p) {
  return {mass, p.moved, p.velocity, s.book(Channel::platform_drag, 0), s.book(Channel::mooring, 0), p.mooring_force};
}

/// The platform's own motion up to the instant of the events of the next moment; `spin` is the one it has.
GEM_DEVICE inline void platform_first_half(const DeviceScene& s, Mover& mover, double mass, double spin) {
  PlatformCell& p = *s.platform;
  p.mooring_before = p.mooring_force.momentum;
  p.drag_before = s.book(Channel::platform_drag, 0).momentum;
  p.moved = mover.position;
  if (s.constants.moored_or_free) platform_half(s.constants, platform_motion(s, mass, p), true);
  mover.velocity = p.velocity;
  mover.spin = spin;
}

/// What one contact point does to the platform; the velocities after a coupled moment are known already.
GEM_DEVICE inline PlatformTerm platform_term(const DeviceScene& s, const BodyCell& cell, const Contact& contact,
                                             const ContactSlot& slot, bool ice) {
  const Vec2 impulse = world_impulse(contact, slot.impulse);
  const double twist = cross(slot.arm_a, impulse);
  MotionStep step;
  if (s.constants.resolution == Resolution::independent)
    step = motion_step({cell.inverse_mass, cell.inverse_inertia}, slot.arm_a, impulse);
  PlatformTerm term{{step.velocity.x, step.velocity.y, step.spin, 0.0, 0.0, 0.0, twist}};
  if (ice) {
    term.part[3] = impulse.x;
    term.part[4] = impulse.y;
    term.part[5] = twist;
  }
  return term;
}

/// Lines up the terms of all contact points of the moment in order. Returns their number; `pressed` counts the floes
/// that push, and events go to the ring.
template <class Warp>
GEM_DEVICE inline std::int32_t line_up_terms(const DeviceScene& s, const Warp& warp, const BodyCell& cell,
                                             const BodyMotion& motion, std::int32_t moment, std::int32_t& pressed) {
  DeviceStatus& status = *s.status;
  const bool coupled = s.constants.resolution == Resolution::coupled;
  const std::int32_t places = motion.row_count;
  std::int32_t terms = 0, events = status.events;
  for (std::int32_t first = 0; first < places; first += Warp::size) {
    const std::int32_t at = first + warp.rank(), row = motion.row_begin + at;
    const bool touched = at < places && s.stamp[row].entry == moment;
    const Contact* contact = touched ? &s.contact[s.row_pair[row]] : nullptr;
    const int points = touched ? contact->count : 0;
    const unsigned one = warp.ballot(points > 0), two = warp.ballot(points > 1);
    const bool ice = touched && s.body[contact->b].kind == BodyKind::floe;
    std::int32_t to = terms + warp.count_below(one) + warp.count_below(two);
    bool presses = false;
    for (int k = 0; k < points; ++k) {
      s.term[to++] = platform_term(s, cell, *contact, contact->slot[k], ice);
      presses = presses || (ice && contact->slot[k].impulse.normal > 0.0);
    }
    const bool event = touched && s.wants_events && s.row_event_moment[at] == moment &&
                       (!coupled || is_event(*contact, s.event_speed));
    const unsigned pressing = warp.ballot(presses), recorded = warp.ballot(event);
    if (event) {
      EventRecord& record = s.event[events + warp.count_below(recorded)];
      record = s.row_event[at];
      if (coupled) record.contact = *contact;
    }
    terms += warp.count(one) + warp.count(two);
    events += warp.count(recorded);
    pressed += warp.count(pressing);
  }
  warp.sync();
  if (warp.rank() == 0) status.events = events;
  return terms;
}

/// Adds the terms in order, each lane some of the parts.
template <class Warp>
GEM_DEVICE inline PlatformSums add_terms(const DeviceScene& s, const Warp& warp, const PlatformSums& start,
                                         std::int32_t terms) {
  double sum[7] = {start.velocity.x,    start.velocity.y, start.spin, start.ice_impulse.x,
                   start.ice_impulse.y, start.ice_yaw,    start.twist};
  for (int part = 0; part < 7; ++part) {
    if (part % Warp::size != warp.rank()) continue;
    const double sign = part == 6 ? 1.0 : -1.0;
    for (std::int32_t k = 0; k < terms; ++k) sum[part] += sign * s.term[k].part[part];
  }
  for (int part = 0; part < 7; ++part) sum[part] = warp.from(sum[part], part % Warp::size);
  return {{sum[0], sum[1]}, sum[2], {sum[3], sum[4]}, sum[5], sum[6]};
}

/// Writes the moment's sample to the ring.
GEM_DEVICE inline void write_sample(const DeviceScene& s, const Mover& mover, const PlatformSums& sums,
                                    std::int32_t pressed, std::int32_t at) {
  const PlatformCell& p = *s.platform;
  PlatformMoment& sample = s.sample[at];
  sample.position = mover.position;
  sample.rotation = mover.rotation;
  sample.velocity = p.velocity;
  sample.spin = sums.spin;
  sample.ice_impulse = sums.ice_impulse;
  sample.ice_yaw_impulse = sums.ice_yaw;
  sample.mooring_impulse = p.mooring_force.momentum - p.mooring_before;
  sample.drag_impulse = s.book(Channel::platform_drag, 0).momentum - p.drag_before;
  sample.contacts = pressed;
}

/// Enters what shifting the platform does to the mooring's energy and to the angular momentum.
GEM_DEVICE inline void book_platform_repair(const DeviceScene& s, double mass, const PlatformCell& p, Vec2 shift) {
  if (s.constants.resolution == Resolution::independent) return;
  const Vec2 offset = p.moved - s.constants.anchor;
  Quantity& book = s.book(Channel::repair, 0);
  book.angular_momentum += mass * cross(shift, p.velocity);
  book.energy += s.constants.stiffness * (dot(offset, shift) + 0.5 * dot(shift, shift));
}

/// What one thread does for the platform, once the contacts are summed.
template <class Crew>
GEM_DEVICE inline void move_platform_body(const DeviceScene& s, Crew& crew, const Desk& desk, const PlatformSums& sums,
                                          const BodyRepair& repair, std::int32_t pressed, const MomentStep& step) {
  BodyCell& cell = desk.body[0];
  const BodyMotion& motion = desk.motion[0];
  PlatformCell& p = *s.platform;
  Mover mover = mover_of(cell);
  p.velocity = sums.velocity;
  if (cell.inverse_inertia == 0.0) p.mooring_force.angular_momentum = sums.twist;
  if (s.constants.moored_or_free) {
    platform_half(s.constants, platform_motion(s, motion.mass, p), false);
    mover.position = p.moved + repair.shift;
    book_platform_repair(s, motion.mass, p, repair.shift);
    turn(mover, s.constants.dt * sums.spin + repair.turn);
  }
  if (cell.active && !is_finite(mover, p.velocity, sums.spin)) crew.raise(alarm_not_finite);
  if (s.wants_samples) write_sample(s, mover, sums, pressed, step.sample);
  if (cell.active && left_course(s, mover, cell.radius, motion, step.elapsed)) crew.raise(alarm_strayed);
  if (s.wants_events && s.events_capacity - s.status->events < s.platform_capacity) crew.raise(alarm_ring_full);
  if (step.kick_next) platform_first_half(s, mover, motion.mass, sums.spin);
  s.after[0].velocity = sums.velocity;
  s.after[0].spin = sums.spin;
  write_mover(s.body[0], mover);
  write_mover(cell, mover);
}

/// The platform through the bodies phase.
template <class Crew>
GEM_DEVICE inline void move_platform(const DeviceScene& s, Crew& crew, const Desk& desk, const MomentStep& step) {
  const auto warp = crew.warp();
  const BodyCell& cell = desk.body[0];
  std::int32_t pressed = 0;
  const std::int32_t terms = line_up_terms(s, warp, cell, desk.motion[0], step.moment, pressed);
  PlatformSums start;
  BodyAfter after{cell.velocity, cell.spin};
  BodyRepair repair;
  if (s.constants.resolution == Resolution::coupled) take_solved(s, 0, step.moment, after, repair);
  start.velocity = after.velocity;
  start.spin = after.spin;
  start.twist = s.platform->mooring_force.angular_momentum;
  const double travel = cell.turn_travel;
  const PlatformSums sums = add_terms(s, warp, start, terms);
  warp.sync();
  if (warp.rank() == 0) move_platform_body(s, crew, desk, sums, repair, pressed, step);
  warp.sync();
  if (cell.vertex_count > desk_vertices && cell.turn_travel != travel)
    turn_outline(s, cell.vertex_begin, cell.vertex_count, cell.rotation, warp.rank(), Crew::Warp::size);
}

}  // namespace gem
