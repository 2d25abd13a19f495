// Steady elastic stress between two overlapping bodies: the static event, which carries pressure through a jam.
//
// A critically damped spring of stiffness k acts on the overlap over one time step, integrated implicitly:
//     u = dt (k/m) d / (1 + omega dt)^2,    omega = sqrt(k/m)
// is the separating speed that it asks for. The impulse to reach u is limited to the crushing force times dt.
//
//   d   depth of the overlap [m]       m   effective mass of the pair [kg]
//   k   elastic stiffness [N/m]        dt  length of the time step [s]
//
// The implicit form is stable for any k dt^2 / m. In one time step it never moves two bodies at rest past d = 0. It
// does not damp over several time steps: u stays once it is reached, since contacts do not pull. Two bodies that close
// at v overlap by up to v dt before their contact is found. The stress of that depth returns up to
//     u / v = (omega dt / (1 + omega dt))^2
// of the closing speed, in the time step of the impact or in the next one. So an impact of an `independent` time step
// is fully inelastic only without this stress, or in the limit dt -> 0 (validation/README.md, V52).
//
// The reference paper names the event but gives no formula; this formula is our own.
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
