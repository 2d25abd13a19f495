// Elementary functions with the same bits everywhere: only IEEE + - * / and exact scaling by powers of two.
//
// A C library may round exp, log, sine and cosine differently from another, or from itself on another processor.
// A field must not depend on that. The series below are good to about 1e-15 relative; they are used where a field is
// made, never in a step.
#pragma once

#include <cmath>
#include <limits>

#include "gem/base/vec2.h"

namespace gem {

inline constexpr double ln2_high = 0x1.62e42fee00000p-1;  // short enough that k * ln2_high is exact
inline constexpr double ln2_low = 0x1.a39ef35793c76p-33;
inline constexpr double two_pi = 6.283185307179586;

/// e to the power x; 0 below -700.
inline double portable_exp(double x) {
  if (x < -700.0) return 0.0;
  if (x > 700.0) return std::numeric_limits<double>::infinity();
  const double k = std::floor(x / (ln2_high + ln2_low) + 0.5);
  const double r = (x - k * ln2_high) - k * ln2_low;
  double sum = 1.0;
  for (int n = 14; n >= 1; --n) sum = 1.0 + r / n * sum;
  return std::ldexp(sum, static_cast<int>(k));
}

/// Natural logarithm of x > 0.
inline double portable_log(double x) {
  int k = 0;
  double m = std::frexp(x, &k);
  if (m < 0.7071067811865476) {
    m *= 2.0;
    --k;
  }
  const double t = (m - 1.0) / (m + 1.0);
  double sum = 0.0;
  for (int n = 23; n >= 1; n -= 2) sum = 1.0 / n + t * t * sum;
  return k * ln2_high + (2.0 * t * sum + k * ln2_low);
}

/// The rotation by a number of full turns: quarter turns are exact.
inline Rotation rotation_of_turns(double turns) {
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
inline Rotation rotation_of_angle(double angle) { return rotation_of_turns(angle / two_pi); }

}  // namespace gem
