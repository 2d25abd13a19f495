// Amplitude and frequency of a narrow-band record at every moment, by the Hilbert transform.
#pragma once

#include <span>
#include <vector>

namespace gem {

/// The record between `low` and `high` as amplitude cos(phase).
struct HilbertEnvelope {
  std::vector<double> amplitude;  // [unit]
  std::vector<double> frequency;  // rate of the phase over one sample each side [Hz]
};

/// Keeps the frequencies from `low` to `high` [Hz] of the mean-removed record, sharply, and returns the amplitude and
/// frequency of what is left. About 1 / (high - low) seconds at each end are disturbed by the record's end. Throws
/// std::invalid_argument unless 0 < low < high and there are 16 samples.
HilbertEnvelope hilbert_envelope(std::span<const double> signal, double interval_s, double low, double high);

/// How the frequency follows the amplitude: the mean frequency, weighted by amplitude squared, of the samples in each
/// of `classes` amplitude classes with equally many samples.
struct BackbonePoint {
  double amplitude = 0.0;  // mean of the class [unit]
  double frequency = 0.0;  // [Hz]
};
std::vector<BackbonePoint> backbone(const HilbertEnvelope& envelope, std::size_t classes);

}  // namespace gem
