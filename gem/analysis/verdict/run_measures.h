// The numbers by which a run is judged.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gem {

/// A value and the simulated time at which it occurred.
struct Occurred {
  double value = std::nan("");   // NaN: not measured
  double time_s = std::nan("");  // NaN: a value of the whole run

  /// Keeps the larger value. A value that is not measured changes nothing.
  void raise(double other, double time) {
    if (other > value || (std::isnan(value) && !std::isnan(other))) *this = {other, time};
  }
};

/// Gathered over all time steps of a run unless said otherwise. NaN: not measured by this engine or solver.
struct RunMeasures {
  double speed_scale = 0.0;  // largest of drift in current and wind, speeds at the start and the platform's swing [m/s]
  double squeeze_friction = 0.0;           // mean coefficient at a floe squeezed between two bodies, the least [-]
  Occurred overlap_share;                  // deepest overlap over the size (root of the area) of the smaller body [-]
  double unfinished_share = std::nan("");  // share of the time steps with contacts that end above the tolerance [-]
  Occurred residual;                       // largest velocity correction still due at the end of a time step [m/s]
  double residual_median = std::nan("");   // half of the time steps with contacts leave more [m/s]
  double residual_most = std::nan("");     // a tenth of them leaves more [m/s]
  Occurred floe_speed;                     // largest, of the floe frames [m/s]
  /// Sum over the time steps in which the contacts gave energy; compliant: largest energy that the books of the
  /// contacts leave unexplained [J].
  double energy_created = std::nan("");
  double energy_lost = std::nan("");  // sum over the time steps in which they took energy; compliant: all they took [J]
  double energy_largest = 0.0;        // largest kinetic energy, of the floe frames [J]
  bool compliant = false;  // contacts spring and crush: nothing iterates, and the overlap is that beyond crushed ice
  double softened_share = std::nan("");  // load through softened corners over all load [-]
  double nyquist_share = std::nan("");   // of the ice force on the platform [-]
  std::int64_t loaded_steps = 0;         // time steps with an ice force on the platform

  /// The speed that drives the ice, for ratios: a scene at rest has 1 mm/s, as for the solver's tolerance [m/s].
  double driving_speed() const { return std::max(speed_scale, 1e-3); }
};

}  // namespace gem
