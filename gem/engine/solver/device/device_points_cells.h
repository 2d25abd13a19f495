// Records for the contact points of coupled time steps.
#pragma once

#include <cstdint>

#include "gem/engine/solver/coupled_point.h"
#include "gem/events/friction_memory.h"

namespace gem {

/// The points of a contact, as an entry of a row refers to them.
struct RowPoints {
  std::int32_t first = 0, count = 0;
};

/// What a pair's points carry into the next time step.
struct PairMemory {
  static constexpr std::int32_t never = -2;  // the time step before the first is -1
  std::int32_t step = never;
  std::int32_t unused = 0;
  std::int32_t feature[2] = {-1, -1};
  PointMemory point[2] = {};
};

/// A PairMemory on its way to another list or to the host.
struct CarriedMemory {
  std::int32_t a = 0, b = 0;
  std::int32_t feature[2] = {-1, -1};
  PointMemory point[2] = {};
};

/// Where a contact point finds the data of one of its bodies.
struct alignas(16) PointSide {
  std::int32_t body = 0;
  std::int32_t place = -1;          // index of its record; -1: a fixed body has none
  std::int32_t shared_record = -1;  // index of its record in the shared memory of a block; -1: not there
  std::int32_t motion = -1;         // index of the motion there; with halos: of the entry, then of the halo's motion
};

/// A contact point: its bodies, its pair and its slot in the contact.
struct alignas(16) PointCell {
  PointSide a, b;
  std::int32_t pair = 0, slot = 0;
};

/// Points in the row of a body that its block iterates.
struct TakenPoints {
  std::int32_t first = 0, count = 0;  // `first`: index among the points of the block
};

/// Four numbers that are loaded together.
struct alignas(16) FloatQuad {
  float part[4];
};

/// Two numbers that are loaded together. Three pairs side by side, as neighbouring threads read them, fall on different
/// banks of shared memory.
struct alignas(8) FloatPair {
  float part[2];
};
constexpr int motion_pairs = 3;

/// What a point pushes one body by in a round: impulse x, y; shift x, y; twist, turn.
struct PushRecord {
  FloatPair pair[motion_pairs];
};

/// Half of a PushRecord with the number of the iteration that wrote it. Blocks that do not meet read it until it has
/// the number they wait for. It is written and read as a whole.
struct alignas(16) NumberedHalf {
  float part[3];
  std::uint32_t number;
};
struct NumberedPush {
  NumberedHalf half[2];  // x, y, shift x; shift y, twist, turn
};

/// What a point pushes one body by with its base impulse: impulse x, y; shift x, y; twist, turn. Part 7: solved_work.
struct alignas(64) PushBase {
  double part[8];
};

static_assert(2 * sizeof(NumberedPush) == sizeof(PushBase));

/// The motion of a body under the additions of a round: velocity x, y; shift x, y; spin, turn.
struct AddedMotion {
  FloatPair pair[motion_pairs];
};

/// Where a point reads the motion of one of its bodies in a round and writes its record.
struct alignas(16) LoadedPlace {
  const AddedMotion* motion;
  PushRecord* record;  // null: a fixed body
};

/// Columns of four numbers of a point while a round runs; the last two hold its two LoadedPlace.
constexpr int loaded_columns = 8;
constexpr std::size_t loaded_bytes = loaded_columns * sizeof(FloatQuad);
static_assert(sizeof(LoadedPlace) == sizeof(FloatQuad));

/// Velocity and shift of a body under the base impulses, in the order of PushBase.
struct alignas(64) SolvedMotion {
  double part[8];
};

/// Number of points of a body, valid in time step `step` only.
struct BodyPoints {
  std::int32_t step = -1, count = 0;
};

/// A moving body with points. Its records stand in a row; those of points that have it as B come first.
struct alignas(16) SolverEntry {
  std::int32_t body = 0;
  std::int32_t place = 0;            // index of its first record
  std::int32_t shared_record = -1;   // index of its first record in shared memory; -1: not there
  std::int32_t as_b = 0, count = 0;  // records
  float inverse_mass = 0.0F, inverse_inertia = 0.0F;
  // by id among the moving bodies with points; in a list sorted by row length: index in sorted order
  std::int32_t rank = 0;
};

/// Geometry, base impulses and spare friction of all points, a column for each number, so that neighbouring threads
/// read neighbouring memory.
class PointTable {
 public:
  static constexpr int columns = 18;

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
  GEM_DEVICE GEM_INLINE SpareFriction spare(std::int32_t i) const { return {at(16, i), at(17, i)}; }
  GEM_DEVICE GEM_INLINE void set(std::int32_t i, SpareFriction spare) const {
    at(16, i) = spare.left, at(17, i) = spare.right;
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
