// Alternating between the spectrum and the values until both fit.
#include "validation/paper/analysis/chaos/surrogates.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/spectra/fourier.h"
#include "gem/analysis/statistics/random_streams.h"

namespace gem {
namespace {

std::vector<std::size_t> ascending(std::span<const double> values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  return order;
}

std::vector<double> shuffled(std::span<const double> signal, std::uint64_t seed) {
  std::vector<double> values(signal.begin(), signal.end());
  RandomSequence random = random_sequence(seed, AnalysisStream::surrogate);
  for (std::size_t i = values.size() - 1; i > 0; --i) std::swap(values[i], values[random.below(i + 1)]);
  return values;
}

}  // namespace

std::vector<double> surrogate(std::span<const double> signal, std::uint64_t seed, std::size_t iterations) {
  if (signal.size() < 16) throw std::invalid_argument("a surrogate needs 16 samples");
  Fourier fourier(signal.size());
  std::vector<double> size;
  for (const auto& value : fourier.forward(signal)) size.push_back(std::abs(value));
  std::vector<double> sorted(signal.begin(), signal.end());
  std::sort(sorted.begin(), sorted.end());
  std::vector<double> values = shuffled(signal, seed);
  std::vector<std::size_t> before;
  for (std::size_t pass = 0; pass < iterations; ++pass) {
    Complexes spectrum = fourier.forward(values);
    for (std::size_t k = 0; k < spectrum.size(); ++k) {
      const double now = std::abs(spectrum[k]);
      spectrum[k] = now > 0.0 ? spectrum[k] * (size[k] / now) : size[k];
    }
    const Complexes filtered = fourier.inverse(std::move(spectrum));
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = filtered[i].real();
    const std::vector<std::size_t> order = ascending(values);
    for (std::size_t i = 0; i < order.size(); ++i) values[order[i]] = sorted[i];
    if (order == before) break;
    before = order;
  }
  return values;
}

double SurrogateTest::two_sided() const { return std::min(1.0, 2.0 * std::min(p_low, p_high)); }

std::vector<double> end_matched(std::span<const double> signal, std::size_t length) {
  if (length < 2 || signal.size() < length + 2) throw std::invalid_argument("the record is too short for its stretch");
  const auto jump = [&](std::size_t begin) {
    const double value = signal[begin + length] - signal[begin];
    const double slope = value - (signal[begin + length - 1] - signal[begin - 1]);
    return value * value + slope * slope;
  };
  std::size_t best = 1;
  for (std::size_t begin = 2; begin + length < signal.size(); ++begin)
    if (jump(begin) < jump(best)) best = begin;
  const auto first = signal.begin() + static_cast<std::ptrdiff_t>(best);
  return {first, first + static_cast<std::ptrdiff_t>(length)};
}

SurrogateTest test_against(std::span<const double> signal, const SignalStatistic& statistic,
                           const SignalGenerator& generator, std::size_t count, std::uint64_t seed) {
  SurrogateTest test;
  test.observed = statistic(signal);
  std::size_t as_small = 1;
  std::size_t as_large = 1;
  for (std::size_t i = 0; i < count; ++i) {
    test.surrogates.push_back(statistic(generator(seed + i)));
    as_small += test.surrogates.back() <= test.observed ? 1 : 0;
    as_large += test.surrogates.back() >= test.observed ? 1 : 0;
  }
  test.p_low = static_cast<double>(as_small) / static_cast<double>(count + 1);
  test.p_high = static_cast<double>(as_large) / static_cast<double>(count + 1);
  return test;
}

SurrogateTest surrogate_test(std::span<const double> signal, const SignalStatistic& statistic, std::size_t count,
                             std::uint64_t seed) {
  return test_against(
      signal, statistic, [signal](std::uint64_t each) { return surrogate(signal, each); }, count, seed);
}

}  // namespace gem
