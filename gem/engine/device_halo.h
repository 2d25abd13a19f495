// The bodies that the points of a block meet, and that it moves itself in every iteration: its own ones, and copies of
// those of other blocks, its halo, one for each point that meets such a body. Blocks that reach each other by the
// memory of all alone then meet once in an iteration, where they would wait twice: for the motions, and for what the
// points push.
#pragma once

#include "gem/engine/device_solver_list.h"

namespace gem {

template <class Crew>
class SolverHalo {
 public:
  GEM_DEVICE SolverHalo(const DeviceScene& s, Crew& crew, std::size_t room) : s_(s), crew_(crew), room_(room) {}

  /// Says so where the block's fast memory might not hold them all: then no block of the crew has a halo.
  GEM_DEVICE void ask_for_room() {
    if (crew_.thread() == 0 && bytes_for(most_of(crew_.shared().desk)) > room_)
      crew_.set_bit(&s_.counters->crowded, 1U);
  }

  /// Takes the bodies up, if all blocks have room; after a barrier of all. Place 0 is the platform's.
  GEM_DEVICE void take_up() {
    if (s_.counters->crowded != 0) return;
    BlockCell& shared = crew_.shared();
    SolverDesk desk = shared.desk;
    desk.stage_bytes = room_ - bytes_for(most_of(desk));
    desk.motion = reinterpret_cast<AddedMotion*>(crew_.room() + desk.stage_bytes);
    desk.moved_entry = reinterpret_cast<SolverEntry*>(desk.motion + 2 * ((most_of(desk) + 1) / 2));
    const std::int32_t first = desk.own.begin + (desk.platform ? 1 : 0), own_end = 1 + desk.own.end - first;
    const auto take = [&](std::int32_t place, std::int32_t entry) {
      desk.moved_entry[place] = s_.solver_entry[entry];
      desk.motion[place] = {};  // nothing has been added to it
      return place;
    };
    const auto take_for_point = [&](PointSide& side) {
      if (side.place < 0) return;  // a fixed body
      const std::int32_t entry = side.motion;
      if (side.body == 0)
        side.motion = crew_.add(&shared.platform_points, 1) == 0 ? take(0, entry) : 0;
      else if (entry >= desk.own.begin && entry < desk.own.end)
        side.motion = 1 + entry - first;
      else
        side.motion = take(own_end + crew_.add(&shared.halo, 1), entry);
    };
    for (std::int32_t e = first + crew_.thread(); e < desk.own.end; e += crew_.threads()) take(1 + e - first, e);
    each_point(crew_, [&](std::int32_t i) {
      take_for_point(s_.taken_point[i].a);
      take_for_point(s_.taken_point[i].b);
    });
    crew_.block_barrier();
    if (crew_.thread() == 0) {
      desk.has_halo = true;
      desk.platform = shared.platform_points > 0;
      desk.moved = {desk.platform ? 0 : 1, own_end + shared.halo};
      shared.desk = desk;
    }
    crew_.block_barrier();
  }

 private:
  /// One body of a point is the block's own. An even number keeps entries aligned.
  GEM_DEVICE static std::int32_t most_of(const SolverDesk& desk) { return 1 + desk.own.count() + desk.points.count(); }
  GEM_DEVICE static std::size_t bytes_for(std::int32_t bodies) {
    const auto some = static_cast<std::size_t>((bodies + 1) / 2 * 2);
    return some * (sizeof(AddedMotion) + sizeof(SolverEntry));
  }

  const DeviceScene& s_;
  Crew& crew_;
  std::size_t room_;
};

}  // namespace gem
