// Shape of the path in the plane: principal axes, their angle and the sense of rotation, over time.
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
  double turning = 0.0;   // +1 for a counter-clockwise circle, -1 clockwise, 0 for a line or rotation in both senses
};

/// The orbit of the whole record. The sense of rotation is the area swept about the mean over the area that a circular
/// path of the same speed and distance would sweep. Throws std::invalid_argument unless both columns have one length of
/// at least two samples.
Orbit orbit(std::span<const double> x, std::span<const double> y, double interval_s);

/// Orbits of consecutive stretches of `stretch_s`; an incomplete stretch at the end is left out. Throws
/// std::invalid_argument for a stretch of fewer than two samples.
std::vector<Orbit> orbit_over_time(std::span<const double> x, std::span<const double> y, double interval_s,
                                   double stretch_s);

}  // namespace gem
