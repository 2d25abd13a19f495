// Eight floats with the same arithmetic, side by side.
//
// A function template written for `Real` runs on one number and on a pack. Every operation is IEEE and lane by lane, so
// the bits are the same.
#pragma once

#include <cstdint>

#include "gem/base/choose.h"

namespace gem {

// every function on packs is inlined, since the calling convention of packs depends on the processor
#pragma GCC diagnostic ignored "-Wpsabi"

constexpr int float_lanes = 8;
typedef float FloatPack __attribute__((vector_size(32)));
typedef std::int32_t FloatMask __attribute__((vector_size(32)));

GEM_INLINE FloatPack pick(FloatMask mask, FloatPack a, FloatPack b) { return mask ? a : b; }
GEM_INLINE FloatPack larger(FloatPack a, FloatPack b) { return a > b ? a : b; }
GEM_INLINE FloatPack smaller(FloatPack a, FloatPack b) { return a < b ? a : b; }
GEM_INLINE FloatPack magnitude(FloatPack a) { return a < 0.0F ? -a : a; }

typedef float FloatHalf __attribute__((vector_size(16)));
typedef float FloatWide __attribute__((vector_size(64)));  // for processors with AVX-512, see GEM_WIDE

/// Whether the processor has AVX-512, which functions marked GEM_WIDE need.
inline bool has_wide_packs() {
  static const bool has = __builtin_cpu_supports("avx512f") != 0;
  return has;
}

/// Four floats from one address and four from another.
GEM_INLINE FloatPack side_by_side(const float* left, const float* right) {
  FloatHalf l, r;
  __builtin_memcpy(&l, left, sizeof l);
  __builtin_memcpy(&r, right, sizeof r);
  return __builtin_shufflevector(l, r, 0, 1, 2, 3, 4, 5, 6, 7);
}

/// Transposes four rows of four into four columns, in both halves.
GEM_INLINE void transpose_halves(FloatPack* r) {
  const FloatPack a = __builtin_shufflevector(r[0], r[1], 0, 8, 1, 9, 4, 12, 5, 13);
  const FloatPack b = __builtin_shufflevector(r[0], r[1], 2, 10, 3, 11, 6, 14, 7, 15);
  const FloatPack c = __builtin_shufflevector(r[2], r[3], 0, 8, 1, 9, 4, 12, 5, 13);
  const FloatPack d = __builtin_shufflevector(r[2], r[3], 2, 10, 3, 11, 6, 14, 7, 15);
  r[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
  r[1] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
  r[2] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
  r[3] = __builtin_shufflevector(b, d, 2, 3, 10, 11, 6, 7, 14, 15);
}

}  // namespace gem
