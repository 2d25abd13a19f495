// Amplitude and frequency of signals whose envelope is known.
#include "gem/analysis/spectra/hilbert.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "gem/analysis/test_signals.h"

namespace gem {
namespace {

// Whole cycles of carrier and modulation: the transform is exact.
TEST(HilbertEnvelope, OfAModulatedSine) {
  std::vector<double> signal = sine(4000, 50.0);
  for (std::size_t i = 0; i < signal.size(); ++i)
    signal[i] = 5.0 + signal[i] * (2.0 + std::cos(kTestTurn * static_cast<double>(i) / 1000.0));
  const HilbertEnvelope envelope = hilbert_envelope(signal, 0.5, 0.02, 0.06);
  for (std::size_t i = 1; i + 1 < signal.size(); ++i) {
    EXPECT_NEAR(envelope.amplitude[i], 2.0 + std::cos(kTestTurn * static_cast<double>(i) / 1000.0), 1e-10);
    EXPECT_NEAR(envelope.frequency[i], 0.04, 1e-10);
  }
}

TEST(HilbertEnvelope, KeepsOnlyItsBand) {
  const std::vector<double> signal = sum_of(sine(4000, 50.0), sine(4000, 8.0, 3.0));
  EXPECT_NEAR(hilbert_envelope(signal, 1.0, 0.01, 0.04).amplitude[2000], 1.0, 1e-10);
  EXPECT_THROW(hilbert_envelope(signal, 1.0, 0.0, 0.04), std::invalid_argument);
  EXPECT_THROW(hilbert_envelope(signal, 1.0, 0.04, 0.04), std::invalid_argument);
}

// A stiffening spring: the frequency rises from 0.010 to 0.012 Hz while the amplitude grows from 1 to 3 over 20 cycles.
// Amplitude and frequency of a slowly changing signal have an error of order (change per cycle)^2.
TEST(Backbone, FollowsTheAmplitude) {
  std::vector<double> signal(20000);
  double turns = 0.0;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double amplitude = 2.0 - std::cos(kTestTurn * static_cast<double>(i) / 20000.0);
    turns += 0.1 * (0.009 + 0.001 * amplitude);
    signal[i] = amplitude * std::cos(kTestTurn * turns);
  }
  const auto points = backbone(hilbert_envelope(signal, 0.1, 0.005, 0.02), 4);
  ASSERT_EQ(points.size(), 4u);
  for (const BackbonePoint& point : points) EXPECT_NEAR(point.frequency, 0.009 + 0.001 * point.amplitude, 2e-4);
  EXPECT_GT(points.back().frequency - points.front().frequency, 1e-3);
}

}  // namespace
}  // namespace gem
