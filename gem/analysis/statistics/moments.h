// Mean, deviation, extremes and percentiles of a record.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gem {

struct Moments {
  double mean = 0.0;
  double deviation = 0.0;  // standard deviation about the mean of the record
  double minimum = 0.0;
  double maximum = 0.0;
};
/// Moments of a record; zeros for an empty record.
Moments moments(std::span<const double> signal);

/// The largest excursion from rest and the sample at which it occurs.
struct Excursion {
  double value = 0.0;  // signed for one axis, a distance for the plane
  std::size_t sample = 0;
};
Excursion maximum_excursion(std::span<const double> signal, double rest = 0.0);
/// The largest distance from (rest_x, rest_y). Both records must have the same length.
Excursion maximum_radial_excursion(std::span<const double> x, std::span<const double> y, double rest_x = 0.0,
                                   double rest_y = 0.0);

/// The value below which a fraction `p` in [0, 1] of the record lies, by linear interpolation; 0 for an empty record.
double percentile(std::span<const double> signal, double p);

/// Fraction of samples that are not zero, i.e. of the time with contact.
double intermittency(std::span<const double> contacts);

}  // namespace gem
