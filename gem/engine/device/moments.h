// The moments of a device scene: the order of the phases and what is done between them.
//
//   solo events of the first moment
//   repeat:  the list of near pairs, where it has worn out
//            pairs phase                               | barrier
//            coupled: the iterations                   | barrier
//            bodies phase, with the solo events of the next moment | barrier
//   the books of the last moment
#pragma once

#include "gem/engine/device/bodies.h"
#include "gem/engine/device/list.h"
#include "gem/engine/device/pairs.h"
#include "gem/engine/device/platform.h"
#include "gem/engine/solver/device_solver.h"

namespace gem {

/// Solo events up to the instant of the first moment's pair events.
template <class Crew>
GEM_DEVICE inline void first_solo_events(const DeviceScene& s, const Crew& crew, const Desk& desk) {
  for (std::int32_t i = desk.first_body; i < desk.bodies.end; i += desk.body_step) {
    if (i == 0 || desk.body[i].kind != BodyKind::floe || !desk.body[i].active) continue;
    Mover mover = mover_of(desk.body[i]);
    kick_body(s, mover, desk.motion[i], s.after[i], s.book(Channel::drag, i));
    write_mover(desk.body[i], mover);
    write_mover(s.body[i], mover);
  }
  if (!desk.platform || crew.warp().rank() != 0) return;
  Mover mover = mover_of(desk.body[0]);
  PlatformHeld held = hold_platform(s);
  platform_first_half(s, held, mover, desk.motion[0].mass, s.after[0].spin);
  let_go(s, held);
  write_mover(desk.body[0], mover);
  write_mover(s.body[0], mover);
}

/// The bodies of one moment move.
template <Resolution resolution, class Crew>
GEM_DEVICE inline void move_bodies(const DeviceScene& s, Crew& crew, const Desk& desk, const MomentStep& step) {
  for (std::int32_t i = desk.first_body; i < desk.bodies.end; i += desk.body_step)
    move_body<resolution>(s, crew, desk, i, step);
  if (desk.platform) move_platform<resolution>(s, crew, desk, step);
}

/// The bodies phase of one moment.
template <Resolution resolution, class Crew>
GEM_DEVICE inline void bodies_phase(const DeviceScene& s, Crew& crew, const Desk& desk, const MomentStep& step) {
  BlockCell& shared = crew.shared();
  if (crew.thread() == 0) {
    if (s.wants_samples)
      s.quality[step.sample * crew.blocks() + crew.block()] = {
          shared.overlap,  shared.share,          shared.contacts,        shared.iterations,
          shared.residual, shared.energy_created, shared.complementarity, shared.cone_excess};
    shared.overlap = shared.share = shared.complementarity = shared.cone_excess = 0;
    shared.contacts = shared.touches = shared.points = shared.iterations = 0;
    shared.residual = shared.energy_created = 0.0;
    if (crew.block() == 0) {
      s.counters->points = s.counters->taken_points = 0;
      s.counters->crowded = 0;
    }
  }
  move_bodies<resolution>(s, crew, desk, step);
}

/// Brings the books of contact work up to date; no contact is left waiting.
template <class Crew>
GEM_DEVICE inline void close_work(const DeviceScene& s, Crew& crew, const Desk& desk, std::int32_t moment) {
  const std::int32_t stamp = -2 - moment;  // unlike the stamp of any moment
  work_of_last_moment(s, crew, desk, stamp);
  crew.barrier();
  if (crew.thread() == 0) crew.shared().touched = 0;
  for (std::int32_t i = desk.first_body; i < desk.bodies.end; i += desk.body_step)
    gather_work(s, i, desk.motion[i], stamp);
}

/// The state at rest, for the host.
template <class Crew>
GEM_DEVICE inline void write_state(const DeviceScene& s, const Crew& crew) {
  for (std::int32_t i = rank_of(crew); i < s.bodies; i += size_of(crew)) {
    const BodyCell& cell = s.body[i];
    const Vec2 velocity = i == 0 ? s.platform->velocity : s.after[i].velocity;
    s.state[i] = {cell.position, cell.rotation, velocity, s.after[i].spin, cell.active};
  }
}

/// How long the list of near pairs may still be used.
struct ListLife {
  std::int64_t begin = 0;    // moment at whose start the list was built
  std::int64_t horizon = 1;  // moments that it was built for, or that the next one is
  bool valid = false;

  GEM_DEVICE explicit ListLife(const DeviceStatus& status)
      : begin(status.list_moment), horizon(status.horizon), valid(status.list_valid != 0) {}

  GEM_DEVICE bool is_over(std::int64_t moment, std::uint32_t alarms) const {
    return !valid || moment - begin >= horizon || (alarms & alarm_strayed);
  }
  /// Fast floes leave their courses early, and what they might reach later would only make the next list long: it is
  /// built for twice the time that this one lived.
  GEM_DEVICE void end(const DeviceScene& s, std::int64_t moment) {
    constexpr std::int64_t shortest = 4;
    if (!valid) return;
    const std::int64_t next = 2 * (moment - begin) > shortest ? 2 * (moment - begin) : shortest;
    horizon = next < s.horizon ? next : s.horizon;
    valid = false;
  }
};

/// advance_scene() of one resolution: what the other needs would only take registers.
template <Resolution resolution, class Crew>
GEM_DEVICE inline void advance_resolved(const DeviceScene& s, Crew& crew, std::int32_t moments) {
  DeviceStatus& status = *s.status;
  const bool one = rank_of(crew) == 0;
  const std::int64_t start = status.moment;
  ListLife list(status);
  constexpr bool coupled = resolution == Resolution::coupled;
  bool carried = true;  // the memory of the last moment stands apart from the list
  if (crew.thread() == 0) crew.shared() = {};
  crew.block_barrier();
  Desk desk = make_desk(s, crew);
  take_bodies(s, crew, desk);
  take_pairs(s, crew, desk);
  crew.block_barrier();
  if (!status.half_way) first_solo_events(s, crew, desk);
  crew.barrier();
  if (one) {
    status.half_way = 1;
    status.events = 0;
  }
  for (std::int32_t k = rank_of(crew); k < 2 * OverlapCount::classes; k += size_of(crew)) s.overlap_count[k] = 0;
  crew.barrier();

  DeviceStop stop = DeviceStop::done;
  std::int32_t done = 0;
  for (; done < moments; ++done) {
    const std::int32_t moment = static_cast<std::int32_t>(start) + done;
    const std::uint32_t alarms = crew.alarms();
    if (alarms & (alarm_not_finite | alarm_ring_full)) {
      stop = alarms & alarm_not_finite ? DeviceStop::not_finite : DeviceStop::ring_full;
      break;
    }
    if (list.is_over(moment, alarms)) {
      list.end(s, moment);
      if constexpr (coupled)
        if (!carried) carry_memory(s, crew, desk);
      carried = true;
      close_work(s, crew, desk, moment);
      crew.block_barrier();
      put_bodies_back(s, crew, desk);
      put_pairs_back(s, crew, desk);
      build_list(s, crew, moment, list.horizon);
      take_bodies(s, crew, desk);
      take_pairs(s, crew, desk);
      crew.block_barrier();
      list.valid = !(crew.alarms() & alarm_list_full);
      list.begin = moment;
      if (!list.valid) {
        stop = DeviceStop::list_full;
        break;
      }
      if constexpr (coupled) hand_out_memory(s, crew, moment);
    }
    pairs_phase<resolution>(s, crew, desk, moment);
    crew.barrier();
    if constexpr (coupled) resolve_coupled(s, crew, desk, moment);
    carried = false;
    const double elapsed = static_cast<double>(moment + 1 - list.begin) * s.constants.dt;
    bodies_phase<resolution>(s, crew, desk, {moment, done, elapsed, done + 1 < moments});
    crew.barrier();
  }
  if (stop == DeviceStop::done && (crew.alarms() & alarm_not_finite)) stop = DeviceStop::not_finite;
  if (crew.alarms() & alarm_strayed) list.end(s, start + done);

  if constexpr (coupled)
    if (!carried) carry_memory(s, crew, desk);
  close_work(s, crew, desk, static_cast<std::int32_t>(start) + done);
  crew.block_barrier();
  put_bodies_back(s, crew, desk);
  put_pairs_back(s, crew, desk);
  write_state(s, crew);
  crew.barrier();
  if (one) {
    status.moment = start + done;
    status.samples = done;
    status.list_valid = list.valid;
    status.horizon = list.horizon;
    status.half_way = done < moments;
    status.barriers = crew.barriers();
    status.stop = stop;
    status.visits = 0;  // counted by phases only
  }
}

/// Moves the scene on by `moments` moments, or less where something has to be done by the host first: the status says.
template <class Crew>
GEM_DEVICE inline void advance_scene(const DeviceScene& s, Crew& crew, std::int32_t moments) {
  // a scene that waits for others of its batch: its next moment has not begun
  if (moments == 0) return;
  if (s.constants.resolution == Resolution::coupled)
    advance_resolved<Resolution::coupled>(s, crew, moments);
  else
    advance_resolved<Resolution::independent>(s, crew, moments);
}

}  // namespace gem
