// What the contact points of a coupled time step are made of.
#pragma once

#include <cstdint>

#include "gem/engine/solver/coupled_point.h"

namespace gem {

/// Coupled: the points of a contact, as a place of a row sees them.
struct RowPoints {
  std::int32_t first = 0, count = 0;
};

/// Coupled: what the points of a pair carried at the end of a time step.
struct PairMemory {
  static constexpr std::int32_t never = -2;  // the time step before the first is -1
  std::int32_t step = never;
  std::int32_t unused = 0;
  std::int32_t feature[2] = {-1, -1};
  PointImpulse<double> impulse[2] = {};
};

/// The same on its way to another list or to the host.
struct CarriedMemory {
  std::int32_t a = 0, b = 0;
  std::int32_t feature[2] = {-1, -1};
  PointImpulse<double> impulse[2] = {};
};

/// Coupled: where a contact point finds one of its bodies.
struct alignas(16) PointSide {
  std::int32_t body = 0;
  std::int32_t place = -1;          // its place among the records of the body; -1: a fixed body has none
  std::int32_t shared_memory = -1;  // the same in the shared memory of a block; -1: it does not stand there
  std::int32_t motion = -1;         // and where the motion of the body stands there; or its entry, see device_halo.h
};

/// Coupled: where a contact point belongs.
struct alignas(16) PointCell {
  PointSide a, b;
  std::int32_t pair = 0, slot = 0;
};

/// Points that the block of a body takes from its row.
struct TakenPoints {
  std::int32_t first = 0, count = 0;  // the first among those of the block
};

/// Numbers that are fetched together.
struct alignas(16) FloatQuad {
  float part[4];
};

/// The same; three of them side by side, as many neighbouring threads read, fall on different banks of shared memory.
struct alignas(8) FloatPair {
  float part[2];
};
constexpr int motion_pairs = 3;

/// What a point gives to one body in a round: x, y; shift x, y; twist, turn.
struct PushRecord {
  FloatPair pair[motion_pairs];
};

/// Half of such a record with the number of the iteration that wrote it: blocks that do not wait for each other read it
/// until the number is that of theirs. It is written and read whole.
struct alignas(16) NumberedHalf {
  float part[3];
  std::uint32_t number;
};
struct NumberedPush {
  NumberedHalf half[2];  // x, y, shift x; shift y, twist, turn
};

/// The same by the base's impulses; part 7 as device_settle.h says.
struct alignas(64) PushBase {
  double part[8];
};

static_assert(2 * sizeof(NumberedPush) == sizeof(PushBase));

/// What the additions of a round move a body by: x, y; shift x, y; spin, turn.
struct AddedMotion {
  FloatPair pair[motion_pairs];
};

/// Where a point finds one of its bodies in a round.
struct alignas(16) LoadedPlace {
  const AddedMotion* motion;
  PushRecord* record;  // null: a fixed body
};

/// What a point is made of while a round runs: columns of four numbers, the last two those of its places.
constexpr int loaded_columns = 8;
constexpr std::size_t loaded_bytes = loaded_columns * sizeof(FloatQuad);
static_assert(sizeof(LoadedPlace) == sizeof(FloatQuad));

/// Velocities and shifts of a body under the base's impulses, in the order of PushBase.
struct alignas(64) SolvedMotion {
  double part[8];
};

/// Points of a body, good for one time step.
struct BodyPoints {
  std::int32_t step = -1, count = 0;
};

/// A moving body with points; its records stand in a row, those of the points that have it as B first.
struct alignas(16) SolverEntry {
  std::int32_t body = 0;
  std::int32_t place = 0;            // of its first record
  std::int32_t shared_memory = -1;   // the same in the block's shared memory; -1: it does not stand there
  std::int32_t as_b = 0, count = 0;  // records
  float inverse_mass = 0.0F, inverse_inertia = 0.0F;
  std::int32_t rank =
      0;  // among those bodies, by id; in a list in the order of its rows: place among them, by sorted place
};

/// Coupled: geometry of all points and what the base has of them, number by number so that neighbouring threads read
/// neighbouring memory.
class PointTable {
 public:
  static constexpr int columns = 16;

  PointTable() = default;
  PointTable(double* data, std::int32_t capacity) : data_(data), capacity_(capacity) {}

  GEM_DEVICE GEM_INLINE PointGeometry<double> geometry(std::int32_t i) const {
    return {at(0, i), at(1, i), at(2, i), at(3, i),  at(4, i),  at(5, i), at(6, i),
            at(7, i), at(8, i), at(9, i), at(10, i), at(11, i), at(12, i)};
  }
  GEM_DEVICE GEM_INLINE PointImpulse<double> impulse(std::int32_t i) const { return {at(13, i), at(14, i), at(15, i)}; }
  GEM_DEVICE GEM_INLINE void set(std::int32_t i, const PointGeometry<double>& g) const {
    at(0, i) = g.normal_x, at(1, i) = g.normal_y;
    at(2, i) = g.lever_a_n, at(3, i) = g.lever_a_t, at(4, i) = g.lever_b_n, at(5, i) = g.lever_b_t;
    at(6, i) = g.nn, at(7, i) = g.tt, at(8, i) = g.nt;
    at(9, i) = g.target, at(10, i) = g.friction, at(11, i) = g.cap, at(12, i) = g.repair_target;
  }
  GEM_DEVICE GEM_INLINE void set(std::int32_t i, const PointImpulse<double>& p) const {
    at(13, i) = p.normal, at(14, i) = p.tangential, at(15, i) = p.repair;
  }

 private:
  GEM_DEVICE GEM_INLINE double& at(int column, std::int32_t i) const {
    return data_[static_cast<std::int64_t>(column) * capacity_ + i];
  }

  double* data_ = nullptr;
  std::int64_t capacity_ = 0;
};

}  // namespace gem
