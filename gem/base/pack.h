// Eight floats that go through the same arithmetic side by side.
//
// A function written for `Real` runs on one number and on a pack: every operation is IEEE and done lane by lane, so the
// bits are the same.
#pragma once

#include <cstdint>

#include "gem/base/choose.h"

namespace gem {

// every function on packs is inlined: none is passed by a convention that depends on the processor
#pragma GCC diagnostic ignored "-Wpsabi"

constexpr int float_lanes = 8;
typedef float FloatPack __attribute__((vector_size(32)));
typedef std::int32_t FloatMask __attribute__((vector_size(32)));

GEM_INLINE FloatPack pick(FloatMask mask, FloatPack a, FloatPack b) { return mask ? a : b; }
GEM_INLINE FloatPack larger(FloatPack a, FloatPack b) { return a > b ? a : b; }
GEM_INLINE FloatPack smaller(FloatPack a, FloatPack b) { return a < b ? a : b; }
GEM_INLINE FloatPack magnitude(FloatPack a) { return a < 0.0F ? -a : a; }

}  // namespace gem
