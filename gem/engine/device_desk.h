// What a block keeps close at hand while it works on a scene: copies of its own bodies and pairs, and room to turn the
// outlines that it looks at.
#pragma once

#include "gem/engine/crew.h"
#include "gem/engine/device_scene.h"

namespace gem {

/// A block's stretch of [0, count).
struct Stretch {
  std::int32_t begin = 0, end = 0;
  GEM_DEVICE std::int32_t count() const { return end - begin; }
};

template <class Crew>
GEM_DEVICE inline Stretch stretch_of(const Crew& crew, std::int32_t count) {
  const std::int64_t all = count;
  return {static_cast<std::int32_t>(all * crew.block() / crew.blocks()),
          static_cast<std::int32_t>(all * (crew.block() + 1) / crew.blocks())};
}

/// Room for the two outlines of one group of lanes.
struct DeskOutlines {
  Vec2 corner[2][desk_vertices], normal[2][desk_vertices];
};

/// Arrays are indexed as those of the scene. Where the fast memory does not hold the copies, they are the scene's own.
struct Desk {
  Stretch bodies, pairs;
  std::int32_t first_body = 0, body_step = 1;  // of the thread: the platform's warp leaves the floes to others
  bool platform = false;                       // the thread belongs to the platform's warp
  BodyCell* body = nullptr;
  BodyMotion* motion = nullptr;
  PairCell* pair = nullptr;
  LookItem* look = nullptr;          // one for each thread
  DeskOutlines* outlines = nullptr;  // one for each group of lanes
  std::size_t solver_bytes = 0;      // the room of looks and outlines serves the iterations of a coupled moment too
  std::byte* pairs_room = nullptr;
  std::size_t pairs_bytes = 0;
};

/// Bytes that a desk cannot do without.
GEM_HD inline std::size_t desk_minimum(int threads, int lanes) {
  return static_cast<std::size_t>(threads) * sizeof(LookItem) +
         static_cast<std::size_t>(threads / lanes) * sizeof(DeskOutlines) + 256;
}

template <class Crew>
GEM_DEVICE inline void copy_words(const Crew& crew, void* to, const void* from, std::size_t bytes) {
  auto* target = static_cast<std::uint64_t*>(to);
  const auto* source = static_cast<const std::uint64_t*>(from);
  for (std::size_t w = crew.thread(); w < bytes / sizeof(std::uint64_t); w += crew.threads()) target[w] = source[w];
}

/// Shares out the fast memory and the threads.
template <class Crew>
GEM_DEVICE inline Desk make_desk(const DeviceScene& s, Crew& crew) {
  Desk desk;
  desk.bodies = stretch_of(crew, s.bodies);
  const int warp = Crew::Warp::size;
  const bool alone = crew.threads() <= warp;
  desk.platform = crew.block() == 0 && (alone || crew.thread() >= crew.threads() - warp);
  desk.body_step = crew.block() == 0 && !alone ? crew.threads() - warp : crew.threads();
  desk.first_body = desk.platform && !alone ? desk.bodies.end : desk.bodies.begin + crew.thread();

  std::byte* room = crew.room();
  std::byte* const end = room + crew.room_bytes();
  const auto take = [&](std::size_t bytes) {
    std::byte* taken = room;
    room += (bytes + 127) / 128 * 128;
    return taken;
  };
  const auto fits = [&](std::size_t bytes) { return room + bytes + 128 <= end; };
  desk.look = reinterpret_cast<LookItem*>(take(crew.threads() * sizeof(LookItem)));
  desk.outlines = reinterpret_cast<DeskOutlines*>(take(crew.threads() / Crew::Lanes::size * sizeof(DeskOutlines)));
  desk.solver_bytes = room - crew.room();
  desk.body = s.body;
  desk.motion = s.motion;
  const std::size_t own = desk.bodies.count();
  if (fits(own * (sizeof(BodyCell) + sizeof(BodyMotion)))) {
    desk.body = reinterpret_cast<BodyCell*>(take(own * sizeof(BodyCell))) - desk.bodies.begin;
    desk.motion = reinterpret_cast<BodyMotion*>(take(own * sizeof(BodyMotion))) - desk.bodies.begin;
  }
  desk.pairs_room = room;
  desk.pairs_bytes = end - room;
  return desk;
}

/// Takes the block's pairs to the desk, after a list was built or at the start of a call.
template <class Crew>
GEM_DEVICE inline void take_pairs(const DeviceScene& s, Crew& crew, Desk& desk) {
  desk.pairs = stretch_of(crew, s.counters->pairs);
  const std::size_t bytes = desk.pairs.count() * sizeof(PairCell);
  desk.pair = s.pair;
  if (bytes > desk.pairs_bytes) return;
  desk.pair = reinterpret_cast<PairCell*>(desk.pairs_room) - desk.pairs.begin;
  copy_words(crew, desk.pairs_room, s.pair + desk.pairs.begin, bytes);
}

template <class Crew>
GEM_DEVICE inline void put_pairs_back(const DeviceScene& s, Crew& crew, const Desk& desk) {
  if (desk.pair != s.pair)
    copy_words(crew, s.pair + desk.pairs.begin, desk.pair + desk.pairs.begin, desk.pairs.count() * sizeof(PairCell));
}

template <class Crew>
GEM_DEVICE inline void take_bodies(const DeviceScene& s, Crew& crew, const Desk& desk) {
  if (desk.body == s.body) return;
  const std::int32_t first = desk.bodies.begin;
  copy_words(crew, desk.body + first, s.body + first, desk.bodies.count() * sizeof(BodyCell));
  copy_words(crew, desk.motion + first, s.motion + first, desk.bodies.count() * sizeof(BodyMotion));
}

/// The scene's cells are always up to date; only what the owner alone reads has to go back.
template <class Crew>
GEM_DEVICE inline void put_bodies_back(const DeviceScene& s, Crew& crew, const Desk& desk) {
  const std::int32_t first = desk.bodies.begin;
  if (desk.motion != s.motion)
    copy_words(crew, s.motion + first, desk.motion + first, desk.bodies.count() * sizeof(BodyMotion));
}

}  // namespace gem
