// An island under work on a device: its parts of the scene's memory.
#pragma once

#include "gem/engine/solver/splitting/island_memory.h"

namespace gem {

/// What dissection reads of an island. Arrays begin with the island's own part.
struct IslandGraph {
  std::int32_t bodies;
  const Vec2* position;
  const SolverEntry* entry;       // of the scene
  const std::int32_t* member;     // entries of the bodies
  const std::int32_t* neighbour;  // by record of the scene: body of the island, -1: fixed
  std::int32_t *label, *next_label, *order, *next_order, *side;
  IslandNode* node;
  std::int32_t* level;

  template <class Work>
  GEM_DEVICE GEM_INLINE void each_neighbour(std::int32_t body, Work&& work) const {
    const SolverEntry& e = entry[member[body]];
    for (std::int32_t k = 0; k < e.count; ++k) {
      const std::int32_t other = neighbour[e.place + k];
      if (other >= 0) work(other);
    }
  }
};

/// An island under work: its parts of the scene's memory. Node, slot and place arrays begin with the island's own part;
/// numbers and records are the scene's.
struct IslandView {
  std::int32_t bodies = 0, points = 0, nodes = 0, levels = 0, slots = 0;
  IslandGraph graph{};
  IslandMemory m;  // arrays by body, place, node, slot and point begin with the island's part

  GEM_DEVICE std::int32_t first_node(std::int32_t level) const { return graph.level[level]; }
  GEM_DEVICE std::int32_t first_slot(std::int32_t level) const {
    return level < levels ? m.node[graph.level[level]].first_other : slots;
  }
  GEM_DEVICE std::int32_t first_own(std::int32_t level) const {
    return level < levels ? m.node[graph.level[level]].first_own : bodies;
  }
  GEM_DEVICE const IslandNode& node_at(std::int32_t place) const { return m.node[graph.label[m.order[place]]]; }
};

/// What the threads of an island share.
struct IslandCell {
  std::int32_t taken;  // island that the threads took
  std::int32_t bodies, points, nodes;
  std::int32_t base, first_point;
  std::int32_t first_slot, slots;
  std::uint64_t first_number, numbers;
  std::int32_t repairs, overflow, iterates, asked, raised, not_finite;
  std::uint32_t points_bits, bodies_bits, change_bits, motion_bits;
  double share;
  IslandView view;  // written by one thread
};

}  // namespace gem
