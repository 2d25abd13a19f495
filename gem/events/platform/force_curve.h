// A force over a distance, as pieces of cubic polynomials, with its energy. The tables of moorings and of their lines.
//
//   f(x) = c0 + c1 d + c2 d^2 + c3 d^3,   U(x) = U_i + c0 d + c1 d^2 / 2 + c2 d^3 / 3 + c3 d^4 / 4,   d = x - x_i
//
//   x_i  knot below x [m]     U_i  energy there, the integral of f from the first knot [J]
//
// Linear tables have c2 = c3 = 0. Smooth ones have the given slope at each knot (cubic Hermite pieces). Below the first
// knot the force is that of the first knot where it is 0 (slack), so its energy is 0. Beyond the last knot the last
// piece goes on.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gem/base/macros.h"

namespace gem {

/// A piece of a curve, from its knot to the next one.
struct CurveKnot {
  double at = 0.0;        // x_i [m]
  double energy = 0.0;    // U_i [J]
  double force[4] = {};   // c0 to c3
  double beside[4] = {};  // the same of a second number: the tension of a line [N]
};

/// A curve at one distance.
struct CurvePoint {
  double force = 0.0;   // [N]
  double energy = 0.0;  // [J]
  double slope = 0.0;   // of the force [N/m]
  double beside = 0.0;  // [N]
};

/// Index of the last of `count` knots at or below `x`; the first knot if there is none.
GEM_HD inline std::int32_t knot_below(const CurveKnot* knot, std::int32_t count, double x) {
  std::int32_t low = 0, high = count;  // knot[low].at <= x < knot[high].at, where there are such knots
  while (high - low > 1) {
    const std::int32_t middle = (low + high) / 2;
    if (knot[middle].at <= x)
      low = middle;
    else
      high = middle;
  }
  return low;
}

/// The curve at distance `x` [m].
GEM_HD inline CurvePoint curve_at(const CurveKnot* knot, std::int32_t count, double x) {
  const CurveKnot& k = knot[knot_below(knot, count, x)];
  const double d = x - k.at;
  if (d < 0.0) return {k.force[0], k.energy, 0.0, k.beside[0]};
  const double* c = k.force;
  return {c[0] + d * (c[1] + d * (c[2] + d * c[3])),
          k.energy + d * (c[0] + d * (c[1] / 2.0 + d * (c[2] / 3.0 + d * (c[3] / 4.0)))),
          c[1] + d * (2.0 * c[2] + d * (3.0 * c[3])),
          k.beside[0] + d * (k.beside[1] + d * (k.beside[2] + d * k.beside[3]))};
}

/// Row of a table: offset [m], force [N].
using ForceRow = std::array<double, 2>;

/// A curve that is linear between its rows, whose offsets rise. At least two rows. Host only.
std::vector<CurveKnot> linear_curve(const std::vector<ForceRow>& rows);

/// A point of a smooth curve with its slopes [N/m].
struct CurveSample {
  double at = 0.0;  // [m]
  double force = 0.0, force_slope = 0.0;
  double beside = 0.0, beside_slope = 0.0;
};

/// A smooth curve through its samples, which rise. Beyond the last it is linear. At least one sample. Host only.
std::vector<CurveKnot> smooth_curve(const std::vector<CurveSample>& samples);

}  // namespace gem
