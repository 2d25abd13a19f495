// How often a level is exceeded: the curve of the samples or of the peak of every cycle, with its band.
#pragma once

#include <span>
#include <vector>

namespace gem {

/// Fraction of independent values above each level, and the band that holds the whole true curve.
struct ExceedanceCurve {
  std::vector<double> level;
  std::vector<double> probability;
  double band = 0.0;  // half height, at every level (Dvoretzky, Kiefer, Wolfowitz)
};

/// The curve of independent values (one per run, say) at each of them, in ascending order; probability counts values
/// strictly above. Empty for no values.
ExceedanceCurve exceedance(std::span<const double> values, double confidence = 0.95);

/// The largest value between each up-crossing of the mean and the next: one peak per cycle, however it wiggles.
std::vector<double> cycle_peaks(std::span<const double> signal);

}  // namespace gem
