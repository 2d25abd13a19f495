// Signals with known answers for the tests of the analysis.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

#include "gem/analysis/statistics/random_streams.h"

namespace gem {

inline constexpr double kTestTurn = 2.0 * std::numbers::pi;

inline RandomSequence test_random(std::uint64_t seed) { return random_sequence(seed, AnalysisStream::test_signal); }

inline std::vector<double> white_noise(std::size_t count, double deviation, std::uint64_t seed) {
  RandomSequence random = test_random(seed);
  std::vector<double> noise(count);
  for (double& value : noise) value = deviation * random.normal();
  return noise;
}

/// Red noise x[i] = memory x[i-1] + unit noise, starting in its stationary state.
inline std::vector<double> red_noise(std::size_t count, double memory, std::uint64_t seed) {
  std::vector<double> noise = white_noise(count, 1.0, seed);
  noise[0] /= std::sqrt(1.0 - memory * memory);
  for (std::size_t i = 1; i < count; ++i) noise[i] += memory * noise[i - 1];
  return noise;
}

inline std::vector<double> sine(std::size_t count, double period, double amplitude = 1.0, double phase = 0.0) {
  std::vector<double> signal(count);
  for (std::size_t i = 0; i < count; ++i)
    signal[i] = amplitude * std::sin(kTestTurn * static_cast<double>(i) / period + phase);
  return signal;
}

inline std::vector<double> sum_of(std::vector<double> a, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
  return a;
}

/// A linear oscillator driven by noise, starting at rest. Period in samples, damping as a fraction of critical.
inline std::vector<double> driven_oscillator(std::size_t count, double period, double damping, std::uint64_t seed) {
  const double keep = std::exp(-damping * kTestTurn / period);
  const double turn = kTestTurn / period * std::sqrt(1.0 - damping * damping);
  std::vector<double> signal = white_noise(count, 1e-3, seed);
  for (std::size_t i = 2; i < count; ++i)
    signal[i] += 2.0 * keep * std::cos(turn) * signal[i - 1] - keep * keep * signal[i - 2];
  return signal;
}

/// Orbit of the logistic map x -> r x (1 - x) after 1000 steps that let it settle.
inline std::vector<double> logistic_map(std::size_t count, double r, double start = 0.3) {
  std::vector<double> orbit(count);
  double x = start;
  for (int i = 0; i < 1000; ++i) x = r * x * (1.0 - x);
  for (double& value : orbit) value = x = r * x * (1.0 - x);
  return orbit;
}

}  // namespace gem
