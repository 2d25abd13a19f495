// Rows of numbers by body, read and written by eight points at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "gem/base/pack.h"
#include "gem/engine/solver/splitting/split_point.h"

namespace gem {

/// Velocity and repair of a body over its BodyScale: x, y, spin, 0 and the same of the repair.
struct alignas(32) BodyRow {
  FloatPack lanes;
};

/// The half rows of eight bodies, by component.
template <int half>
GEM_INLINE void load_motions(const std::vector<BodyRow>& rows, const std::int32_t* place, FloatPack* motion) {
  const auto at = [&](int k) { return reinterpret_cast<const float*>(&rows[place[k]]) + 4 * half; };
  for (int k = 0; k < 4; ++k) motion[k] = side_by_side(at(k), at(k + 4));
  transpose_halves(motion);
}

/// Pushes of eight points along the Jacobian `n`, `t` of a side, as rows of its bodies: eight whole rows, or without
/// repairs four packs of two half rows.
template <bool repairs>
struct PushRows {
  FloatPack row[repairs ? float_lanes : float_lanes / 2];
};

template <bool repairs>
GEM_INLINE void set_push_rows(const FloatPack* n, const FloatPack* t, PointShare<FloatPack> share,
                              PointShare<FloatPack> repair, PushRows<repairs>& rows) {
  FloatPack push[4];
  for (int c = 0; c < 3; ++c) push[c] = n[c] * share.n + t[c] * share.t;
  push[3] = FloatPack{};
  transpose_halves(push);
  if constexpr (repairs) {
    FloatPack shift[4];
    for (int c = 0; c < 3; ++c) shift[c] = n[c] * repair.n + t[c] * repair.t;
    shift[3] = FloatPack{};
    transpose_halves(shift);
    for (int k = 0; k < 4; ++k) {
      rows.row[k] = __builtin_shufflevector(push[k], shift[k], 0, 1, 2, 3, 8, 9, 10, 11);
      rows.row[k + 4] = __builtin_shufflevector(push[k], shift[k], 4, 5, 6, 7, 12, 13, 14, 15);
    }
  } else {
    for (int k = 0; k < 4; ++k) rows.row[k] = push[k];
  }
}

/// Pushes of eight points on both of their bodies. The points of a body as B come before its points as A, as in the
/// order of the points.
template <bool repairs>
struct BlockPushes {
  PushRows<repairs> b, a;
};

/// What eight points ask of both bodies, in velocities and in repairs.
template <bool repairs, class Block>
GEM_INLINE BlockPushes<repairs> pushes_of(const Block& q, PointShare<FloatPack> share, PointShare<FloatPack> repair) {
  BlockPushes<repairs> pushes;
  set_push_rows<repairs>(q.n_b, q.t_b, share, repair, pushes.b);
  set_push_rows<repairs>(q.n_a, q.t_a, share, repair, pushes.a);
  return pushes;
}

/// Adds pushes to the rows of their bodies, in the order of the points.
template <bool repairs>
GEM_INLINE void add_push_rows(std::vector<BodyRow>& to, const std::int32_t* place, const PushRows<repairs>& rows) {
  for (int k = 0; k < float_lanes; ++k) {
    if constexpr (repairs) {
      to[place[k]].lanes += rows.row[k];
    } else {
      float* const at = reinterpret_cast<float*>(&to[place[k]]);
      FloatHalf part, sum;
      __builtin_memcpy(&part, reinterpret_cast<const float*>(&rows.row[k % 4]) + 4 * (k / 4), sizeof part);
      __builtin_memcpy(&sum, at, sizeof sum);
      sum += part;
      __builtin_memcpy(at, &sum, sizeof sum);
    }
  }
}

/// Adds the pushes of eight points to the rows of both of their bodies.
template <bool repairs>
GEM_INLINE void add_block_pushes(std::vector<BodyRow>& to, const std::int32_t* a, const std::int32_t* b,
                                 const BlockPushes<repairs>& pushes) {
  add_push_rows<repairs>(to, b, pushes.b);
  add_push_rows<repairs>(to, a, pushes.a);
}

/// Adds pushes_of() eight points.
template <bool repairs, class Block>
GEM_INLINE void add_pushes(const Block& q, PointShare<FloatPack> share, PointShare<FloatPack> repair,
                           std::vector<BodyRow>& to) {
  add_block_pushes(to, q.a, q.b, pushes_of<repairs>(q, share, repair));
}

}  // namespace gem
