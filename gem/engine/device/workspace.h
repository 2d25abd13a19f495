// The workspace of a block: copies of its bodies and pairs in shared memory, and memory for the outlines that it turns.
#pragma once

#include "gem/engine/device/scene.h"
#include "gem/engine/device/thread_group.h"

namespace gem {

/// The range of [0, count) that belongs to the block.
template <class Group>
GEM_DEVICE inline Stretch stretch_of(const Group& group, std::int32_t count) {
  const std::int64_t all = count;
  return {static_cast<std::int32_t>(all * group.block() / group.blocks()),
          static_cast<std::int32_t>(all * (group.block() + 1) / group.blocks())};
}

/// The two outlines of a pair, in world axes; for one group of lanes.
struct WorkspaceOutlines {
  Vec2 corner[2][workspace_vertices], normal[2][workspace_vertices];
};

/// The workspace of a block, as one thread sees it. Arrays are indexed as those of the scene. Those that do not fit in
/// shared memory are the scene's own.
struct Workspace {
  Stretch bodies{}, pairs{};
  std::int32_t first_body = 0, body_step = 1;  // of the thread; the platform's warp moves no floes
  bool platform = false;                       // the thread belongs to the platform's warp
  bool writes_through = true;                  // moved bodies are also written to the scene at once
  BodyCell* body = nullptr;
  BodyMotion* motion = nullptr;
  PairCell* pair = nullptr;
  CandidatePair* candidate = nullptr;     // one for each thread
  WorkspaceOutlines* outlines = nullptr;  // one for each group of lanes
  // bytes of candidates and outlines; offset of the copied bodies; bytes for the solver, which reuses the candidates
  // and outlines. The terms of the platform reuse the candidates and outlines too.
  std::size_t scratch_bytes = 0, bodies_begin = 0, solver_bytes = 0;
};

/// Least bytes of a workspace.
GEM_HD inline std::size_t workspace_minimum(int threads, int lanes) {
  return static_cast<std::size_t>(threads) * sizeof(CandidatePair) +
         static_cast<std::size_t>(threads / lanes) * sizeof(WorkspaceOutlines) + 256;
}

/// The unit of copying.
struct alignas(16) CopyWord {
  std::uint64_t low, high;
};

/// Copies words begin to end - 1 of some records of `words` words each. Neighbouring threads copy neighbouring memory.
/// Each thread loads several words before it stores them, to hide the latency of memory.
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

static_assert(sizeof(BodyCell) % sizeof(CopyWord) == 0 && sizeof(BodyMotion) % sizeof(CopyWord) == 0 &&
              sizeof(PairCell) % sizeof(CopyWord) == 0);
/// Copies whole records.
template <class Group>
GEM_DEVICE inline void copy_words(const Group& group, void* to, const void* from, std::size_t bytes) {
  copy_parts<1, 0, 1>(group, to, from, static_cast<std::int32_t>(bytes / sizeof(CopyWord)));
}

/// Shared memory is allocated in lines of this size [bytes].
constexpr std::size_t workspace_line = 128;
GEM_DEVICE inline std::size_t whole_lines(std::size_t bytes) {
  return (bytes + workspace_line - 1) / workspace_line * workspace_line;
}

/// Assigns the bodies to the threads. All arrays are the scene's own.
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

/// Assigns the bodies to the threads and lays out the shared memory.
template <class Group>
GEM_DEVICE inline Workspace make_workspace(const DeviceScene& s, Group& group) {
  Workspace workspace = share_bodies(s, group);
  // memory that each time step fills anew begins at the start, copies at the end
  const std::size_t candidates = whole_lines(group.threads() * sizeof(CandidatePair)),
                    outlines = whole_lines(group.threads() / Group::Lanes::size * sizeof(WorkspaceOutlines));
  workspace.candidate = reinterpret_cast<CandidatePair*>(group.shared_memory());
  workspace.outlines = reinterpret_cast<WorkspaceOutlines*>(group.shared_memory() + candidates);
  workspace.scratch_bytes = candidates + outlines;
  workspace.bodies_begin = group.shared_bytes() / workspace_line * workspace_line;
  const std::size_t own = workspace.bodies.count(), cells = whole_lines(own * sizeof(BodyCell)),
                    motions = whole_lines(own * sizeof(BodyMotion));
  if (workspace.scratch_bytes + cells + motions <= workspace.bodies_begin) {
    workspace.bodies_begin -= cells + motions;
    workspace.body =
        reinterpret_cast<BodyCell*>(group.shared_memory() + workspace.bodies_begin) - workspace.bodies.begin;
    workspace.motion =
        reinterpret_cast<BodyMotion*>(group.shared_memory() + workspace.bodies_begin + cells) - workspace.bodies.begin;
  }
  workspace.solver_bytes = workspace.bodies_begin;
  return workspace;
}

/// Copies the pairs of the block to the workspace if they fit, at the start of a call and after a list was built.
template <class Group>
GEM_DEVICE inline void load_pairs(const DeviceScene& s, Group& group, Workspace& workspace) {
  workspace.pairs = stretch_of(group, s.counters->pairs);
  const std::size_t bytes = workspace.pairs.count() * sizeof(PairCell);
  workspace.pair = s.pair;
  workspace.solver_bytes = workspace.bodies_begin;
  if (bytes > workspace.bodies_begin - workspace.scratch_bytes) return;  // both are whole lines
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

/// Writes back what only the owner of a body reads. The scene's cells are up to date, as moved bodies are written to
/// them at once.
template <class Group>
GEM_DEVICE inline void store_bodies(const DeviceScene& s, Group& group, const Workspace& workspace) {
  const std::int32_t first = workspace.bodies.begin;
  if (workspace.motion == s.motion) return;
  copy_words(group, s.motion + first, workspace.motion + first, workspace.bodies.count() * sizeof(BodyMotion));
}

}  // namespace gem
