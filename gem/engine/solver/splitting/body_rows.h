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

/// Adds the pushes of eight points, given by component, to the half rows of their bodies, in the order of the points.
template <int half>
GEM_INLINE void add_pushes(std::vector<BodyRow>& rows, const std::int32_t* place, FloatPack* push) {
  transpose_halves(push);
  for (int k = 0; k < float_lanes; ++k) {
    float* const to = reinterpret_cast<float*>(&rows[place[k]]) + 4 * half;
    FloatHalf part, sum;
    __builtin_memcpy(&part, reinterpret_cast<const float*>(&push[k % 4]) + 4 * (k / 4), sizeof part);
    __builtin_memcpy(&sum, to, sizeof sum);
    sum += part;
    __builtin_memcpy(to, &sum, sizeof sum);
  }
}

/// Adds what eight points ask of both bodies. The points of a body as B come before its points as A, as in the order of
/// the points.
template <int half, class Block>
GEM_INLINE void push_bodies(const Block& q, const std::int32_t* a, const std::int32_t* b, std::vector<BodyRow>& to,
                            PointShare<FloatPack> share) {
  FloatPack push[4];
  for (int c = 0; c < 3; ++c) push[c] = q.n_b[c] * share.n + q.t_b[c] * share.t;
  push[3] = FloatPack{};
  add_pushes<half>(to, b, push);
  for (int c = 0; c < 3; ++c) push[c] = q.n_a[c] * share.n + q.t_a[c] * share.t;
  push[3] = FloatPack{};
  add_pushes<half>(to, a, push);
}

}  // namespace gem
