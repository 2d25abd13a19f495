// The contact points of a coupled time step: opened where a pair touches, with the impulses that they had one time step
// ago.
#pragma once

#include "gem/engine/device/list.h"
#include "gem/engine/step/pair_event.h"

namespace gem {

/// Marks a moving body as one with points; fixed bodies are ignored.
template <class Group>
GEM_DEVICE inline void mark_touched(const DeviceScene& s, Group& group, std::int32_t body, double inverse_mass) {
  if (!(inverse_mass > 0.0)) return;
  const std::int32_t sorted_place = s.sorted_place[body];
  group.set_bit(&s.touched_bodies[body / 32], 1U << (body % 32));
  group.set_bit(&s.touched_sorted[sorted_place / 32], 1U << (sorted_place % 32));
}

/// Fills the cells of a contact's points and enters the points in the rows of both bodies.
template <class Group>
GEM_DEVICE inline void open_points(const DeviceScene& s, Group& group, const PairCell& pair,
                                   const TouchingPair& touching, std::int32_t step) {
  const std::int32_t first = group.shared().first_point + touching.first_point, count = touching.geometry.count;
  const std::int32_t a = s.constants.owner_of(pair.a);
  for (std::int32_t k = 0; k < count; ++k) {
    PointCell& point = s.point[first + k];
    point.pair = touching.pair;
    point.slot = k;
    point.a = {a, -1, -1, -1};
    point.b = {pair.b, -1, -1, -1};
  }
  for (const std::int32_t row : {pair.row_a, pair.row_b}) {
    s.row_points[row].first = first;
    s.row_points[row].count = count;
    s.stamp[row].entry = step;
  }
  mark_touched(s, group, a, s.body[a].inverse_mass);
  mark_touched(s, group, pair.b, s.body[pair.b].inverse_mass);
}

/// What the point has carried from the last time step; zero if it did not exist then.
GEM_DEVICE inline PointMemory memory_of(const PairMemory& memory, std::int32_t feature, std::int32_t step) {
  if (memory.step != step - 1) return {};
  for (int k = 0; k < 2; ++k)
    if (memory.feature[k] == feature) return memory.point[k];
  return {};
}

/// Keeps what point `slot` of a contact carries into the next time step.
GEM_DEVICE inline void remember(PairMemory& memory, const Contact& contact, std::int32_t slot,
                                const PointImpulse<double>& impulse, std::int32_t step) {
  memory.feature[slot] = contact.slot[slot].feature;
  memory.point[slot] = {impulse, rise_of_load(contact.slot[slot].last_normal, impulse.normal)};
  if (slot != 0) return;
  memory.step = step;
  if (contact.count < 2) memory.feature[1] = -1;
}

/// Copies the memory of a pair that touched in the last time step to DeviceScene::carried.
template <class Group>
GEM_DEVICE inline void carry_pair(const DeviceScene& s, Group& group, const PairCell& pair, const PairMemory& memory) {
  CarriedMemory& carried = s.carried[group.add(&s.status->carried, 1)];
  carried.a = pair.a;
  carried.b = pair.b;
  for (int j = 0; j < 2; ++j) {
    carried.feature[j] = memory.feature[j];
    // a contact of one point has no second
    carried.point[j] = carried.feature[j] < 0 ? PointMemory{} : memory.point[j];
  }
}

/// Copies the memory of the last time step's contacts to DeviceScene::carried, before the list or the call ends.
template <class Group>
GEM_DEVICE inline void carry_memory(const DeviceScene& s, Group& group, const Workspace& workspace) {
  if (rank_of(group) == 0) s.status->carried = 0;
  group.barrier();
  for (std::int32_t k = group.thread(); k < group.shared().touched; k += group.threads()) {
    const std::int32_t p = s.touched[workspace.pairs.begin + k];
    carry_pair(s, group, workspace.pair[p], s.memory[p]);
  }
}

/// Copies the carried memory of time step `step` - 1 to the pairs of a new list.
template <class Group>
GEM_DEVICE inline void hand_out_memory(const DeviceScene& s, Group& group, std::int32_t step) {
  for (std::int32_t k = rank_of(group); k < s.status->carried; k += size_of(group)) {
    const CarriedMemory& carried = s.carried[k];
    if (s.motion[carried.a].row_count == 0) continue;
    const std::int32_t row = place_in_row(s, carried.a, carried.b);
    if (s.row_other[row] != carried.b) continue;
    PairMemory& memory = s.memory[s.row_pair[row]];
    memory.step = step - 1;
    for (int j = 0; j < 2; ++j) {
      memory.feature[j] = carried.feature[j];
      memory.point[j] = carried.point[j];
    }
  }
}

}  // namespace gem
