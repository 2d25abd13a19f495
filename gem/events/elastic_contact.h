// Steady elastic stress between two bodies that overlap: the static event, which carries pressure across a jam.
//
// A spring of stiffness k with critical damping acts on the overlap over one time step, taken implicitly:
//     u = dt (k/m) d / (1 + omega dt)^2,    omega = sqrt(k/m)
// is the separating speed that it asks for; the impulse to reach it is capped by the crushing force times dt.
//
//   d   depth of the overlap [m]       m   effective mass of the pair [kg]
//   k   elastic stiffness [N/m]        dt  length of the time step [s]
//
// The implicit form is stable for any k dt^2 / m, and one time step never takes two bodies that lie still past d = 0.
// It is not a damper over several time steps: u stays once it is reached, since contacts do not pull. Depth is taken as
// found, and a time step brings two bodies that close at v up to v dt into each other before their contact is seen. The
// stress of that depth gives back up to
//     u / v = (omega dt / (1 + omega dt))^2
// of the closing speed, in the time step of the impact or, with that left out, in the next: the impact of an
// `independent` time step is fully inelastic without this stress only, or as dt goes to 0 (validation/README.md, V52).
//
// The reference paper names the event but gives no formula; this one is this project's.
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
