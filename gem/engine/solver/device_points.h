// The contact points of a coupled moment: opened where a pair touches, and what they carried from moment to moment.
#pragma once

#include "gem/engine/device/list.h"
#include "gem/engine/step/pair_event.h"

namespace gem {

/// Marks a moving body as one with points.
template <class Crew>
GEM_DEVICE inline void mark_touched(const DeviceScene& s, Crew& crew, std::int32_t body, double inverse_mass) {
  if (!(inverse_mass > 0.0)) return;
  const std::int32_t spot = s.spot[body];
  crew.set_bit(&s.touched_bodies[body / 32], 1U << (body % 32));
  crew.set_bit(&s.touched_spots[spot / 32], 1U << (spot % 32));
}

/// Gives the points of a contact their cells and shows them to the rows of both bodies.
template <class Crew>
GEM_DEVICE inline void open_points(const DeviceScene& s, Crew& crew, const PairCell& pair, const Touch& touch,
                                   std::int32_t moment) {
  const std::int32_t first = crew.shared().first_point + touch.first_point, count = touch.geometry.count;
  for (std::int32_t k = 0; k < count; ++k) {
    PointCell& point = s.point[first + k];
    point.pair = touch.pair;
    point.slot = k;
    point.a = {pair.a, -1, -1, -1};
    point.b = {pair.b, -1, -1, -1};
  }
  for (const std::int32_t row : {pair.row_a, pair.row_b}) {
    s.row_points[row].first = first;
    s.row_points[row].count = count;
    s.stamp[row].entry = moment;
  }
  mark_touched(s, crew, pair.a, s.body[pair.a].inverse_mass);
  mark_touched(s, crew, pair.b, s.body[pair.b].inverse_mass);
}

/// What the point carried a moment ago; nothing, where it did not touch then.
GEM_DEVICE inline PointImpulse<double> last_impulse(const PairMemory& memory, std::int32_t feature,
                                                    std::int32_t moment) {
  if (memory.moment != moment - 1) return {0.0, 0.0, 0.0};
  for (int k = 0; k < 2; ++k)
    if (memory.feature[k] == feature) {
      const PointImpulse<double>& last = memory.impulse[k];
      return {last.normal, last.tangential, last.repair};
    }
  return {0.0, 0.0, 0.0};
}

/// Keeps what point `slot` of a contact carries for the next moment.
GEM_DEVICE inline void remember(PairMemory& memory, const Contact& contact, std::int32_t slot,
                                const PointImpulse<double>& impulse, std::int32_t moment) {
  memory.feature[slot] = contact.slot[slot].feature;
  memory.impulse[slot].normal = impulse.normal;
  memory.impulse[slot].tangential = impulse.tangential;
  memory.impulse[slot].repair = impulse.repair;
  if (slot != 0) return;
  memory.moment = moment;
  if (contact.count < 2) memory.feature[1] = -1;
}

/// Takes the memory of a pair that touched in the last moment out of the list.
template <class Crew>
GEM_DEVICE inline void carry_pair(const DeviceScene& s, Crew& crew, const PairCell& pair, const PairMemory& memory) {
  CarriedMemory& carried = s.carried[crew.add(&s.status->carried, 1)];
  carried.a = pair.a;
  carried.b = pair.b;
  for (int j = 0; j < 2; ++j) {
    carried.feature[j] = memory.feature[j];
    // a contact of one point has no second impulse
    carried.impulse[j] = carried.feature[j] < 0 ? PointImpulse<double>{} : memory.impulse[j];
  }
}

/// Takes the memory of the last moment's contacts out of the list, before the list or the call ends.
template <class Crew>
GEM_DEVICE inline void carry_memory(const DeviceScene& s, Crew& crew, const Desk& desk) {
  if (rank_of(crew) == 0) s.status->carried = 0;
  crew.barrier();
  for (std::int32_t k = crew.thread(); k < crew.shared().touched; k += crew.threads()) {
    const std::int32_t p = s.touched[desk.pairs.begin + k];
    carry_pair(s, crew, desk.pair[p], s.memory[p]);
  }
}

/// Hands the memory of the moment before `moment` to the pairs of a new list.
template <class Crew>
GEM_DEVICE inline void hand_out_memory(const DeviceScene& s, Crew& crew, std::int32_t moment) {
  for (std::int32_t k = rank_of(crew); k < s.status->carried; k += size_of(crew)) {
    const CarriedMemory& carried = s.carried[k];
    if (s.motion[carried.a].row_count == 0) continue;
    const std::int32_t row = place_in_row(s, carried.a, carried.b);
    if (s.row_other[row] != carried.b) continue;
    PairMemory& memory = s.memory[s.row_pair[row]];
    memory.moment = moment - 1;
    for (int j = 0; j < 2; ++j) {
      memory.feature[j] = carried.feature[j];
      memory.impulse[j] = carried.impulse[j];
    }
  }
}

}  // namespace gem
