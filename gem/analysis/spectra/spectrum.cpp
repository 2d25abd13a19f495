// Spectra by fast Fourier transform of windowed records.
#include "gem/analysis/spectra/spectrum.h"

#include <gsl/gsl_fft_real.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
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

/// One-sided density of signal times a window of unit energy, padded with zeros to `padded` (a power of two).
std::vector<double> windowed_density(std::span<const double> signal, std::span<const double> window, std::size_t padded,
                                     double interval_s) {
  std::vector<double> work(padded, 0.0);
  for (std::size_t i = 0; i < signal.size(); ++i) work[i] = signal[i] * window[i];
  gsl_fft_real_radix2_transform(work.data(), 1, padded);
  // Half-complex order: real parts up to the middle, imaginary parts mirrored from the end.
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

std::vector<double> hann_of_unit_energy(std::size_t length) {
  std::vector<double> window(length);
  const double turn = 2.0 * std::numbers::pi / static_cast<double>(length);
  double energy = 0.0;
  for (std::size_t i = 0; i < length; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(turn * (static_cast<double>(i) + 0.5));
    energy += window[i] * window[i];
  }
  for (double& value : window) value /= std::sqrt(energy);
  return window;
}

Spectrum blank(std::size_t samples, std::size_t padded, double interval_s) {
  Spectrum spectrum;
  spectrum.step = 1.0 / (static_cast<double>(padded) * interval_s);
  spectrum.duration = static_cast<double>(samples) * interval_s;
  spectrum.density.assign(padded / 2 + 1, 0.0);
  return spectrum;
}

}  // namespace

double Spectrum::variance() const { return std::accumulate(density.begin(), density.end(), 0.0) * step; }

std::vector<Spectrum> eigenspectra(std::span<const double> signal, double interval_s,
                                   const MultitaperOptions& options) {
  check(signal, interval_s);
  const std::vector<double> centred = without_mean(signal);
  // Twice as long as needed: the padded spectrum is fine enough to place a peak.
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

Spectrum multitaper(std::span<const double> signal, double interval_s, const MultitaperOptions& options) {
  return mean_spectrum(eigenspectra(signal, interval_s, options));
}

Spectrum welch(std::span<const double> signal, double interval_s, double segment_s) {
  check(signal, interval_s);
  const auto wanted = static_cast<std::size_t>(std::llround(segment_s / interval_s));
  const std::size_t length = std::clamp<std::size_t>(wanted, 16, signal.size());
  const std::size_t padded = std::bit_ceil(length);
  const std::vector<double> centred = without_mean(signal);
  const std::vector<double> window = hann_of_unit_energy(length);
  Spectrum mean = blank(signal.size(), padded, interval_s);
  mean.half_bandwidth = 2.0 / (static_cast<double>(length) * interval_s);
  mean.segments = 0;
  for (std::size_t begin = 0; begin + length <= signal.size(); begin += length / 2) {
    const std::vector<double> density =
        windowed_density(std::span(centred).subspan(begin, length), window, padded, interval_s);
    for (std::size_t i = 0; i < density.size(); ++i) mean.density[i] += density[i];
    ++mean.segments;
  }
  for (double& value : mean.density) value /= static_cast<double>(mean.segments);
  return mean;
}

}  // namespace gem
