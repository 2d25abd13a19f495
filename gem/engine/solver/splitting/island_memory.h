// The memory of operator splitting on a device: plain arrays of one scene. Islands take consecutive parts of them.
#pragma once

#include <cstdint>

#include "gem/base/vec2.h"
#include "gem/engine/solver/device_points_cells.h"
#include "gem/engine/solver/splitting/split_point.h"

namespace gem {

/// Classes of islands by size: island of class k has at least 2^k records.
constexpr std::int32_t island_classes = 31;

/// Counts of a time step; zero before it.
struct IslandCounters {
  std::int32_t bodies;  // moving ones with points
  std::int32_t islands, large, not_small;
  std::int32_t of_class[island_classes], placed[island_classes];
  std::int32_t next_large, next_block, next_small;      // islands that were taken
  std::int32_t body_slots, point_slots, drafts, slots;  // in use
  std::int32_t solved;
  std::uint32_t iterations;  // the most of all islands
  std::uint64_t numbers;     // of factors, in use
  std::uint64_t error_bits;  // of the largest error of all islands
};

/// A point in its island.
struct IslandPointPlace {
  std::int32_t taken = 0;       // its index in the scene's lists
  std::int32_t a = -1, b = -1;  // places of its bodies in the order of elimination; -1: fixed
  std::int32_t record_a = -1, record_b = -1;
  // block of its pair in the matrix: its place in the numbers, and rows from column to column; -1: none, or the block
  // belongs to the first point of the contact
  std::int32_t row_length = -1;
  std::int64_t block = -1;
  std::int32_t second = -1;  // second point of the contact, as a point of the island
};

/// A part of an island during dissection: later a leaf or a separator, with its front.
struct IslandNode {
  std::int32_t begin = 0, end = 0;       // the part: a range of the order
  std::int32_t own = 0;                  // first of its own bodies, which end with the part
  std::int32_t parent = -1, child = -1;  // the first of two; -1: none
  std::int32_t depth = 0;
  std::int32_t draft = 0;                    // its others, while they are found
  std::int32_t first_other = 0, others = 0;  // slots
  std::int32_t first_own = 0;                // in own_place
  std::int64_t numbers = 0;                  // of its front

  GEM_HD std::int32_t own_rows() const { return 3 * (end - own); }
  GEM_HD std::int32_t other_rows() const { return 3 * others; }
  GEM_HD std::int64_t back() const { return numbers; }  // G: first the own block
  GEM_HD std::int64_t joined() const { return back() + std::int64_t{own_rows()} * (own_rows() + other_rows()); }  // C
  GEM_HD std::int64_t forth() const { return joined() + std::int64_t{own_rows()} * other_rows(); }                // H
  GEM_HD std::int64_t complement() const { return forth() + std::int64_t{own_rows()} * other_rows(); }
  GEM_HD std::int64_t end_of_numbers() const { return complement() + std::int64_t{other_rows()} * other_rows(); }
};

struct IslandCell;
/// Groups of blocks that solve the large islands of a scene, at most.
constexpr int most_island_groups = 8;

struct IslandMemory {
  IslandCounters* counters = nullptr;
  IslandCell* cell = nullptr;  // of each group of blocks
  // by rank of the body (SolverEntry::rank)
  std::int32_t *joined = nullptr, *root = nullptr, *weight = nullptr, *entry = nullptr, *index = nullptr;
  std::int32_t* rank = nullptr;    // by body
  std::int32_t* island = nullptr;  // roots, large islands first
  // by body of an island
  std::int32_t *member = nullptr, *place = nullptr, *label = nullptr, *next_label = nullptr;
  Vec2* position = nullptr;
  // by place in the order of elimination
  std::int32_t *order = nullptr, *next_order = nullptr, *side = nullptr, *own_place = nullptr;
  std::int32_t *parts_in = nullptr, *first_in = nullptr, *filled_in = nullptr;  // slots of a body in fronts below it
  ScaledBody* scaled = nullptr;
  FloatQuad *now = nullptr, *sum = nullptr, *solution = nullptr, *given = nullptr, *last_given = nullptr;  // two each
  FloatQuad *pivot = nullptr, *share = nullptr;
  // twice as many as bodies
  IslandNode* node = nullptr;
  std::int32_t* level = nullptr;
  // by record
  std::int32_t *taken_of_record = nullptr, *point_of = nullptr, *neighbour = nullptr;
  FloatQuad* push = nullptr;  // two each
  // by point
  IslandPointPlace* where = nullptr;
  SplitPoint<float>* point = nullptr;
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
