// For tests: what a contact point may still ask for after a coupled time step that ended by its residual.
#pragma once

#include <algorithm>
#include <cmath>

#include "gem/field/bodies.h"

namespace gem::test {

/// Largest speed that a point may still ask for [m/s] where the last visit of the iterations left the residual
/// `residual` [m/s].
///
/// The last visit changed the impulses of point j by s_j, along the normal and along the tangent, with K_j |s_j| <= r,
/// the residual. K_j is the compliance with the divided masses: p a_jj and more, where a_jj is what one of its bodies
/// with p points contributes alone. A point that asked for no more than r then meets what the last steps of the other
/// points do to its bodies. By Cauchy and Schwarz each body with its p points adds at most
///     sum_j sqrt(a_ii a_jj) |s_j|  <=  r sqrt(a_ii / least a_jj)
/// for the normal impulses, and the same again for friction. So with two bodies r (1 + 4 sqrt(q)). Each a is
/// 1/m + lever^2 / I, with a lever of at most the radius R, so q is at most 1 + m R^2 / I (4 for every rectangle).
inline double speed_still_asked(const Bodies& b, double residual) {
  double q = 1.0;
  for (std::size_t i = 0; i < b.count(); ++i)
    if (b.inverse_mass[i] > 0.0)
      q = std::max(q, 1.0 + b.radius[i] * b.radius[i] * b.inverse_inertia[i] / b.inverse_mass[i]);
  return residual * (1.0 + 4.0 * std::sqrt(q));
}

}  // namespace gem::test
