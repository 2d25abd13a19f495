// Counts exceedances and finds the peaks of cycles.
#include "gem/analysis/extremes/exceedance.h"

#include <algorithm>
#include <cmath>

#include "gem/analysis/statistics/moments.h"

namespace gem {

ExceedanceCurve exceedance(std::span<const double> values, double confidence) {
  ExceedanceCurve curve;
  if (values.empty()) return curve;
  curve.level.assign(values.begin(), values.end());
  std::sort(curve.level.begin(), curve.level.end());
  const auto count = static_cast<double>(values.size());
  for (const double level : curve.level) {
    const auto above = curve.level.end() - std::upper_bound(curve.level.begin(), curve.level.end(), level);
    curve.probability.push_back(static_cast<double>(above) / count);
  }
  curve.band = std::sqrt(std::log(2.0 / (1.0 - confidence)) / (2.0 * count));
  return curve;
}

std::vector<double> cycle_peaks(std::span<const double> signal) {
  std::vector<double> peaks;
  if (signal.empty()) return peaks;
  const double mean = moments(signal).mean;
  bool whole = false;  // true from the first up-crossing on
  double peak = 0.0;
  for (std::size_t i = 1; i < signal.size(); ++i) {
    if (signal[i - 1] < mean && signal[i] >= mean) {
      if (whole) peaks.push_back(peak);
      whole = true;
      peak = signal[i];
    }
    peak = std::max(peak, signal[i]);
  }
  return peaks;
}

}  // namespace gem
