// The platform's part of the body stages, by one warp. The lanes compute the terms of its contacts, which are then
// added in order: by piece, then by the other body.
#pragma once

#include "gem/engine/device/bodies.h"
#include "gem/engine/device/forces.h"

namespace gem {

/// Sums of PlatformTerm::part, in contact order.
struct PlatformSums {
  Vec2 velocity;
  double spin = 0.0;
  Vec2 ice_impulse;
  double ice_yaw = 0.0, twist = 0.0;
};

/// The platform's cell and the books of its own motion, in the registers of one thread.
struct PlatformLoaded {
  PlatformCell cell;
  Quantity drag_book, mooring_book;
};

GEM_DEVICE inline PlatformLoaded load_platform(const DeviceScene& s) {
  const PlatformCell& p = *s.platform;
  PlatformLoaded loaded;
  loaded.cell.mid_position = p.mid_position;
  loaded.cell.velocity = p.velocity;
  loaded.cell.spin = p.spin;
  loaded.cell.mooring_force = p.mooring_force;
  loaded.cell.mooring_before = p.mooring_before;
  loaded.cell.drag_before = p.drag_before;
  loaded.cell.broken = p.broken;
  loaded.drag_book = s.book(Channel::platform_drag, 0);
  loaded.mooring_book = s.book(Channel::mooring, 0);
  return loaded;
}

GEM_DEVICE inline void store_platform(const DeviceScene& s, const PlatformLoaded& loaded) {
  PlatformCell& p = *s.platform;
  p.mid_position = loaded.cell.mid_position;
  p.velocity = loaded.cell.velocity;
  p.spin = loaded.cell.spin;
  p.mooring_force = loaded.cell.mooring_force;
  p.mooring_before = loaded.cell.mooring_before;
  p.drag_before = loaded.cell.drag_before;
  p.broken = loaded.cell.broken;
  s.book(Channel::platform_drag, 0) = loaded.drag_book;
  s.book(Channel::mooring, 0) = loaded.mooring_book;
}

/// The platform's inertia, and how it turns in the half time step that is made.
struct PlatformTurn {
  double mass, inertia, inverse_inertia;  // [kg], [kg m2], [1/(kg m2)]
  Rotation rotation, next;                // `next`: when the mooring pulls
};

GEM_DEVICE inline PlatformTurn turn_of(const BodyCell& cell, const BodyMotion& motion, Rotation rotation,
                                       Rotation next) {
  return {motion.mass, motion.inertia, cell.inverse_inertia, rotation, next};
}

/// `spin`: of the platform, changed by the motion [rad/s].
GEM_DEVICE inline PlatformMotion platform_motion(const PlatformTurn& turn, double& spin, PlatformLoaded& loaded) {
  return {turn.mass,
          loaded.cell.mid_position,
          loaded.cell.velocity,
          loaded.drag_book,
          loaded.mooring_book,
          loaded.cell.mooring_force,
          turn.inertia,
          turn.inverse_inertia,
          spin,
          turn.rotation,
          turn.next,
          loaded.cell.broken};
}

/// Half a time step of dynamic positioning in time step `sample` of the call; see hold_station().
GEM_DEVICE inline void hold_station(const DeviceScene& s, PlatformLoaded& loaded, const PlatformTurn& turn,
                                    Vec2 position, double& spin, std::int32_t sample, bool commands) {
  if (!s.dp) return;
  hold_station(s.constants.events, s.drive_of(sample),
               {turn.mass, turn.inertia, position, turn.rotation, loaded.cell.velocity, spin, loaded.mooring_book,
                loaded.cell.mooring_force, loaded.drag_book, *s.dp},
               commands);
}

/// The platform at `position`, for what pushes it from outside.
GEM_DEVICE inline PushedPlatform pushed_platform(PlatformLoaded& loaded, const PlatformTurn& turn, Vec2 position,
                                                 double& spin) {
  return {turn.mass,
          turn.inertia,
          position,
          turn.rotation,
          loaded.cell.velocity,
          spin,
          loaded.mooring_book,
          loaded.cell.mooring_force};
}

/// Leads a ship in transit in time step `sample` of the call, and gives it its thrust if it runs free; see
/// tow_platform() and thrust_platform() of the laws.
GEM_DEVICE inline void tow_platform(const DeviceScene& s, PlatformLoaded& loaded, const PlatformTurn& turn,
                                    Vec2 position, double& spin, std::int32_t sample) {
  if (!(s.constants.events.tow_rate > 0.0)) return;
  const PushedPlatform pushed = pushed_platform(loaded, turn, position, spin);
  tow_platform(s.constants.events, s.drive_of(sample), pushed, turn.inverse_inertia > 0.0);
  thrust_platform(s.constants.events, s.drive_of(sample), pushed);
}

/// Moves the platform up to the pair events of the next time step, which is number `sample` of the call. `spin` is its
/// present spin [rad/s].
GEM_DEVICE inline void platform_first_half(const DeviceScene& s, PlatformLoaded& loaded, Mover& mover,
                                           const PlatformTurn& turn, double spin, std::int32_t sample) {
  PlatformCell& p = loaded.cell;
  p.mooring_before = p.mooring_force.momentum;
  p.drag_before = loaded.drag_book.momentum;
  p.mid_position = mover.position;
  tow_platform(s, loaded, turn, p.mid_position, spin, sample);
  hold_station(s, loaded, turn, p.mid_position, spin, sample, true);
  platform_events_before(s.constants.events, s.drive_of(sample), platform_motion(turn, spin, loaded));
  steer_platform(s.constants.events, s.drive_of(sample),
                 {turn.inertia, turn.rotation, p.mid_position, p.velocity, spin, loaded.drag_book}, true);
  turn_in_water(s.constants.events, s.drive_of(sample),
                {turn.rotation, p.mid_position, p.velocity, spin, loaded.drag_book}, turn.rotation, false);
  mover.velocity = p.velocity;
  mover.spin = spin;
}

/// Memory for the terms of a time step: the memory of the candidates, which is free now, if it is large enough.
GEM_DEVICE inline PlatformTerm* term_memory(const DeviceScene& s, const Workspace& workspace, std::int32_t places) {
  const std::size_t bytes = 2 * static_cast<std::size_t>(places) * sizeof(PlatformTerm);
  return bytes <= workspace.scratch_bytes ? reinterpret_cast<PlatformTerm*>(workspace.candidate) : s.term;
}

/// What one contact point does to the platform. Coupled: the velocity parts are zero, as the solver has found the
/// velocities.
template <ContactSolver solver>
GEM_DEVICE inline PlatformTerm platform_term(const BodyCell& cell, const Contact& contact, const ContactSlot& slot,
                                             bool ice) {
  const Vec2 impulse = world_impulse(contact, slot.impulse);
  const double twist = cross(slot.arm_a, impulse);
  VelocityChange step;
  if constexpr (solver == ContactSolver::independent)
    step = velocity_change({cell.inverse_mass, cell.inverse_inertia}, slot.arm_a, impulse);
  PlatformTerm term{{step.velocity.x, step.velocity.y, step.spin, 0.0, 0.0, 0.0, twist}};
  if (ice) {
    term.part[3] = impulse.x;
    term.part[4] = impulse.y;
    term.part[5] = twist;
  }
  return term;
}

/// Writes the terms of all contact points of the time step in order, and platform events to the ring. Returns the
/// number of terms. `pressed` counts the floes that push.
template <ContactSolver solver, class Warp>
GEM_DEVICE inline std::int32_t collect_terms(const DeviceScene& s, const Warp& warp, const BodyCell& cell,
                                             const BodyMotion& motion, std::int32_t step, PlatformTerm* term,
                                             std::int32_t& pressed) {
  DeviceStatus& status = *s.status;
  constexpr bool coupled = solver == ContactSolver::coupled;
  const std::int32_t places = s.row_length(0, motion);
  std::int32_t terms = 0, events = status.events;
  for (std::int32_t first = 0; first < places; first += Warp::size) {
    const std::int32_t at = first + warp.rank(), row = motion.row_begin + (at < places ? at : 0);
    // loaded together to hide the latency of memory
    const std::int32_t stamp = s.stamp[row].entry, pair = s.row_pair[row], other = s.row_other[row];
    const bool touched = at < places && stamp == step;
    const Contact* const contact = &s.contact[pair];
    const int points = touched ? contact->count : 0;
    const bool ice = touched && s.body[other].kind == BodyKind::floe;
    const unsigned one = warp.ballot(points > 0), two = warp.ballot(points > 1);
    const std::int32_t to = terms + warp.count_below(one) + warp.count_below(two);
    bool presses = false;
    for (int k = 0; k < 2; ++k) {
      if (k >= points) break;
      const ContactSlot& slot = contact->slot[k];
      term[to + k] = platform_term<solver>(cell, *contact, slot, ice);
      presses = presses || (ice && slot.impulse.normal > 0.0);
    }
    const bool event =
        touched && s.wants_events && s.row_event_step[at] == step && (!coupled || gem::presses(*contact));
    const unsigned pressing = warp.ballot(presses), recorded = warp.ballot(event);
    if (event) {
      PlatformEventRecord& record = s.event[events + warp.count_below(recorded)];
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

/// Adds the terms in order, one part by each lane.
template <class Warp>
GEM_DEVICE inline PlatformSums add_terms(const Warp& warp, const PlatformSums& start, const PlatformTerm* term,
                                         std::int32_t terms) {
  constexpr int parts = 7;
  double sum[parts] = {start.velocity.x,    start.velocity.y, start.spin, start.ice_impulse.x,
                       start.ice_impulse.y, start.ice_yaw,    start.twist};
  for (int first = 0; first < parts; first += Warp::size) {
    const int part = first + warp.rank() < parts ? first + warp.rank() : parts - 1;
    const double sign = part == parts - 1 ? 1.0 : -1.0;
    double mine = sum[part];
    for (std::int32_t k = 0; k < terms; ++k) mine += sign * term[k].part[part];
    for (int lane = 0; lane < Warp::size && first + lane < parts; ++lane) sum[first + lane] = warp.from(mine, lane);
  }
  return {{sum[0], sum[1]}, sum[2], {sum[3], sum[4]}, sum[5], sum[6]};
}

/// Writes the sample of the time step to the ring.
GEM_DEVICE inline void write_sample(const DeviceScene& s, const PlatformLoaded& loaded, const Mover& mover, double spin,
                                    const PlatformSums& sums, std::int32_t pressed, std::int32_t at) {
  const PlatformCell& p = loaded.cell;
  PlatformStep& sample = s.sample[at];
  sample.position = mover.position;
  sample.rotation = mover.rotation;
  sample.velocity = p.velocity;
  sample.spin = spin;
  sample.ice_impulse = sums.ice_impulse;
  sample.ice_yaw_impulse = sums.ice_yaw;
  sample.mooring_impulse = p.mooring_force.momentum - p.mooring_before;
  sample.drag_impulse = loaded.drag_book.momentum - p.drag_before;
  sample.contacts = pressed;
  sample.broken = p.broken;
  if (s.dp) s.dp_sample[at] = *s.dp;
}

/// Gives the pieces of the platform the place and the motion of body 0, which owns them.
GEM_DEVICE inline void carry_pieces(const DeviceScene& s) {
  const Mover mover = mover_of(s.body[0]);
  for (std::int32_t i = 1; i < s.constants.pieces; ++i) {
    write_mover(s.body[i], mover);
    s.after[i].velocity = s.after[0].velocity;
    s.after[i].spin = s.after[0].spin;
  }
}

/// Moves the platform by one thread, after the contacts are summed.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void move_platform_body(const DeviceScene& s, Group& group, const Workspace& workspace,
                                          const PlatformSums& sums, const BodyRepair& repair, std::int32_t pressed,
                                          const StepIndex& step) {
  BodyCell& cell = workspace.body[0];
  const BodyMotion& motion = workspace.motion[0];
  PlatformLoaded loaded = load_platform(s);
  PlatformCell& p = loaded.cell;
  Mover mover = mover_of(cell);
  p.velocity = sums.velocity;
  if (cell.inverse_inertia == 0.0) p.mooring_force.angular_momentum = sums.twist;
  if (cell.active && cell.inverse_mass == 0.0) {  // a fixed platform: the ground holds it, see hold_platform()
    p.mooring_force.momentum += -sums.ice_impulse;
    p.mooring_force.angular_momentum += cross(mover.position, -sums.ice_impulse);
  }
  const Events& e = s.constants.events;
  double spin = sums.spin;
  if (e.platform_present) {
    const MovedPlatform moved{mover.rotation, p.mid_position, p.velocity, spin, loaded.drag_book};
    take_water_along(e, moved, {cell.velocity, cell.spin});
    const double turning = spin;  // it turns with the spin after the pair events
    const Rotation next = yaw_of_pull(e, mover.rotation, turning);
    turn_in_water(e, s.drive_of(step.sample), moved, next, true);
    platform_events_after(e, s.drive_of(step.sample),
                          platform_motion(turn_of(cell, motion, mover.rotation, next), spin, loaded));
    mover.position = p.mid_position + repair.shift;
    turn(mover, s.constants.dt * turning + repair.turn);
    if constexpr (solver == ContactSolver::coupled)
      book_platform_shift(e, motion.mass, p.velocity, p.broken, {p.mid_position, repair.shift, next, mover.rotation},
                          s.book(Channel::repair, 0));
    steer_platform(e, s.drive_of(step.sample),
                   {motion.inertia, mover.rotation, mover.position, p.velocity, spin, loaded.drag_book}, false);
    const PlatformTurn turned = turn_of(cell, motion, mover.rotation, mover.rotation);
    hold_station(s, loaded, turned, mover.position, spin, step.sample, false);
    thrust_platform(e, s.drive_of(step.sample), pushed_platform(loaded, turned, mover.position, spin));
  }
  if (cell.active && !is_finite(mover, p.velocity, spin)) group.raise(alarm_not_finite);
  if (s.wants_samples) write_sample(s, loaded, mover, spin, sums, pressed, step.sample);
  if (cell.active && left_trajectory(s, mover, cell.radius, motion, step.elapsed)) group.raise(alarm_strayed);
  if ((s.wants_events && s.events_capacity - s.status->events < s.platform_capacity) || forces_fill_up(s))
    group.raise(alarm_ring_full);
  p.spin = spin;
  if (step.kick_next)
    platform_first_half(s, loaded, mover, turn_of(cell, motion, mover.rotation, mover.rotation), spin, step.sample + 1);
  store_platform(s, loaded);
  s.after[0].velocity = sums.velocity;
  s.after[0].spin = sums.spin;
  write_mover(cell, mover);
  if (!workspace.writes_through) return;  // plan_step() then carries the pieces
  write_mover(s.body[0], mover);
  carry_pieces(s);
}

/// Turns the outlines of the platform that are too long for a workspace.
template <class Warp>
GEM_DEVICE inline void turn_platform(const DeviceScene& s, const Warp& warp, const BodyCell& cell) {
  for (std::int32_t i = 0; i < s.constants.pieces; ++i) {
    const BodyCell& piece = i == 0 ? cell : s.body[i];
    if (piece.vertex_count > workspace_vertices)
      turn_outline(s, piece.vertex_begin, piece.vertex_count, cell.rotation, warp.rank(), Warp::size);
  }
}

/// The body stages of the platform, by its warp.
template <ContactSolver solver, class Group>
GEM_DEVICE inline void move_platform(const DeviceScene& s, Group& group, const Workspace& workspace,
                                     const StepIndex& step) {
  const auto warp = group.warp();
  const BodyCell& cell = workspace.body[0];
  std::int32_t pressed = 0;
  PlatformTerm* const term = term_memory(s, workspace, s.row_length(0, workspace.motion[0]));
  const std::int32_t terms = collect_terms<solver>(s, warp, cell, workspace.motion[0], step.step, term, pressed);
  PlatformSums start;
  BodyAfter after{cell.velocity, cell.spin};
  BodyRepair repair;
  if constexpr (solver == ContactSolver::coupled) load_solved(s, 0, step.step, after, repair);
  start.velocity = after.velocity;
  start.spin = after.spin;
  start.twist = s.platform->mooring_force.angular_momentum;
  const double travel = cell.turn_travel;
  const PlatformSums sums = add_terms(warp, start, term, terms);
  warp.sync();
  if (warp.rank() == 0) move_platform_body<solver>(s, group, workspace, sums, repair, pressed, step);
  warp.sync();
  if (cell.turn_travel != travel) turn_platform(s, warp, cell);
}

}  // namespace gem
