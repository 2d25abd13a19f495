// A power for inner loops, on numbers and on packs.
#pragma once

#include <cstdint>

#include "gem/base/choose.h"
#include "gem/base/macros.h"
#include "gem/base/pack.h"
#include "gem/base/strict_math.h"

namespace gem::strict {

/// x^p for normal x > 0 and results that are normal, to 2e-9 of the result times 1 + |p|.
template <class Real>
GEM_HD GEM_INLINE Real short_power(Real x, Real p) {
  constexpr double one_and_a_half = 6755399441055744.0;  // 1.5 x 2^52: its last bits count whole numbers
  const auto bits = bits_of(x);
  Real m = double_of((bits & 0x000fffffffffffffULL) | 0x3ff0000000000000ULL);
  Real e = double_of((bits >> 52) | 0x4330000000000000ULL) - (4503599627370496.0 + 1023.0);
  const auto high = m > 1.4142135623730951;
  m = pick(high, 0.5 * m, m);
  e = pick(high, e + 1.0, e);
  const Real z = (m - 1.0) / (m + 1.0), z2 = z * z;
  const Real series = 1.0 + z2 * (1.0 / 3 + z2 * (1.0 / 5 + z2 * (1.0 / 7 + z2 * (1.0 / 9 + z2 * (1.0 / 11)))));
  const Real log2 = p * (e + 2.8853900817779268 * z * series);
  const Real shifted = log2 + one_and_a_half;
  const Real r = 0.6931471805599453 * (log2 - (shifted - one_and_a_half));
  Real sum = 1.0 + r * (1.0 / 8);
  sum = 1.0 + r * (1.0 / 7) * sum;
  sum = 1.0 + r * (1.0 / 6) * sum;
  sum = 1.0 + r * (1.0 / 5) * sum;
  sum = 1.0 + r * (1.0 / 4) * sum;
  sum = 1.0 + r * (1.0 / 3) * sum;
  sum = 1.0 + r * (1.0 / 2) * sum;
  sum = 1.0 + r * sum;
  return sum * double_of((bits_of(shifted) << 52) + 0x3ff0000000000000ULL);
}

}  // namespace gem::strict
