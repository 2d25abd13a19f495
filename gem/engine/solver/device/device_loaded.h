// Memory of the points of a round. Some points are in registers, others in shared memory as far as they fit, the rest
// in the scene's memory. A point is stored in columns of four numbers, so that neighbouring threads read neighbouring
// memory.
#pragma once

#include "gem/engine/solver/coupled_visit.h"
#include "gem/engine/solver/device/device_solver_list.h"

namespace gem {

/// A point while a round runs.
struct LoadedPoint {
  PointFrame<float> frame;
  PointImpulse<float> added, extrapolated;
  LoadedPlace a, b;
};

/// A point in memory. A visit changes only the first two columns.
class LoadedCell {
 public:
  GEM_DEVICE GEM_INLINE LoadedCell(FloatQuad* quads, std::int32_t columns_apart)
      : quad_(quads), apart_(columns_apart) {}

  GEM_DEVICE GEM_INLINE LoadedPoint load() const {
    const FloatQuad d = quad(2), e = quad(3), f = quad(4), g = quad(5);
    LoadedPoint loaded;
    load_additions(loaded);
    loaded.frame.normal_x = d.part[0], loaded.frame.normal_y = d.part[1];
    loaded.frame.lever_a_n = d.part[2], loaded.frame.lever_a_t = d.part[3];
    loaded.frame.lever_b_n = e.part[0], loaded.frame.lever_b_t = e.part[1];
    loaded.frame.inverse_nn = e.part[2], loaded.frame.inverse_tt = e.part[3];
    loaded.frame.excess = f.part[0], loaded.frame.slip = f.part[1];
    loaded.frame.least = f.part[2], loaded.frame.most = f.part[3];
    loaded.frame.slack_left = g.part[0], loaded.frame.slack_right = g.part[1];
    loaded.frame.repair_excess = g.part[2], loaded.frame.repair_least = g.part[3];
    loaded.a = place(6);
    loaded.b = place(7);
    return loaded;
  }
  GEM_DEVICE GEM_INLINE void save_numbers(const LoadedPoint& loaded) const {
    const PointFrame<float>& f = loaded.frame;
    save_additions(loaded);
    quad(2) = {{f.normal_x, f.normal_y, f.lever_a_n, f.lever_a_t}};
    quad(3) = {{f.lever_b_n, f.lever_b_t, f.inverse_nn, f.inverse_tt}};
    quad(4) = {{f.excess, f.slip, f.least, f.most}};
    quad(5) = {{f.slack_left, f.slack_right, f.repair_excess, f.repair_least}};
  }

  GEM_DEVICE GEM_INLINE void load_additions(LoadedPoint& loaded) const {
    const FloatQuad b = quad(0), c = quad(1);
    loaded.added = {b.part[0], b.part[1], b.part[2]};
    loaded.extrapolated = {b.part[3], c.part[0], c.part[1]};
    loaded.frame.nt = c.part[2];
    loaded.frame.friction = c.part[3];
  }
  GEM_DEVICE GEM_INLINE void save_additions(const LoadedPoint& loaded) const {
    quad(0) = {{loaded.added.normal, loaded.added.tangential, loaded.added.repair, loaded.extrapolated.normal}};
    quad(1) = {{loaded.extrapolated.tangential, loaded.extrapolated.repair, loaded.frame.nt, loaded.frame.friction}};
  }

  GEM_DEVICE GEM_INLINE void set_places(const LoadedPlace& a, const LoadedPlace& b) const {
    place(6) = a;
    place(7) = b;
  }
  /// Copies everything from another cell but the places of its bodies.
  GEM_DEVICE GEM_INLINE void copy_numbers(const LoadedCell& from) const {
    constexpr int columns = loaded_columns - 2;
    FloatQuad some[columns];
    for (int column = 0; column < columns; ++column) some[column] = from.quad(column);
    for (int column = 0; column < columns; ++column) quad(column) = some[column];
  }
  /// Copies what a visit changes.
  GEM_DEVICE GEM_INLINE void copy_additions(const LoadedCell& from) const {
    quad(0) = from.quad(0);
    quad(1) = from.quad(1);
  }

 private:
  GEM_DEVICE GEM_INLINE FloatQuad& quad(int column) const { return quad_[static_cast<std::int64_t>(column) * apart_]; }

  GEM_DEVICE GEM_INLINE LoadedPlace& place(int column) const { return reinterpret_cast<LoadedPlace&>(quad(column)); }

  FloatQuad* quad_;
  std::int32_t apart_;
};

/// The points of one block. `shared_memory`: the start of the block's shared memory.
class LoadedTable {
 public:
  GEM_DEVICE GEM_INLINE LoadedTable(const DeviceScene& s, std::byte* shared_memory, const SolverWorkspace& workspace)
      : shared_(reinterpret_cast<FloatQuad*>(shared_memory + workspace.shared_points_offset) -
                workspace.shared_points.begin),
        global_(s.loaded),
        shared_begin_(workspace.shared_points.begin),
        shared_end_(workspace.shared_points.end),
        capacity_(s.points_capacity) {}

  GEM_DEVICE GEM_INLINE LoadedCell operator[](std::int32_t i) const {
    return is_in_shared(i) ? in_shared(i) : in_global(i);
  }
  GEM_DEVICE GEM_INLINE bool is_in_shared(std::int32_t i) const { return i >= shared_begin_ && i < shared_end_; }
  /// Point i in shared memory; requires is_in_shared(i).
  GEM_DEVICE GEM_INLINE LoadedCell in_shared(std::int32_t i) const {
    return {shared_ + i, shared_end_ - shared_begin_};
  }
  /// Point i in the scene's memory, where it stays between rounds.
  GEM_DEVICE GEM_INLINE LoadedCell in_global(std::int32_t i) const { return {global_ + i, capacity_}; }

 private:
  FloatQuad *shared_, *global_;
  std::int32_t shared_begin_, shared_end_, capacity_;
};

}  // namespace gem
