// Shape of the path in the plane: principal axes, their angle, and the sense of turning, over time.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gem {

struct Orbit {
  double start = 0.0;     // of the stretch [s]
  double end = 0.0;       // [s]
  double centre_x = 0.0;  // mean [m]
  double centre_y = 0.0;  // [m]
  double major = 0.0;     // standard deviation along the longer axis [m]
  double minor = 0.0;     // along the shorter one [m]
  double angle = 0.0;     // of the longer axis from x, counter-clockwise, in (-pi/2, pi/2] [rad]
  double turning = 0.0;   // +1 circles counter-clockwise, -1 clockwise, 0 swings on a line or turns both ways alike
};

/// One orbit of the whole record. The turning sense is the area swept about the mean over the area that a circular path
/// of the same speed and distance would sweep. Needs two samples of equal count, otherwise std::invalid_argument.
Orbit orbit(std::span<const double> x, std::span<const double> y, double interval_s);

/// Orbits of stretches of `stretch_s`, one after another; a shorter rest at the end is left out. Needs a stretch of two
/// samples, otherwise std::invalid_argument.
std::vector<Orbit> orbit_over_time(std::span<const double> x, std::span<const double> y, double interval_s,
                                   double stretch_s);

}  // namespace gem
