// An island under work on a device: its parts of the scene's memory.
//
// A group of blocks cuts the elimination tree of its island into a trunk (the highest separators) and a branch for each
// block. Branches do not touch each other, so blocks meet only where the trunk begins and ends. A block or a warp has
// one branch and no trunk.
#pragma once

#include "gem/engine/solver/splitting/island_memory.h"
#include "gem/engine/solver/splitting/island_size.h"

namespace gem {

/// What dissection reads of an island. Arrays begin with the island's own part.
struct IslandGraph {
  std::int32_t bodies;
  const Vec2* position;
  const SolverEntry* entry;       // of the scene
  const std::int32_t* member;     // entries of the bodies
  const std::int32_t* neighbour;  // by record of the scene: body of the island, -1: fixed
  std::int32_t *label, *next_label, *home, *order, *next_order, *side;
  IslandNode* node;

  template <class Work>
  GEM_DEVICE GEM_INLINE void each_neighbour(std::int32_t body, Work&& work) const {
    const SolverEntry& e = entry[member[body]];
    for (std::int32_t k = 0; k < e.count; ++k) {
      const std::int32_t other = neighbour[e.place + k];
      if (other >= 0) work(other);
    }
  }
};

/// The trunk or a branch of an elimination tree. Levels are counted from its top.
struct TreePart {
  std::int32_t begin = 0, end = 0;            // bodies of a branch: a range of the order
  std::int32_t first_own = 0, owns = 0;       // bodies, in own_place
  std::int32_t first_node = 0, nodes = 0;     // the top of a branch comes first
  std::int32_t level = 0, levels = 0;         // in IslandMemory::level, which has one more
  std::int32_t first_slot = 0, slots = 0;     // others of its fronts; slots are the scene's
  std::int32_t first_sorted = 0, sorted = 0;  // slots of its bodies in fronts below them
  std::int64_t first_number = 0, numbers = 0;
  std::int32_t overflow = 0;  // its fronts do not fit in the scene's memory
};

/// An island under work. Arrays by body, place, node and point begin with the island's part; numbers, slots and records
/// are the scene's.
struct IslandView {
  std::int32_t bodies = 0, points = 0, contacts = 0;
  IslandGraph graph{};
  IslandMemory m;

  GEM_DEVICE IslandSize size() const { return {bodies, points, contacts}; }

  GEM_DEVICE const IslandNode& node_at(std::int32_t place) const { return m.node[graph.label[m.order[place]]]; }
};

/// What all threads of an island share.
struct IslandCell {
  std::int32_t taken;  // island that the threads took
  std::int32_t bodies, points, contacts;
  std::int32_t base, first_point;
  std::int32_t repairs, overflow, raised, not_finite;
  std::uint64_t asked;  // of all points: 32 bits are too few for a cluster of blocks
  std::uint32_t points_bits, bodies_bits, change_bits, motion_bits;
  double share;
  bool joins_rounds;  // of GradientPlan
  std::int32_t branches;
  TreePart trunk;
  std::int32_t branch[trunk_nodes / 2 + 1];  // node at the top of each branch
};

/// What the threads of a block share, or those of a warp.
struct PartCell {
  std::int32_t nodes;
  TreePart branch, trunk;
  IslandView view;  // written by one thread
};

}  // namespace gem
