// Makes curves of force over distance from their rows.
#include "gem/events/platform/force_curve.h"

namespace gem {
namespace {

/// Coefficients of the cubic with these values and slopes at both ends of a piece of `length`.
void set_cubic(double (&c)[4], double from, double slope_from, double to, double slope_to, double length) {
  const double secant = (to - from) / length;
  c[0] = from;
  c[1] = slope_from;
  c[2] = (3.0 * secant - 2.0 * slope_from - slope_to) / length;
  c[3] = (slope_from + slope_to - 2.0 * secant) / (length * length);
}

/// Sums the energies at the knots up.
void set_energies(std::vector<CurveKnot>& knots) {
  for (std::size_t k = 1; k < knots.size(); ++k) knots[k].energy = curve_at(&knots[k - 1], 1, knots[k].at).energy;
}

}  // namespace

std::vector<CurveKnot> linear_curve(const std::vector<ForceRow>& rows) {
  std::vector<CurveKnot> knots;
  for (std::size_t k = 0; k + 1 < rows.size(); ++k) {
    CurveKnot& knot = knots.emplace_back();
    knot.at = rows[k][0];
    knot.force[0] = rows[k][1];
    knot.force[1] = (rows[k + 1][1] - rows[k][1]) / (rows[k + 1][0] - rows[k][0]);
  }
  set_energies(knots);
  return knots;
}

std::vector<CurveKnot> smooth_curve(const std::vector<CurveSample>& samples) {
  std::vector<CurveKnot> knots;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const CurveSample& from = samples[k];
    CurveKnot& knot = knots.emplace_back();
    knot.at = from.at;
    knot.force[0] = from.force;
    knot.force[1] = from.force_slope;
    knot.beside[0] = from.beside;
    knot.beside[1] = from.beside_slope;
    if (k + 1 == samples.size()) break;
    const CurveSample& to = samples[k + 1];
    const double length = to.at - from.at;
    set_cubic(knot.force, from.force, from.force_slope, to.force, to.force_slope, length);
    set_cubic(knot.beside, from.beside, from.beside_slope, to.beside, to.beside_slope, length);
  }
  set_energies(knots);
  return knots;
}

}  // namespace gem
