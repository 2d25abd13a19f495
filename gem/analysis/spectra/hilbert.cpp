// The analytic signal of a frequency band.
#include "gem/analysis/spectra/hilbert.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/spectra/fourier.h"
#include "gem/analysis/statistics/moments.h"

namespace gem {
namespace {

/// The band from low to high without negative frequencies; its modulus is the amplitude.
Complexes analytic_signal(std::span<const double> signal, double interval_s, double low, double high) {
  std::vector<double> centred(signal.begin(), signal.end());
  const double mean = moments(signal).mean;
  for (double& value : centred) value -= mean;
  const std::size_t padded = next_fast_length(signal.size());
  Fourier fourier(padded);
  Complexes values = fourier.forward(centred);
  const double step = 1.0 / (static_cast<double>(padded) * interval_s);
  for (std::size_t k = 0; k < padded; ++k) {
    const double frequency = step * static_cast<double>(k);
    const bool kept = 2 * k < padded && frequency >= low && frequency <= high;
    values[k] *= kept ? 2.0 : 0.0;
  }
  values = fourier.inverse(std::move(values));
  values.resize(signal.size());
  return values;
}

}  // namespace

HilbertEnvelope hilbert_envelope(std::span<const double> signal, double interval_s, double low, double high) {
  if (signal.size() < 16 || !(interval_s > 0.0) || !(low > 0.0) || !(high > low))
    throw std::invalid_argument("an envelope needs 16 samples, a positive interval and a band above zero");
  const Complexes analytic = analytic_signal(signal, interval_s, low, high);
  HilbertEnvelope envelope;
  for (std::size_t i = 0; i < analytic.size(); ++i) {
    const std::size_t before = i == 0 ? 0 : i - 1;
    const std::size_t after = std::min(i + 1, analytic.size() - 1);
    const double turned = std::arg(analytic[after] * std::conj(analytic[before]));
    envelope.amplitude.push_back(std::abs(analytic[i]));
    envelope.frequency.push_back(turned / (2.0 * std::numbers::pi * static_cast<double>(after - before) * interval_s));
  }
  return envelope;
}

std::vector<BackbonePoint> backbone(const HilbertEnvelope& envelope, std::size_t classes) {
  if (classes == 0 || envelope.amplitude.size() < classes)
    throw std::invalid_argument("a backbone needs a sample in every class");
  std::vector<std::size_t> order(envelope.amplitude.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return envelope.amplitude[a] < envelope.amplitude[b]; });
  std::vector<BackbonePoint> points;
  for (std::size_t c = 0; c < classes; ++c) {
    const std::size_t begin = c * order.size() / classes;
    const std::size_t end = (c + 1) * order.size() / classes;
    double sum = 0.0;
    double weight = 0.0;
    double turns = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double amplitude = envelope.amplitude[order[i]];
      sum += amplitude;
      weight += amplitude * amplitude;
      turns += amplitude * amplitude * envelope.frequency[order[i]];
    }
    points.push_back({sum / static_cast<double>(end - begin), weight > 0.0 ? turns / weight : 0.0});
  }
  return points;
}

}  // namespace gem
