// What a block keeps close at hand while it works on a scene: copies of its own bodies and pairs, and room to turn the
// outlines that it looks at.
#pragma once

#include "gem/engine/device/scene.h"
#include "gem/engine/device/thread_group.h"

namespace gem {

template <class Group>
GEM_DEVICE inline Stretch stretch_of(const Group& group, std::int32_t count) {
  const std::int64_t all = count;
  return {static_cast<std::int32_t>(all * group.block() / group.blocks()),
          static_cast<std::int32_t>(all * (group.block() + 1) / group.blocks())};
}

/// Room for the two outlines of one group of lanes.
struct WorkspaceOutlines {
  Vec2 corner[2][workspace_vertices], normal[2][workspace_vertices];
};

/// Arrays are indexed as those of the scene. Where the shared memory does not hold the copies, they are the scene's
/// own.
struct Workspace {
  Stretch bodies{}, pairs{};
  std::int32_t first_body = 0, body_step = 1;  // of the thread: the platform's warp leaves the floes to others
  bool platform = false;                       // the thread belongs to the platform's warp
  bool shows = true;                           // moved bodies are shown to other blocks at once, not at the end
  BodyCell* body = nullptr;
  BodyMotion* motion = nullptr;
  PairCell* pair = nullptr;
  CandidatePair* candidate = nullptr;     // one for each thread
  WorkspaceOutlines* outlines = nullptr;  // one for each group of lanes
  // the room of looks and outlines, and what the copies leave, serves the iterations of a coupled time step too; that
  // of the looks also the platform's terms
  std::size_t minimum_bytes = 0, bodies_begin = 0, solver_bytes = 0;
};

/// Bytes that a workspace cannot do without.
GEM_HD inline std::size_t workspace_minimum(int threads, int lanes) {
  return static_cast<std::size_t>(threads) * sizeof(CandidatePair) +
         static_cast<std::size_t>(threads / lanes) * sizeof(WorkspaceOutlines) + 256;
}

/// What is copied at once.
struct alignas(16) CopyWord {
  std::uint64_t low, high;
};

/// Copies words begin to end - 1 of each of some records of `words` words: neighbouring threads take neighbouring
/// memory, and each asks for several words before it waits.
template <int words, int begin, int end, class Group>
GEM_DEVICE inline void copy_parts(const Group& group, void* to, const void* from, std::int32_t records) {
  constexpr int together = 8, part = end - begin;
  auto* const target = static_cast<CopyWord*>(to);
  const auto* const source = static_cast<const CopyWord*>(from);
  const auto place = [](std::int32_t w) { return w / part * words + begin + w % part; };
  const std::int32_t count = records * part, step = group.threads();
  for (std::int32_t first = group.thread(); first < count; first += together * step) {
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
template <class Group>
GEM_DEVICE inline void copy_words(const Group& group, void* to, const void* from, std::size_t bytes) {
  copy_parts<1, 0, 1>(group, to, from, static_cast<std::int32_t>(bytes / sizeof(CopyWord)));
}

/// The shared memory is shared out by lines.
constexpr std::size_t workspace_line = 128;
GEM_DEVICE inline std::size_t whole_lines(std::size_t bytes) {
  return (bytes + workspace_line - 1) / workspace_line * workspace_line;
}

/// Shares out the bodies among the threads; everything else stands in the scene's memory.
template <class Group>
GEM_DEVICE inline Workspace share_bodies(const DeviceScene& s, const Group& group) {
  Workspace workspace;
  workspace.bodies = stretch_of(group, s.bodies);
  const int warp = Group::Warp::size;
  const bool alone = group.threads() <= warp;
  workspace.platform = group.block() == 0 && (alone || group.thread() >= group.threads() - warp);
  workspace.body_step = group.block() == 0 && !alone ? group.threads() - warp : group.threads();
  workspace.first_body = workspace.platform && !alone ? workspace.bodies.end : workspace.bodies.begin + group.thread();
  workspace.body = s.body;
  workspace.motion = s.motion;
  workspace.pair = s.pair;
  return workspace;
}

/// Shares out the shared memory and the threads.
template <class Group>
GEM_DEVICE inline Workspace make_workspace(const DeviceScene& s, Group& group) {
  Workspace workspace = share_bodies(s, group);
  // from the start what every time step fills anew, from the end the copies
  const std::size_t candidates = whole_lines(group.threads() * sizeof(CandidatePair)),
                    outlines = whole_lines(group.threads() / Group::Lanes::size * sizeof(WorkspaceOutlines));
  workspace.candidate = reinterpret_cast<CandidatePair*>(group.shared_memory());
  workspace.outlines = reinterpret_cast<WorkspaceOutlines*>(group.shared_memory() + candidates);
  workspace.minimum_bytes = candidates + outlines;
  workspace.bodies_begin = group.shared_bytes() / workspace_line * workspace_line;
  const std::size_t own = workspace.bodies.count(), cells = whole_lines(own * sizeof(BodyCell)),
                    motions = whole_lines(own * sizeof(BodyMotion));
  if (workspace.minimum_bytes + cells + motions <= workspace.bodies_begin) {
    workspace.bodies_begin -= cells + motions;
    workspace.body =
        reinterpret_cast<BodyCell*>(group.shared_memory() + workspace.bodies_begin) - workspace.bodies.begin;
    workspace.motion =
        reinterpret_cast<BodyMotion*>(group.shared_memory() + workspace.bodies_begin + cells) - workspace.bodies.begin;
  }
  workspace.solver_bytes = workspace.bodies_begin;
  return workspace;
}

/// Takes the block's pairs to the workspace, after a list was built or at the start of a call.
template <class Group>
GEM_DEVICE inline void load_pairs(const DeviceScene& s, Group& group, Workspace& workspace) {
  workspace.pairs = stretch_of(group, s.counters->pairs);
  const std::size_t bytes = workspace.pairs.count() * sizeof(PairCell);
  workspace.pair = s.pair;
  workspace.solver_bytes = workspace.bodies_begin;
  if (bytes > workspace.bodies_begin - workspace.minimum_bytes) return;  // both are whole lines
  workspace.solver_bytes -= whole_lines(bytes);
  std::byte* const to = group.shared_memory() + workspace.solver_bytes;
  workspace.pair = reinterpret_cast<PairCell*>(to) - workspace.pairs.begin;
  copy_words(group, to, s.pair + workspace.pairs.begin, bytes);
}

template <class Group>
GEM_DEVICE inline void store_pairs(const DeviceScene& s, Group& group, const Workspace& workspace) {
  if (workspace.pair != s.pair)
    copy_words(group, s.pair + workspace.pairs.begin, workspace.pair + workspace.pairs.begin,
               workspace.pairs.count() * sizeof(PairCell));
}

template <class Group>
GEM_DEVICE inline void load_bodies(const DeviceScene& s, Group& group, const Workspace& workspace) {
  if (workspace.body == s.body) return;
  const std::int32_t first = workspace.bodies.begin;
  copy_words(group, workspace.body + first, s.body + first, workspace.bodies.count() * sizeof(BodyCell));
  copy_words(group, workspace.motion + first, s.motion + first, workspace.bodies.count() * sizeof(BodyMotion));
}

/// Moved bodies are shown at once, so the scene's cells are up to date; what the owner alone reads has to go back.
template <class Group>
GEM_DEVICE inline void store_bodies(const DeviceScene& s, Group& group, const Workspace& workspace) {
  const std::int32_t first = workspace.bodies.begin;
  if (workspace.motion == s.motion) return;
  copy_words(group, s.motion + first, workspace.motion + first, workspace.bodies.count() * sizeof(BodyMotion));
}

}  // namespace gem
