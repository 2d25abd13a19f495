// Eight floats, or four doubles, with the same arithmetic, side by side.
//
// A function template written for `Real` runs on one number and on a pack. Every operation is IEEE and lane by lane, so
// the bits are the same.
#pragma once

#include <cstddef>
#include <cstdint>

#include "gem/base/choose.h"

namespace gem {

// every function on packs is inlined, since the calling convention of packs depends on the processor
#pragma GCC diagnostic ignored "-Wpsabi"

constexpr int float_lanes = 8, double_lanes = 4;
typedef float FloatPack __attribute__((vector_size(32)));
typedef std::int32_t FloatMask __attribute__((vector_size(32)));

typedef float FloatHalf __attribute__((vector_size(16)));
typedef double DoublePack __attribute__((vector_size(32)));
typedef float FloatWide __attribute__((vector_size(64)));  // for processors with AVX-512, see GEM_WIDE

template <class Mask, class Pack>
GEM_INLINE Pack pick(Mask mask, Pack a, Pack b) {
  return mask ? a : b;
}
template <class Pack>
GEM_INLINE Pack larger(Pack a, Pack b) {
  return a > b ? a : b;
}
template <class Pack>
GEM_INLINE Pack smaller(Pack a, Pack b) {
  return a < b ? a : b;
}
template <class Pack>
GEM_INLINE Pack magnitude(Pack a) {
  return a < 0 ? -a : a;
}
template <class Mask>
GEM_INLINE Mask both(Mask a, Mask b) {
  return a & b;
}
template <class Mask>
GEM_INLINE Mask but_not(Mask a, Mask b) {
  return a & ~b;
}
template <class Mask>
GEM_INLINE bool any(Mask mask) {
  std::int64_t bits = 0;
  for (std::size_t l = 0; l < sizeof mask / sizeof mask[0]; ++l) bits |= mask[l];
  return bits != 0;
}

namespace strict {
typedef std::uint64_t DoubleBits __attribute__((vector_size(32)));
GEM_INLINE DoubleBits bits_of(DoublePack x) { return (DoubleBits)x; }
GEM_INLINE DoublePack double_of(DoubleBits bits) { return (DoublePack)bits; }
}  // namespace strict

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

/// Transposes four rows of four.
GEM_INLINE void transpose(DoublePack* r) {
  for (int k = 0; k < 4; k += 2) {
    const DoublePack a = r[k], b = r[k + 1];
    r[k] = __builtin_shufflevector(a, b, 0, 4, 2, 6);
    r[k + 1] = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  }
  for (int k = 0; k < 2; ++k) {
    const DoublePack a = r[k], b = r[k + 2];
    r[k] = __builtin_shufflevector(a, b, 0, 1, 4, 5);
    r[k + 2] = __builtin_shufflevector(a, b, 2, 3, 6, 7);
  }
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
