// Spectra by the fast Fourier transform of windowed records.
#include "gem/analysis/spectra/spectrum.h"

#include <gsl/gsl_fft_real.h>

#include <algorithm>
#include <bit>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/spectra/tapers.h"

namespace gem {
namespace {

std::vector<double> without_mean(std::span<const double> signal) {
  const double mean = std::accumulate(signal.begin(), signal.end(), 0.0) / static_cast<double>(signal.size());
  std::vector<double> centred(signal.begin(), signal.end());
  for (double& value : centred) value -= mean;
  return centred;
}

/// One-sided density of the signal times a window of unit energy, zero-padded to `padded` samples (a power of two).
std::vector<double> windowed_density(std::span<const double> signal, std::span<const double> window, std::size_t padded,
                                     double interval_s) {
  std::vector<double> work(padded, 0.0);
  for (std::size_t i = 0; i < signal.size(); ++i) work[i] = signal[i] * window[i];
  gsl_fft_real_radix2_transform(work.data(), 1, padded);
  // Half-complex order: real parts in the first half, imaginary parts in reverse order from the end.
  const std::size_t half = padded / 2;
  std::vector<double> density(half + 1);
  density[0] = work[0] * work[0] * interval_s;
  density[half] = work[half] * work[half] * interval_s;
  for (std::size_t k = 1; k < half; ++k)
    density[k] = 2.0 * (work[k] * work[k] + work[padded - k] * work[padded - k]) * interval_s;
  return density;
}

void check(std::span<const double> signal, double interval_s) {
  if (signal.size() < 16) throw std::invalid_argument("a spectrum needs at least 16 samples");
  if (!(interval_s > 0.0)) throw std::invalid_argument("the sampling interval must be positive");
}

Spectrum blank(std::size_t samples, std::size_t padded, double interval_s) {
  Spectrum spectrum;
  spectrum.step = 1.0 / (static_cast<double>(padded) * interval_s);
  spectrum.duration = static_cast<double>(samples) * interval_s;
  spectrum.density.assign(padded / 2 + 1, 0.0);
  return spectrum;
}

}  // namespace

std::vector<Spectrum> eigenspectra(std::span<const double> signal, double interval_s,
                                   const MultitaperOptions& options) {
  check(signal, interval_s);
  const std::vector<double> centred = without_mean(signal);
  // Padded to twice the needed length, so that the spectrum is fine enough to locate a peak.
  const std::size_t padded = 2 * std::bit_ceil(signal.size());
  std::vector<Spectrum> spectra;
  for (const std::vector<double>& taper : slepian_tapers(signal.size(), options.time_bandwidth, options.taper_count)) {
    Spectrum spectrum = blank(signal.size(), padded, interval_s);
    spectrum.half_bandwidth = options.time_bandwidth / spectrum.duration;
    spectrum.density = windowed_density(centred, taper, padded, interval_s);
    spectra.push_back(std::move(spectrum));
  }
  return spectra;
}

Spectrum mean_spectrum(const std::vector<Spectrum>& spectra, std::size_t without) {
  if (spectra.empty()) throw std::invalid_argument("no spectra to average");
  Spectrum mean = spectra.front();
  std::fill(mean.density.begin(), mean.density.end(), 0.0);
  double used = 0.0;
  for (std::size_t s = 0; s < spectra.size(); ++s) {
    if (s == without) continue;
    used += 1.0;
    for (std::size_t i = 0; i < mean.density.size(); ++i) mean.density[i] += spectra[s].density[i];
  }
  for (double& value : mean.density) value /= used;
  return mean;
}

}  // namespace gem
