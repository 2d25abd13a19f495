// Logarithm, exponential, power and rotation from + - * / alone: the same bits on every compiler, processor and
// accelerator.
//
// The library functions of two platforms round differently. These functions do not: contraction is off, and they use
// only exact IEEE operations. Relative errors, checked against extended precision:
//
//   log, log1p   4e-16 over all finite arguments, subnormals included
//   exp          4e-16 where the result is a normal number
//   power        (1 + |p ln x|) 4e-16: the rounding of p ln x is an absolute error of the exponent
//   rotation     cosine and sine to 4e-16 absolute for an exact number of turns
//   angle        1e-15 absolute
//
// NaN stays NaN.
#pragma once

#include <cstdint>
#include <cstring>

#include "gem/base/macros.h"
#include "gem/base/vec2.h"

namespace gem {
namespace strict {

constexpr double ln2_high =
    6.93147180369123816490e-01;  // ln 2 with 33 trailing zero bits, so that n * ln2_high is exact
constexpr double ln2_low = 1.90821492927058770002e-10;
constexpr double two_pi = 6.283185307179586;
constexpr double largest = 1.7976931348623157e308;
constexpr double smallest_normal = 2.2250738585072014e-308;

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

/// 2 to the power n, for a normal result.
GEM_HD inline double power_of_two(std::int64_t n) { return double_of(static_cast<std::uint64_t>(n + 1023) << 52); }

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

/// ln x for x > 0.
GEM_HD inline double log(double x) {
  if (!(x <= largest)) return x;
  std::int64_t exponent = -1023;
  if (x < smallest_normal) {
    x *= 0x1p54;
    exponent -= 54;
  }
  const std::uint64_t bits = bits_of(x);
  exponent += static_cast<std::int64_t>(bits >> 52);
  double mantissa = double_of((bits & 0x000fffffffffffffull) | 0x3ff0000000000000ull);
  if (mantissa > 1.4142135623730951) {
    mantissa *= 0.5;
    exponent += 1;
  }
  const double n = static_cast<double>(exponent);
  return n * ln2_high + (twice_atanh((mantissa - 1.0) / (mantissa + 1.0)) + n * ln2_low);
}

/// ln(1 + z) for 0 <= z < short_argument, where five terms of the series reach full accuracy.
constexpr double short_argument = 0.02;
GEM_HD inline double log1p_short(double z) {
  const double t = z / (2.0 + z);
  const double q = t * t;
  return 2.0 * (t + t * (q * (1.0 / 3.0 + q * (1.0 / 5.0 + q * (1.0 / 7.0 + q * (1.0 / 9.0))))));
}

/// ln(1 + z) for z >= 0, accurate for small z.
GEM_HD inline double log1p(double z) {
  if (z < short_argument) return log1p_short(z);  // the usual case: a short time step
  if (z < 0.25) return twice_atanh(z / (2.0 + z));
  const double sum = 1.0 + z;
  if (!(z < 0x1p53)) return log(sum);
  return log(sum) + (z - (sum - 1.0)) / sum;  // the second term corrects the rounding of 1 + z
}

/// e^y; 0 or infinity beyond the range of a double.
GEM_HD inline double exp(double y) {
  if (!(y < 710.0)) return y * largest;
  if (y < -746.0) return 0.0;
  const double scaled = y * 1.4426950408889634;
  const std::int64_t n = static_cast<std::int64_t>(scaled + (scaled < 0.0 ? -0.5 : 0.5));
  const double r = (y - static_cast<double>(n) * ln2_high) - static_cast<double>(n) * ln2_low;
  double sum = 1.0;
  for (int k = 16; k >= 1; --k) sum = 1.0 + (r / k) * sum;
  // two factors, since 2^n itself may be outside the range of normal numbers
  const std::int64_t half = n / 2;
  return (sum * power_of_two(half)) * power_of_two(n - half);
}

/// x^p for x >= 0; 0^p is 0 (p > 0), and x^1 is x.
GEM_HD inline double power(double x, double p) {
  if (x <= 0.0) return 0.0;
  if (p == 1.0) return x;
  return exp(p * log(x));
}

namespace detail {
/// 1 / k for k from 1 to 8.
GEM_HD constexpr double inverse_of(int k) {
  constexpr double inverse[] = {1.0, 1.0 / 2, 1.0 / 3, 1.0 / 4, 1.0 / 5, 1.0 / 6, 1.0 / 7, 1.0 / 8};
  return inverse[k - 1];
}
}  // namespace detail

/// The rotation by a number of full turns; exact for quarter turns.
GEM_HD inline Rotation rotation_of_turns(double turns) {
  turns -= std::floor(turns);
  const double quarter = std::floor(4.0 * turns + 0.5);
  const double r = two_pi * (turns - 0.25 * quarter);
  double cosine = 1.0;
  double sine = 1.0;
  for (int n = 18; n >= 2; n -= 2) {
    cosine = 1.0 - r * r / (n * (n - 1)) * cosine;
    sine = 1.0 - r * r / (n * (n + 1)) * sine;
  }
  sine *= r;
  switch (static_cast<int>(quarter) % 4) {
    case 1:
      return {-sine, cosine};
    case 2:
      return {-cosine, -sine};
    case 3:
      return {sine, -cosine};
    default:
      return {cosine, sine};
  }
}

/// The rotation by an angle [rad].
GEM_HD inline Rotation rotation_of_angle(double angle) { return rotation_of_turns(angle / two_pi); }

/// The angle of a rotation in (-pi, pi] [rad]: that of its quarter turn, and 8 atan of the tangent of an eighth of the
/// rest, by its series.
GEM_HD inline double angle_of(Rotation q) {
  const bool back = q.cosine < 0.0, left = !(q.sine < 0.0);
  const double cosine = !back ? q.cosine : left ? q.sine : -q.sine;
  const double sine = !back ? q.sine : left ? -q.cosine : q.cosine;
  double t = sine / (1.0 + cosine);
  t = t / (1.0 + std::sqrt(1.0 + t * t));
  t = t / (1.0 + std::sqrt(1.0 + t * t));
  const double z = t * t;
  double sum = 0.0;
  for (int n = 25; n >= 3; n -= 2) sum = 1.0 / n - z * sum;
  const double rest = 8.0 * (t - t * (z * sum));
  return !back ? rest : left ? 0.25 * two_pi + rest : rest - 0.25 * two_pi;
}

}  // namespace strict
}  // namespace gem
