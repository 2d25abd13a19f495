// The memory of operator splitting on a device: plain arrays of one scene. Islands take consecutive parts of them.
#pragma once

#include <cstdint>

#include "gem/base/vec2.h"
#include "gem/engine/solver/device/device_points_cells.h"
#include "gem/engine/solver/splitting/split_point.h"

namespace gem {

/// Classes of islands by size: island of class k has at least 2^k records.
constexpr std::int32_t island_classes = 31;

/// Counts of a time step; zero before it.
struct IslandCounters {
  std::int32_t bodies;  // moving ones with points
  std::int32_t islands, large, not_small;
  std::int32_t of_class[island_classes], placed[island_classes];
  std::int32_t next_large, next_block, next_small;              // islands that were taken
  std::int32_t body_slots, point_slots, drafts, slots, sorted;  // in use
  std::uint32_t iterations;                                     // the most of all islands
  std::uint64_t numbers;                                        // of factors, in use
  std::uint64_t error_bits;                                     // of the largest error of all islands
};

/// A point in its island, as the iterations read it: the places of its bodies in the order of elimination, and its
/// records there. -1: fixed.
struct alignas(16) IslandPointEnds {
  std::int32_t a = -1, b = -1;
  std::int32_t record_a = -1, record_b = -1;
};

/// The same for what is done once a round.
struct IslandPointPlace {
  std::int32_t taken = 0;  // its index in the scene's lists
  // block of its pair of bodies in the matrix: its place in the numbers, and rows from column to column; -1: none, or
  // another point of the pair comes first
  std::int32_t row_length = -1;
  std::int64_t block = -1;
  std::int32_t next = -1;  // next point of the pair, as a point of the island
};

/// The records of a body; the first `as_b` of them have it as their B.
struct alignas(16) BodyRecords {
  std::int32_t first = 0, count = 0, as_b = 0, unused = 0;
};

/// A part of an island during dissection: later a leaf or a separator, with its front.
struct IslandNode {
  std::int32_t begin = 0, end = 0;  // the part: a range of the order
  std::int32_t own = 0;             // first of its own bodies, which end with the part
  std::int32_t parent = -1, child[2] = {-1, -1};
  std::int32_t depth = 0;
  std::int32_t draft = 0;                    // its others, while they are found
  std::int32_t first_other = 0, others = 0;  // slots
  std::int32_t first_own = 0;                // in own_place
  std::int32_t forth_tile = 0, back_tile = 0;
  std::int64_t numbers = 0;  // of its front

  GEM_HD std::int32_t owns() const { return end - own; }
  GEM_HD std::int32_t own_rows() const { return 3 * owns(); }
  GEM_HD std::int32_t other_rows() const { return 3 * others; }
  GEM_HD std::int64_t own_block() const { return numbers; }  // A, later its inverse
  GEM_HD std::int64_t joined() const { return own_block() + std::int64_t{own_rows()} * own_rows(); }  // C
  GEM_HD std::int64_t forth() const { return joined() + std::int64_t{own_rows()} * other_rows(); }    // H
  GEM_HD std::int64_t complement() const { return forth() + std::int64_t{own_rows()} * other_rows(); }
  GEM_HD std::int64_t tiles() const { return complement() + std::int64_t{other_rows()} * other_rows(); }
};

/// The first node, own place and tiles of a level of a tree.
struct alignas(16) IslandLevel {
  std::int32_t node = 0, own = 0, forth_tile = 0, back_tile = 0;
};

/// Rows of G or H that the threads of a warp multiply together, each body's three rows by `lanes` neighbours. Each
/// thread has 18 numbers: number e stands at `numbers` + e * (size of a warp) + thread. For more columns than the lanes
/// can take in one pass, further 18 follow.
struct alignas(16) SolveTile {
  std::int64_t numbers = 0;
  std::int32_t first = 0, rows = 0;  // bodies: slots (H) or places (G)
  std::int32_t lanes = 0;
  std::int32_t own = 0, owns = 0;            // columns: own bodies of the front, by place
  std::int32_t first_other = 0, others = 0;  // and its others, by slot; none in H
  std::int32_t shift = 0;                    // lanes are 2 to this power
};

struct IslandCell;
/// Groups of blocks that solve the large islands of a scene, at most.
constexpr int most_island_groups = 8;

/// Nodes and levels of the trunk of a large island, at most: a branch for each block of a cluster of 16.
constexpr int trunk_nodes = 32, trunk_levels = 8;
/// Lower bound of IslandMemory::large_island.
constexpr int least_large_island = 128;

struct IslandMemory {
  IslandCounters* counters = nullptr;
  IslandCell* cell = nullptr;  // of each group of blocks
  // by rank of the body (SolverEntry::rank)
  std::int32_t *joined = nullptr, *root = nullptr, *weight = nullptr, *entry = nullptr, *index = nullptr;
  std::int32_t* rank = nullptr;    // by body
  std::int32_t* island = nullptr;  // roots, large islands first
  // by body of an island
  std::int32_t *member = nullptr, *place = nullptr, *label = nullptr, *next_label = nullptr;
  std::int32_t* home = nullptr;  // its branch; -1: the trunk
  Vec2* position = nullptr;
  // by place in the order of elimination
  std::int32_t *order = nullptr, *next_order = nullptr, *side = nullptr, *own_place = nullptr;
  BodyRecords* records = nullptr;
  std::int32_t *parts_in = nullptr, *first_in = nullptr, *filled_in = nullptr;  // slots of a body in fronts below it
  ScaledBody* scaled = nullptr;
  FloatQuad *now = nullptr, *sum = nullptr, *solution = nullptr, *given = nullptr;  // two each
  float *pivot = nullptr, *share = nullptr;                                         // three for each
  // twice as many as bodies, then those of trunks
  IslandNode* node = nullptr;
  IslandLevel* level = nullptr;
  std::int32_t bodies_capacity = 0;
  SolveTile *forth_tile = nullptr, *back_tile = nullptr;  // by slot, by place
  // by record
  std::int32_t *taken_of_record = nullptr, *point_of = nullptr, *neighbour = nullptr;
  FloatQuad* push = nullptr;  // two each
  // by point
  IslandPointEnds* ends = nullptr;
  IslandPointPlace* where = nullptr;
  float *point = nullptr, *gradient_point = nullptr;  // fields of SplitPoint and GradientPoint, each for all points
  std::int64_t points_capacity = 0;
  // by slot: an other body of a front
  std::int32_t *draft = nullptr, *other = nullptr, *front = nullptr, *row_above = nullptr;
  std::int32_t *unsorted = nullptr, *sorted = nullptr;
  FloatQuad* product = nullptr;  // two each
  float* numbers = nullptr;
  std::int32_t slots_capacity = 0;
  /// Islands with fewer records than `small_island` are solved by a warp each, those with `large_island` and more by a
  /// group of blocks each, the others by a block each. Powers of two.
  std::int32_t small_island = 64, large_island = 2048;
  std::uint64_t numbers_capacity = 0;
};

}  // namespace gem
