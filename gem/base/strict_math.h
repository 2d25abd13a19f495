// Logarithm, exponential and power from + - * / alone: the same bits on every compiler, processor and accelerator.
//
// The library functions of two platforms round differently; these do not, because contraction is off and every
// operation used is exact IEEE arithmetic. Relative error below 4e-16 (log1p), 1e-15 (power) on their ranges.
#pragma once

#include <cstdint>
#include <cstring>

#include "gem/base/macros.h"

namespace gem {
namespace strict {

constexpr double ln2_high =
    6.93147180369123816490e-01;  // ln 2 with 33 trailing zero bits, so that n * ln2_high is exact
constexpr double ln2_low = 1.90821492927058770002e-10;

GEM_HD inline std::uint64_t bits_of(double x) {
  std::uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

GEM_HD inline double double_of(std::uint64_t bits) {
  double x;
  std::memcpy(&x, &bits, sizeof x);
  return x;
}

/// 2 atanh(t) for |t| <= 0.1716, by its odd series.
GEM_HD inline double twice_atanh(double t) {
  const double q = t * t;
  double sum = 1.0 / 23.0;
  sum = sum * q + 1.0 / 21.0;
  sum = sum * q + 1.0 / 19.0;
  sum = sum * q + 1.0 / 17.0;
  sum = sum * q + 1.0 / 15.0;
  sum = sum * q + 1.0 / 13.0;
  sum = sum * q + 1.0 / 11.0;
  sum = sum * q + 1.0 / 9.0;
  sum = sum * q + 1.0 / 7.0;
  sum = sum * q + 1.0 / 5.0;
  sum = sum * q + 1.0 / 3.0;
  return 2.0 * (t + t * (q * sum));
}

/// ln x for normal x > 0.
GEM_HD inline double log(double x) {
  const std::uint64_t bits = bits_of(x);
  std::int64_t exponent = static_cast<std::int64_t>(bits >> 52) - 1023;
  double mantissa = double_of((bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull);
  if (mantissa > 1.4142135623730951) {
    mantissa *= 0.5;
    exponent += 1;
  }
  const double n = static_cast<double>(exponent);
  return n * ln2_high + (twice_atanh((mantissa - 1.0) / (mantissa + 1.0)) + n * ln2_low);
}

/// ln(1 + z) for z >= 0, accurate for small z.
GEM_HD inline double log1p(double z) {
  if (z < 0.02) {  // the usual case of a short moment: five terms are as good as all
    const double t = z / (2.0 + z);
    const double q = t * t;
    return 2.0 * (t + t * (q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0))))));
  }
  if (z < 0.25) return twice_atanh(z / (2.0 + z));
  return log(1.0 + z);
}

/// e^y for |y| < 700.
GEM_HD inline double exp(double y) {
  const double scaled = y * 1.4426950408889634;
  const std::int64_t n = static_cast<std::int64_t>(scaled + (scaled < 0.0 ? -0.5 : 0.5));
  const double r = (y - static_cast<double>(n) * ln2_high) - static_cast<double>(n) * ln2_low;
  double sum = 1.0;
  for (int k = 16; k >= 1; --k) sum = 1.0 + (r / k) * sum;
  return sum * double_of(static_cast<std::uint64_t>(n + 1023) << 52);
}

/// x^p for x >= 0 and |p ln x| < 700; 0^p is 0 for p > 0.
GEM_HD inline double power(double x, double p) {
  if (x <= 0.0) return 0.0;
  return exp(p * log(x));
}

}  // namespace strict
}  // namespace gem
