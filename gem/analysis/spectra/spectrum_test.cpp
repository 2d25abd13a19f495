// Tapers, spectra and spectral periods on signals whose spectrum is known.
#include "gem/analysis/spectra/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "gem/analysis/spectra/period.h"
#include "gem/analysis/spectra/tapers.h"

namespace gem {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double dot_product(const std::vector<double>& a, const std::vector<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::vector<double> normal_noise(std::size_t count, double deviation, unsigned seed) {
  std::mt19937_64 bits(seed);
  std::normal_distribution<double> normal(0.0, deviation);
  std::vector<double> noise(count);
  for (double& value : noise) value = normal(bits);
  return noise;
}

TEST(SlepianTapers, AreOrthonormal) {
  for (const std::size_t length : {64u, 1001u, 20000u}) {
    const auto tapers = slepian_tapers(length, 2.5, 4);
    ASSERT_EQ(tapers.size(), 4u);
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b)
        // Rounding in the matrix grows as length^2 eps against gaps of order one: 1e-7 at length 20000.
        EXPECT_NEAR(dot_product(tapers[a], tapers[b]), a == b ? 1.0 : 0.0, 1e-6) << length << ' ' << a << b;
  }
}

// Independent of the tridiagonal matrix: tapers are eigenvectors of the sinc kernel; the eigenvalue is the share of the
// energy inside the band.
TEST(SlepianTapers, SolveTheConcentrationProblem) {
  const std::size_t n = 128;
  const double half_band = 2.5 / static_cast<double>(n);
  const auto tapers = slepian_tapers(n, 2.5, 4);
  double previous = 1.0;
  for (const std::vector<double>& taper : tapers) {
    std::vector<double> image(n, 0.0);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const double lag = static_cast<double>(i) - static_cast<double>(j);
        const double kernel = i == j ? 2.0 * half_band : std::sin(kTurn * half_band * lag) / (std::numbers::pi * lag);
        image[i] += kernel * taper[j];
      }
    const double share = dot_product(image, taper);
    EXPECT_LT(share, previous);
    EXPECT_GT(share, 0.7);
    for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(image[i], share * taper[i], 1e-10);
    previous = share;
  }
}

// Parseval: with unit-energy windows the density integrates exactly to the energy of the windowed signal.
TEST(Multitaper, IntegratesToTheWindowedEnergy) {
  const std::vector<double> noise = normal_noise(1000, 1.0, 7);
  const double mean = std::accumulate(noise.begin(), noise.end(), 0.0) / 1000.0;
  const auto tapers = slepian_tapers(1000, 2.5, 4);
  double energy = 0.0;
  for (const std::vector<double>& taper : tapers)
    for (std::size_t i = 0; i < noise.size(); ++i) energy += std::pow((noise[i] - mean) * taper[i], 2) / 4.0;
  const Spectrum spectrum = mean_spectrum(eigenspectra(noise, 0.25));
  const double variance = std::accumulate(spectrum.density.begin(), spectrum.density.end(), 0.0) * spectrum.step;
  EXPECT_NEAR(variance, energy, 1e-12 * energy);
}

TEST(Multitaper, GivesTheLevelOfWhiteNoise) {
  const double interval = 0.5;
  const Spectrum spectrum = mean_spectrum(eigenspectra(normal_noise(16384, 3.0, 11), interval));
  // The one-sided level is 2 sigma^2 dt. The mean over 16384 / 2 independent bins has a relative deviation of about 1
  // %.
  double level = 0.0;
  for (const double value : spectrum.density) level += value / static_cast<double>(spectrum.density.size());
  EXPECT_NEAR(level, 2.0 * 9.0 * interval, 0.04 * 9.0);
}

TEST(SpectralPeriod, FindsALineInNoise) {
  // 2 h at 1 Hz, signal as strong as the noise: the period of a platform of 1e5 t on 500 kN/m.
  const double period = 88.8577;
  std::vector<double> signal = normal_noise(7200, 1.0, 5);
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] += std::sin(kTurn * static_cast<double>(i) / period + 0.3);
  const auto estimate = spectral_period(eigenspectra(signal, 1.0));
  ASSERT_TRUE(estimate.has_value());
  EXPECT_LT(estimate->low, period);
  EXPECT_GT(estimate->high, period);
  // The interval is narrow enough to be useful: 72 s lies far outside.
  EXPECT_GT(estimate->low, 85.0);
  EXPECT_LT(estimate->high, 93.0);
}

TEST(SpectralPeriod, FindsALineForAnyPhase) {
  for (int phase = 0; phase < 8; ++phase) {
    std::vector<double> signal(2400);
    for (std::size_t i = 0; i < signal.size(); ++i)
      signal[i] = std::sin(kTurn * static_cast<double>(i) / 88.8577 + 0.7 * phase);
    const auto estimate = spectral_period(eigenspectra(signal, 1.0));
    ASSERT_TRUE(estimate.has_value());
    // Well within half a resolution cell: 88.86^2 / 4800 = 1.6 s.
    EXPECT_NEAR(estimate->period, 88.8577, 0.5) << phase;
    EXPECT_LT(estimate->low, 88.8577);
    EXPECT_GT(estimate->high, 88.8577);
  }
}

TEST(SpectralPeriod, FindsTheDampedPeriodOfAnOscillator) {
  const double natural = kTurn / 72.0;
  const double ratio = 0.02;
  const double damped = natural * std::sqrt(1.0 - ratio * ratio);
  std::vector<double> signal(40000);
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double time = 0.1 * static_cast<double>(i);
    signal[i] = std::exp(-ratio * natural * time) * std::cos(damped * time);
  }
  const auto estimate = spectral_period(eigenspectra(signal, 0.1));
  ASSERT_TRUE(estimate.has_value());
  EXPECT_LT(estimate->low, kTurn / damped);
  EXPECT_GT(estimate->high, kTurn / damped);
}

TEST(SpectralPeriod, IsEmptyWithoutASignal) {
  EXPECT_FALSE(spectral_period(eigenspectra(std::vector<double>(500, 2.5), 0.1)).has_value());
}

TEST(SpectralPeriod, IsEmptyWithTooFewCycles) {
  std::vector<double> signal(3600);
  for (std::size_t i = 0; i < signal.size(); ++i)
    signal[i] = 1e-4 * static_cast<double>(i) + std::sin(kTurn * static_cast<double>(i) / 900.0);
  EXPECT_FALSE(spectral_period(eigenspectra(signal, 0.1)).has_value());
}

}  // namespace
}  // namespace gem
