// Autocorrelation by the fast Fourier transform, and the interval of the mean.
#include "gem/analysis/statistics/correlation.h"

#include <gsl/gsl_cdf.h>

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/spectra/fourier.h"
#include "gem/analysis/statistics/moments.h"

namespace gem {

std::vector<double> autocorrelation(std::span<const double> signal, std::size_t maximum_lag) {
  if (maximum_lag >= signal.size()) throw std::invalid_argument("the largest lag is as long as the record");
  const Moments about = moments(signal);
  std::vector<double> centred(signal.begin(), signal.end());
  for (double& value : centred) value -= about.mean;
  // Padding by the largest lag keeps the end of the record from wrapping onto its start.
  Fourier fourier(next_fast_length(signal.size() + maximum_lag));
  Complexes power = fourier.forward(centred);
  for (auto& value : power) value = std::norm(value);
  const Complexes products = fourier.inverse(std::move(power));
  std::vector<double> correlation(maximum_lag + 1, 0.0);
  if (!(about.deviation > 0.0)) return correlation;
  for (std::size_t lag = 0; lag <= maximum_lag; ++lag) correlation[lag] = products[lag].real() / products[0].real();
  return correlation;
}

double effective_samples(std::span<const double> signal, std::size_t maximum_lag) {
  const std::vector<double> correlation = autocorrelation(signal, maximum_lag);
  double sum = 1.0;
  for (std::size_t lag = 1; lag < maximum_lag; ++lag)
    sum += 2.0 * (1.0 - static_cast<double>(lag) / static_cast<double>(maximum_lag)) * correlation[lag];
  return static_cast<double>(signal.size()) / sum;
}

IntervalEstimate mean_by_effective_samples(std::span<const double> signal, std::size_t maximum_lag, double confidence) {
  if (maximum_lag < 1 || signal.size() < 4 * maximum_lag)
    throw std::invalid_argument("the interval of a mean needs a record of four times the largest lag");
  const Moments about = moments(signal);
  if (!(about.deviation > 0.0)) return {about.mean, about.mean, about.mean};
  const double share = static_cast<double>(maximum_lag) / static_cast<double>(signal.size());
  // Removing the record's own mean removes this share of the variance from the weighted sum.
  const double variance = about.deviation * about.deviation / effective_samples(signal, maximum_lag) / (1.0 - share);
  const double half = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, 1.5 / share) * std::sqrt(variance);
  return {about.mean, about.mean - half, about.mean + half};
}

}  // namespace gem
