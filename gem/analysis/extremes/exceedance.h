// Exceedance of levels: the curve with its confidence band, for independent values such as the peaks of cycles.
#pragma once

#include <span>
#include <vector>

namespace gem {

/// Fraction of independent values above each level, and the band that contains the whole true curve.
struct ExceedanceCurve {
  std::vector<double> level;
  std::vector<double> probability;
  double band = 0.0;  // half height, at every level (Dvoretzky, Kiefer, Wolfowitz)
};

/// The curve at each of the independent values (for example one per run), in ascending order. Its probability is the
/// share of values strictly above. Empty without values.
ExceedanceCurve exceedance(std::span<const double> values, double confidence = 0.95);

/// The largest value between each up-crossing of the mean and the next: one peak per cycle.
std::vector<double> cycle_peaks(std::span<const double> signal);

}  // namespace gem
