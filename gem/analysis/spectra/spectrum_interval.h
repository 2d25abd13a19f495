// Spectra with the interval of every density: multitaper by a jackknife over tapers, Welch by chi-squared.
#pragma once

#include <span>
#include <vector>

#include "gem/analysis/spectra/spectrum.h"

namespace gem {

/// A spectrum and, frequency by frequency, the interval that holds the true density.
struct SpectrumInterval {
  Spectrum spectrum;
  std::vector<double> low, high;  // [unit^2/Hz]
  double degrees = 0.0;           // of freedom of one density
};

/// Multitaper estimate. The logarithm of the density is jackknifed over the tapers (Thomson and Chave 1991), so the
/// interval needs no normal signal; Student's t with tapers - 1 degrees of freedom. Errors as for eigenspectra().
SpectrumInterval multitaper_interval(std::span<const double> signal, double interval_s,
                                     const MultitaperOptions& options = {}, double confidence = 0.95);

/// Welch's estimate. For a normal signal the density is chi-squared, with the degrees of freedom of half overlapping
/// Hann segments. Errors as for welch().
SpectrumInterval welch_interval(std::span<const double> signal, double interval_s, double segment_s,
                                double confidence = 0.95);

}  // namespace gem
