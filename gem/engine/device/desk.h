// What a block keeps close at hand while it works on a scene: copies of its own bodies and pairs, and room to turn the
// outlines that it looks at.
#pragma once

#include "gem/engine/device/crew.h"
#include "gem/engine/device/scene.h"

namespace gem {

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
  Stretch bodies{}, pairs{};
  std::int32_t first_body = 0, body_step = 1;  // of the thread: the platform's warp leaves the floes to others
  bool platform = false;                       // the thread belongs to the platform's warp
  bool shows = true;                           // moved bodies are shown to other blocks at once, not at the end
  BodyCell* body = nullptr;
  BodyMotion* motion = nullptr;
  PairCell* pair = nullptr;
  LookItem* look = nullptr;          // one for each thread
  DeskOutlines* outlines = nullptr;  // one for each group of lanes
  // the room of looks and outlines, and what the copies leave, serves the iterations of a coupled moment too; that of
  // the looks also the platform's terms
  std::size_t minimum_bytes = 0, bodies_begin = 0, solver_bytes = 0;
};

/// Bytes that a desk cannot do without.
GEM_HD inline std::size_t desk_minimum(int threads, int lanes) {
  return static_cast<std::size_t>(threads) * sizeof(LookItem) +
         static_cast<std::size_t>(threads / lanes) * sizeof(DeskOutlines) + 256;
}

/// What is copied at once.
struct alignas(16) CopyWord {
  std::uint64_t low, high;
};

/// Copies words begin to end - 1 of each of some records of `words` words: neighbouring threads take neighbouring
/// memory, and each asks for several words before it waits.
template <int words, int begin, int end, class Crew>
GEM_DEVICE inline void copy_parts(const Crew& crew, void* to, const void* from, std::int32_t records) {
  constexpr int together = 8, part = end - begin;
  auto* const target = static_cast<CopyWord*>(to);
  const auto* const source = static_cast<const CopyWord*>(from);
  const auto place = [](std::int32_t w) { return w / part * words + begin + w % part; };
  const std::int32_t count = records * part, step = crew.threads();
  for (std::int32_t first = crew.thread(); first < count; first += together * step) {
    CopyWord some[together];
    for (int k = 0; k < together; ++k)
      if (first + k * step < count) some[k] = source[place(first + k * step)];
    for (int k = 0; k < together; ++k)
      if (first + k * step < count) target[place(first + k * step)] = some[k];
  }
}

/// Copies whole records.
static_assert(sizeof(BodyCell) % sizeof(CopyWord) == 0 && sizeof(BodyMotion) % sizeof(CopyWord) == 0 &&
              sizeof(PairCell) % sizeof(CopyWord) == 0);
template <class Crew>
GEM_DEVICE inline void copy_words(const Crew& crew, void* to, const void* from, std::size_t bytes) {
  copy_parts<1, 0, 1>(crew, to, from, static_cast<std::int32_t>(bytes / sizeof(CopyWord)));
}

/// The fast memory is shared out by lines.
constexpr std::size_t desk_line = 128;
GEM_DEVICE inline std::size_t whole_lines(std::size_t bytes) { return (bytes + desk_line - 1) / desk_line * desk_line; }

/// Shares out the bodies among the threads; everything else stands in the scene's memory.
template <class Crew>
GEM_DEVICE inline Desk share_bodies(const DeviceScene& s, const Crew& crew) {
  Desk desk;
  desk.bodies = stretch_of(crew, s.bodies);
  const int warp = Crew::Warp::size;
  const bool alone = crew.threads() <= warp;
  desk.platform = crew.block() == 0 && (alone || crew.thread() >= crew.threads() - warp);
  desk.body_step = crew.block() == 0 && !alone ? crew.threads() - warp : crew.threads();
  desk.first_body = desk.platform && !alone ? desk.bodies.end : desk.bodies.begin + crew.thread();
  desk.body = s.body;
  desk.motion = s.motion;
  desk.pair = s.pair;
  return desk;
}

/// Shares out the fast memory and the threads.
template <class Crew>
GEM_DEVICE inline Desk make_desk(const DeviceScene& s, Crew& crew) {
  Desk desk = share_bodies(s, crew);
  // from the start what every moment fills anew, from the end the copies
  const std::size_t looks = whole_lines(crew.threads() * sizeof(LookItem)),
                    outlines = whole_lines(crew.threads() / Crew::Lanes::size * sizeof(DeskOutlines));
  desk.look = reinterpret_cast<LookItem*>(crew.room());
  desk.outlines = reinterpret_cast<DeskOutlines*>(crew.room() + looks);
  desk.minimum_bytes = looks + outlines;
  desk.bodies_begin = crew.room_bytes() / desk_line * desk_line;
  const std::size_t own = desk.bodies.count(), cells = whole_lines(own * sizeof(BodyCell)),
                    motions = whole_lines(own * sizeof(BodyMotion));
  if (desk.minimum_bytes + cells + motions <= desk.bodies_begin) {
    desk.bodies_begin -= cells + motions;
    desk.body = reinterpret_cast<BodyCell*>(crew.room() + desk.bodies_begin) - desk.bodies.begin;
    desk.motion = reinterpret_cast<BodyMotion*>(crew.room() + desk.bodies_begin + cells) - desk.bodies.begin;
  }
  desk.solver_bytes = desk.bodies_begin;
  return desk;
}

/// Takes the block's pairs to the desk, after a list was built or at the start of a call.
template <class Crew>
GEM_DEVICE inline void take_pairs(const DeviceScene& s, Crew& crew, Desk& desk) {
  desk.pairs = stretch_of(crew, s.counters->pairs);
  const std::size_t bytes = desk.pairs.count() * sizeof(PairCell);
  desk.pair = s.pair;
  desk.solver_bytes = desk.bodies_begin;
  if (bytes > desk.bodies_begin - desk.minimum_bytes) return;  // both are whole lines
  desk.solver_bytes -= whole_lines(bytes);
  std::byte* const to = crew.room() + desk.solver_bytes;
  desk.pair = reinterpret_cast<PairCell*>(to) - desk.pairs.begin;
  copy_words(crew, to, s.pair + desk.pairs.begin, bytes);
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

/// Moved bodies are shown at once, so the scene's cells are up to date; what the owner alone reads has to go back.
template <class Crew>
GEM_DEVICE inline void put_bodies_back(const DeviceScene& s, Crew& crew, const Desk& desk) {
  const std::int32_t first = desk.bodies.begin;
  if (desk.motion == s.motion) return;
  copy_words(crew, s.motion + first, desk.motion + first, desk.bodies.count() * sizeof(BodyMotion));
}

}  // namespace gem
