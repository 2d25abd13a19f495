// The points of a round: two in the registers of each thread, the rest in memory, four numbers at a time so that
// neighbouring threads read neighbouring memory.
#pragma once

#include "gem/engine/coupled_visit.h"
#include "gem/engine/device_points.h"

namespace gem {

/// Columns of four numbers that a point takes.
constexpr int held_columns = 6;

/// A point while a round runs.
struct HeldPoint {
  PointFrame<float> frame;
  PointImpulse<float> at, carried;
  HeldPlace a, b;
};

/// Points in memory. What a visit changes stands in the first two columns.
class HeldTable {
 public:
  GEM_DEVICE GEM_INLINE explicit HeldTable(const DeviceScene& s)
      : quad_(s.held_quad), place_(s.held_place), capacity_(s.points_capacity) {}

  GEM_DEVICE GEM_INLINE HeldPoint load(std::int32_t i) const {
    const FloatQuad d = quad(2, i), e = quad(3, i), f = quad(4, i), g = quad(5, i);
    HeldPoint held;
    load_additions(i, held);
    held.frame.normal_x = d.part[0], held.frame.normal_y = d.part[1];
    held.frame.lever_a_n = d.part[2], held.frame.lever_a_t = d.part[3];
    held.frame.lever_b_n = e.part[0], held.frame.lever_b_t = e.part[1];
    held.frame.inverse_nn = e.part[2], held.frame.inverse_tt = e.part[3];
    held.frame.excess = f.part[0], held.frame.slip = f.part[1];
    held.frame.least = f.part[2], held.frame.most = f.part[3];
    held.frame.room_left = g.part[0], held.frame.room_right = g.part[1];
    held.frame.repair_excess = g.part[2], held.frame.repair_least = g.part[3];
    held.a = place_[i];
    held.b = place_[capacity_ + i];
    return held;
  }
  GEM_DEVICE GEM_INLINE void save(std::int32_t i, const HeldPoint& held) const {
    const PointFrame<float>& f = held.frame;
    save_additions(i, held);
    quad(2, i) = {{f.normal_x, f.normal_y, f.lever_a_n, f.lever_a_t}};
    quad(3, i) = {{f.lever_b_n, f.lever_b_t, f.inverse_nn, f.inverse_tt}};
    quad(4, i) = {{f.excess, f.slip, f.least, f.most}};
    quad(5, i) = {{f.room_left, f.room_right, f.repair_excess, f.repair_least}};
    place_[i] = held.a;
    place_[capacity_ + i] = held.b;
  }

  GEM_DEVICE GEM_INLINE void load_additions(std::int32_t i, HeldPoint& held) const {
    const FloatQuad b = quad(0, i), c = quad(1, i);
    held.at = {b.part[0], b.part[1], b.part[2]};
    held.carried = {b.part[3], c.part[0], c.part[1]};
    held.frame.nt = c.part[2];
    held.frame.friction = c.part[3];
  }
  GEM_DEVICE GEM_INLINE void save_additions(std::int32_t i, const HeldPoint& held) const {
    quad(0, i) = {{held.at.normal, held.at.tangential, held.at.repair, held.carried.normal}};
    quad(1, i) = {{held.carried.tangential, held.carried.repair, held.frame.nt, held.frame.friction}};
  }

 private:
  GEM_DEVICE GEM_INLINE FloatQuad& quad(int column, std::int32_t i) const {
    return quad_[static_cast<std::int64_t>(column) * capacity_ + i];
  }

  FloatQuad* quad_;
  HeldPlace* place_;  // of A, then of B
  std::int64_t capacity_;
};

}  // namespace gem
