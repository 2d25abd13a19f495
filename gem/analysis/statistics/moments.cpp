// Statistics of records, with GSL where it has them.
#include "gem/analysis/statistics/moments.h"

#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>

namespace gem {

Moments moments(std::span<const double> signal) {
  if (signal.empty()) return {};
  Moments result;
  result.mean = gsl_stats_mean(signal.data(), 1, signal.size());
  result.deviation = gsl_stats_sd_with_fixed_mean(signal.data(), 1, signal.size(), result.mean);
  gsl_stats_minmax(&result.minimum, &result.maximum, signal.data(), 1, signal.size());
  return result;
}

Excursion maximum_excursion(std::span<const double> signal, double rest) {
  Excursion largest;
  for (std::size_t i = 0; i < signal.size(); ++i)
    if (std::abs(signal[i] - rest) > std::abs(largest.value)) largest = {signal[i] - rest, i};
  return largest;
}

Excursion maximum_radial_excursion(std::span<const double> x, std::span<const double> y, double rest_x, double rest_y) {
  Excursion largest;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double distance = std::hypot(x[i] - rest_x, y[i] - rest_y);
    if (distance > largest.value) largest = {distance, i};
  }
  return largest;
}

double percentile(std::span<const double> signal, double p) {
  if (signal.empty()) return 0.0;
  std::vector<double> sorted(signal.begin(), signal.end());
  std::sort(sorted.begin(), sorted.end());
  return gsl_stats_quantile_from_sorted_data(sorted.data(), 1, sorted.size(), p);
}

double intermittency(std::span<const double> contacts) {
  if (contacts.empty()) return 0.0;
  const auto busy = std::count_if(contacts.begin(), contacts.end(), [](double value) { return value != 0.0; });
  return static_cast<double>(busy) / static_cast<double>(contacts.size());
}

}  // namespace gem
