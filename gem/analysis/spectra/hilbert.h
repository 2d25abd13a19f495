// Instantaneous amplitude and frequency of a narrow-band record by the Hilbert transform.
#pragma once

#include <span>
#include <vector>

namespace gem {

/// The record between the frequencies `low` and `high`, written as amplitude * cos(phase).
struct HilbertEnvelope {
  std::vector<double> amplitude;  // [unit]
  std::vector<double> frequency;  // change of the phase from one sample before to one sample after [Hz]
};

/// Keeps only the frequencies from `low` to `high` [Hz] of the mean-removed record and returns the amplitude and
/// frequency of the result. About 1 / (high - low) seconds at each end are disturbed by the ends of the record. Throws
/// std::invalid_argument unless 0 < low < high and there are 16 samples.
HilbertEnvelope hilbert_envelope(std::span<const double> signal, double interval_s, double low, double high);

/// Frequency over amplitude. The samples are divided into `classes` amplitude classes of equal size; each gives its
/// mean amplitude and its mean frequency, weighted by amplitude squared.
struct BackbonePoint {
  double amplitude = 0.0;  // mean of the class [unit]
  double frequency = 0.0;  // [Hz]
};
std::vector<BackbonePoint> backbone(const HilbertEnvelope& envelope, std::size_t classes);

}  // namespace gem
