// The uncertainty of spectral densities.
#include "gem/analysis/spectra/spectrum_interval.h"

#include <gsl/gsl_cdf.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gem {
namespace {

/// Half width of the interval of ln(density) at frequency `i`, from leaving out each taper in turn.
double jackknife_half_width(const std::vector<Spectrum>& spectra, std::size_t i, double quantile) {
  const auto count = static_cast<double>(spectra.size());
  double all = 0.0;
  for (const Spectrum& spectrum : spectra) all += spectrum.density[i];
  double sum = 0.0;
  double squares = 0.0;
  for (const Spectrum& spectrum : spectra) {
    const double value = std::log((all - spectrum.density[i]) / (count - 1.0));
    sum += value;
    squares += value * value;
  }
  const double scatter = std::max(0.0, squares - sum * sum / count);
  return quantile * std::sqrt(scatter * (count - 1.0) / count);
}

/// Hann segments that overlap by half share 1/6 of their amplitude, so neighbours correlate by 1/36 (Welch 1967).
double welch_degrees(double segments) { return 2.0 * segments / (1.0 + 2.0 * (segments - 1.0) / segments / 36.0); }

}  // namespace

SpectrumInterval multitaper_interval(std::span<const double> signal, double interval_s,
                                     const MultitaperOptions& options, double confidence) {
  if (options.taper_count < 2) throw std::invalid_argument("a jackknife needs two tapers");
  const std::vector<Spectrum> spectra = eigenspectra(signal, interval_s, options);
  SpectrumInterval result{mean_spectrum(spectra), {}, {}, 2.0 * static_cast<double>(spectra.size())};
  const double quantile = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, static_cast<double>(spectra.size()) - 1.0);
  for (std::size_t i = 0; i < result.spectrum.density.size(); ++i) {
    const double density = result.spectrum.density[i];
    const double factor = density > 0.0 ? std::exp(jackknife_half_width(spectra, i, quantile)) : 1.0;
    result.low.push_back(density / factor);
    result.high.push_back(density * factor);
  }
  return result;
}

SpectrumInterval welch_interval(std::span<const double> signal, double interval_s, double segment_s,
                                double confidence) {
  SpectrumInterval result{welch(signal, interval_s, segment_s), {}, {}, 0.0};
  result.degrees = welch_degrees(static_cast<double>(result.spectrum.segments));
  const double low = result.degrees / gsl_cdf_chisq_Pinv(0.5 + 0.5 * confidence, result.degrees);
  const double high = result.degrees / gsl_cdf_chisq_Pinv(0.5 - 0.5 * confidence, result.degrees);
  for (const double density : result.spectrum.density) {
    result.low.push_back(density * low);
    result.high.push_back(density * high);
  }
  return result;
}

}  // namespace gem
