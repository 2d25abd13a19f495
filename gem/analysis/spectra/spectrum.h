// Power spectra of evenly sampled records by the multitaper method.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gem {

/// One-sided power spectral density of the mean-removed signal. The sum times `step` is the variance.
struct Spectrum {
  double step = 0.0;            // spacing of the frequencies, which start at 0 [Hz]
  double half_bandwidth = 0.0;  // features closer than twice this are not resolved [Hz]
  double duration = 0.0;        // length of the record [s]
  std::vector<double> density;  // [unit^2/Hz]

  double frequency(std::size_t i) const { return step * static_cast<double>(i); }
};

struct MultitaperOptions {
  double time_bandwidth = 2.5;  // NW
  std::size_t taper_count = 4;  // K, at most 2 NW - 1
};

/// The spectrum of each taper (Thomson 1982), zero-padded to a power of two. Their mean is the estimate, their scatter
/// its uncertainty. Throws std::invalid_argument for fewer than 16 samples or if the interval is not positive.
std::vector<Spectrum> eigenspectra(std::span<const double> signal, double interval_s,
                                   const MultitaperOptions& options = {});

/// Mean of several spectra of one record, without the spectrum number `without` if given.
Spectrum mean_spectrum(const std::vector<Spectrum>& spectra, std::size_t without = static_cast<std::size_t>(-1));

}  // namespace gem
