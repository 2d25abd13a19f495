// The moments of a device scene: the order of the phases and what is done between them.
//
//   solo events of the first moment
//   repeat:  the list of near pairs, where it has worn out
//            pairs phase                               | barrier
//            bodies phase, with the solo events of the next moment | barrier
//   the books of the last moment
#pragma once

#include "gem/engine/device_bodies.h"
#include "gem/engine/device_list.h"
#include "gem/engine/device_pairs.h"
#include "gem/engine/device_platform.h"

namespace gem {

/// What a thread works on: its block's stretches of pairs and bodies. The platform's warp leaves the floes to others.
struct Share {
  Stretch pairs, bodies;
  std::int32_t first_body = 0, body_step = 1;
  bool platform = false;
};

template <class Crew>
GEM_DEVICE inline Share share_of(const DeviceScene& s, const Crew& crew) {
  Share share;
  share.pairs = stretch_of(crew, s.counters->pairs);
  share.bodies = stretch_of(crew, s.bodies);
  const int warp = Crew::Warp::size;
  const bool alone = crew.threads() <= warp;
  share.platform = crew.block() == 0 && (alone || crew.thread() >= crew.threads() - warp);
  share.body_step = crew.block() == 0 && !alone ? crew.threads() - warp : crew.threads();
  share.first_body = share.platform && !alone ? share.bodies.end : share.bodies.begin + crew.thread();
  return share;
}

/// Solo events up to the instant of the first moment's pair events.
template <class Crew>
GEM_DEVICE inline void first_solo_events(const DeviceScene& s, const Crew& crew, const Share& share) {
  for (std::int32_t i = share.first_body; i < share.bodies.end; i += share.body_step)
    if (s.body[i].kind == BodyKind::floe) kick_body(s, i, s.body[i], s.motion[i]);
  if (share.platform && crew.warp().rank() == 0) platform_first_half(s, s.body[0], s.motion[0].mass);
}

/// The bodies phase of one moment.
template <class Crew>
GEM_DEVICE inline void bodies_phase(const DeviceScene& s, Crew& crew, const Share& share, const MomentStep& step) {
  BlockCell& shared = crew.shared();
  if (crew.thread() == 0) {
    if (s.wants_samples) s.quality[step.sample * crew.blocks() + crew.block()] = {shared.overlap, shared.contacts, 0};
    shared.overlap = 0;
    shared.contacts = shared.looks = shared.touches = 0;
  }
  for (std::int32_t i = share.first_body; i < share.bodies.end; i += share.body_step) move_body(s, crew, i, step);
  if (share.platform) move_platform(s, crew, step);
  crew.block_barrier();
  turn_outlines(s, crew, share.bodies.begin, share.bodies.end);
}

/// Brings the books of contact work up to date; no contact is left waiting.
template <class Crew>
GEM_DEVICE inline void close_work(const DeviceScene& s, Crew& crew, const Share& share, std::int32_t moment) {
  const std::int32_t stamp = -2 - moment;  // unlike the stamp of any moment
  work_of_last_moment(s, crew, share.pairs, stamp);
  crew.barrier();
  if (crew.thread() == 0) crew.shared().touched = 0;
  for (std::int32_t i = share.first_body; i < share.bodies.end; i += share.body_step)
    gather_work(s, i, s.body[i], s.motion[i], stamp);
}

/// The state at rest, for the host.
template <class Crew>
GEM_DEVICE inline void write_state(const DeviceScene& s, const Crew& crew) {
  for (std::int32_t i = rank_of(crew); i < s.bodies; i += size_of(crew)) {
    const BodyCell& cell = s.body[i];
    const Vec2 velocity = i == 0 ? s.platform->velocity : cell.velocity_after;
    s.state[i] = {cell.position, s.motion[i].rotation, velocity, cell.spin_after, cell.active};
  }
}

/// Moves the scene on by `moments` moments, or less where something has to be done by the host first: the status says.
template <class Crew>
GEM_DEVICE inline void advance_scene(const DeviceScene& s, Crew& crew, std::int32_t moments) {
  DeviceStatus& status = *s.status;
  const bool one = rank_of(crew) == 0;
  const std::int64_t start = status.moment;
  std::int64_t list_moment = status.list_moment;
  bool list_valid = status.list_valid != 0;
  if (crew.thread() == 0) crew.shared() = {};
  crew.block_barrier();
  Share share = share_of(s, crew);
  if (!status.half_way) first_solo_events(s, crew, share);
  crew.barrier();
  if (one) {
    status.half_way = 1;
    status.events = 0;
  }
  crew.barrier();

  DeviceStop stop = DeviceStop::done;
  std::int32_t done = 0;
  for (; done < moments; ++done) {
    const std::int32_t moment = static_cast<std::int32_t>(start) + done;
    const std::uint32_t alarms = crew.alarms();
    if (alarms & (alarm_not_finite | alarm_ring_full)) {
      stop = alarms & alarm_not_finite ? DeviceStop::not_finite : DeviceStop::ring_full;
      list_valid = list_valid && !(alarms & alarm_strayed);
      break;
    }
    if (!list_valid || moment - list_moment >= s.horizon || (alarms & alarm_strayed)) {
      close_work(s, crew, share, moment);
      build_list(s, crew, moment);
      share = share_of(s, crew);
      list_valid = !(crew.alarms() & alarm_list_full);
      list_moment = moment;
      if (!list_valid) {
        stop = DeviceStop::list_full;
        break;
      }
    }
    pairs_phase(s, crew, share.pairs, moment);
    crew.barrier();
    const double elapsed = static_cast<double>(moment + 1 - list_moment) * s.constants.dt;
    bodies_phase(s, crew, share, {moment, done, elapsed, done + 1 < moments});
    crew.barrier();
  }
  if (stop == DeviceStop::done && (crew.alarms() & alarm_not_finite)) stop = DeviceStop::not_finite;
  list_valid = list_valid && !(crew.alarms() & alarm_strayed);

  close_work(s, crew, share, static_cast<std::int32_t>(start) + done);
  write_state(s, crew);
  crew.barrier();
  if (one) {
    status.moment = start + done;
    status.samples = done;
    status.list_valid = list_valid;
    status.half_way = done < moments;
    status.stop = stop;
  }
}

}  // namespace gem
