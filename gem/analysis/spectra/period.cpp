// Periods by spectral peaks, zero crossings and local maxima.
#include "gem/analysis/spectra/period.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gem/analysis/statistics/correlation.h"

namespace gem {
namespace {

/// Index of the largest density outside the lobe around zero frequency.
std::size_t strongest(const Spectrum& spectrum) {
  const auto first = static_cast<std::size_t>(std::ceil(2.0 * spectrum.half_bandwidth / spectrum.step));
  if (first >= spectrum.density.size()) return 0;
  const auto from = spectrum.density.begin() + static_cast<std::ptrdiff_t>(first);
  return static_cast<std::size_t>(std::max_element(from, spectrum.density.end()) - spectrum.density.begin());
}

/// Power-weighted mean frequency within twice the half-bandwidth around `middle` [Hz].
double lobe_centre(const Spectrum& spectrum, double middle) {
  const double reach = 2.0 * spectrum.half_bandwidth;
  const auto begin = static_cast<std::size_t>(std::ceil(std::max(0.0, middle - reach) / spectrum.step));
  const auto end = std::min(spectrum.density.size(), static_cast<std::size_t>((middle + reach) / spectrum.step) + 1);
  double power = 0.0;
  double moment = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    power += spectrum.density[i];
    moment += spectrum.density[i] * spectrum.frequency(i);
  }
  return moment / power;
}

/// Centred twice: the maximum may lie anywhere on the flat top, the second window is centred on the lobe.
double peak_frequency(const Spectrum& spectrum, std::size_t maximum) {
  return lobe_centre(spectrum, lobe_centre(spectrum, spectrum.frequency(maximum)));
}

/// Half width of the 95 % interval of the peak's frequency, by the jackknife over tapers [Hz].
double jackknife_half_width(const std::vector<Spectrum>& spectra) {
  const auto count = static_cast<double>(spectra.size());
  std::vector<double> left_out;
  for (std::size_t s = 0; s < spectra.size(); ++s) {
    const Spectrum rest = mean_spectrum(spectra, s);
    left_out.push_back(peak_frequency(rest, strongest(rest)));
  }
  const double mean = std::accumulate(left_out.begin(), left_out.end(), 0.0) / count;
  double squares = 0.0;
  for (const double value : left_out) squares += (value - mean) * (value - mean);
  return gsl_cdf_tdist_Pinv(0.975, count - 1.0) * std::sqrt(squares * (count - 1.0) / count);
}

/// Times at which the mean-removed record crosses zero upwards [s].
std::vector<double> crossing_times(std::span<const double> signal, double interval_s) {
  if (signal.empty()) return {};
  const double mean = std::accumulate(signal.begin(), signal.end(), 0.0) / static_cast<double>(signal.size());
  std::vector<double> times;
  for (std::size_t i = 1; i < signal.size(); ++i) {
    const double before = signal[i - 1] - mean;
    const double after = signal[i] - mean;
    if (before < 0.0 && after >= 0.0) times.push_back((static_cast<double>(i) - after / (after - before)) * interval_s);
  }
  return times;
}

/// Times at which the record turns from rising to falling [s].
std::vector<double> maxima_times(std::span<const double> signal, double interval_s) {
  std::vector<double> times;
  bool rising = false;
  for (std::size_t i = 1; i < signal.size(); ++i) {
    if (signal[i] < signal[i - 1] && rising) times.push_back(static_cast<double>(i - 1) * interval_s);
    // A level stretch keeps the direction, so a flat top is one maximum.
    if (signal[i] != signal[i - 1]) rising = signal[i] > signal[i - 1];
  }
  return times;
}

constexpr std::size_t kFewestGaps = 20;

std::optional<PeriodEstimate> mean_gap(const std::vector<double>& times) {
  if (times.size() <= kFewestGaps) return std::nullopt;
  std::vector<double> gaps;
  for (std::size_t i = 1; i < times.size(); ++i) gaps.push_back(times[i] - times[i - 1]);
  // A crossing measured late makes one interval long and the next short. Neighbours are correlated, distant intervals
  // are not.
  const auto lag = static_cast<std::size_t>(std::sqrt(static_cast<double>(gaps.size())));
  const IntervalEstimate mean = mean_by_effective_samples(gaps, lag);
  return PeriodEstimate{mean.value, mean.low, mean.high};
}

}  // namespace

std::optional<PeriodEstimate> spectral_period(const std::vector<Spectrum>& eigenspectra) {
  if (eigenspectra.size() < 2) return std::nullopt;
  const Spectrum mean = mean_spectrum(eigenspectra);
  const std::size_t maximum = strongest(mean);
  if (maximum == 0 || !(mean.density[maximum] > 0.0)) return std::nullopt;
  const double frequency = peak_frequency(mean, maximum);
  // The lobe must not reach zero frequency, where a drift would shift its centre.
  if (frequency < 2.0 * mean.half_bandwidth) return std::nullopt;
  const double half_width = jackknife_half_width(eigenspectra) + 0.5 / mean.duration;
  return PeriodEstimate{1.0 / frequency, 1.0 / (frequency + half_width),
                        1.0 / std::max(frequency - half_width, 0.5 / mean.duration)};
}

std::optional<PeriodEstimate> crossing_period(std::span<const double> signal, double interval_s) {
  return mean_gap(crossing_times(signal, interval_s));
}

std::optional<PeriodEstimate> maxima_period(std::span<const double> signal, double interval_s) {
  return mean_gap(maxima_times(signal, interval_s));
}

}  // namespace gem
