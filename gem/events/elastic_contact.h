// Steady elastic stress between two bodies that overlap: the static event, which carries pressure across a jam.
//
// A spring of stiffness k with critical damping acts on the overlap over one moment, taken implicitly:
//     u = dt (k/m) d / (1 + omega dt)^2,    omega = sqrt(k/m)
// is the separating speed that it asks for; the impulse to reach it is capped by the crushing force times dt.
//
//   d   depth of the overlap [m]       m   effective mass of the pair [kg]
//   k   elastic stiffness [N/m]        dt  length of the moment [s]
//
// The implicit form is stable for any k dt^2 / m and never overshoots d = 0. The reference paper names the event but
// gives no formula; this one is this project's.
#pragma once

#include <cmath>

#include "gem/base/macros.h"

namespace gem {

/// Separating speed that the elastic stress asks for [m/s].
GEM_HD inline double elastic_separating_speed(double stiffness, double depth, double effective_mass, double dt) {
  const double rate2 = stiffness / effective_mass;
  const double damped = 1.0 + std::sqrt(rate2) * dt;
  return dt * rate2 * depth / (damped * damped);
}

}  // namespace gem
