// Chooses the samples that are drawn.
#include "gem/report/figures/series.h"

#include <algorithm>
#include <numeric>

namespace gem {

std::vector<std::size_t> envelope(std::span<const double> signal, std::size_t bins) {
  if (signal.size() <= 2 * bins) return every(signal.size(), signal.size());
  std::vector<std::size_t> kept;
  for (std::size_t b = 0; b < bins; ++b) {
    const auto begin = signal.begin() + static_cast<std::ptrdiff_t>(b * signal.size() / bins);
    const auto end = signal.begin() + static_cast<std::ptrdiff_t>((b + 1) * signal.size() / bins);
    const auto [low, high] = std::minmax_element(begin, end);
    const auto first = static_cast<std::size_t>(std::min(low, high) - signal.begin());
    const auto second = static_cast<std::size_t>(std::max(low, high) - signal.begin());
    kept.push_back(first);
    if (second != first) kept.push_back(second);
  }
  return kept;
}

std::vector<std::size_t> every(std::size_t samples, std::size_t count) {
  if (samples == 0 || count == 0) return {};
  const std::size_t stride = (samples + count - 1) / count;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < samples; i += stride) kept.push_back(i);
  if (kept.back() != samples - 1) {
    if (kept.size() == count) kept.pop_back();
    kept.push_back(samples - 1);
  }
  return kept;
}

SampleRange samples_within(std::span<const double> time, double from, double to) {
  const auto begin = std::lower_bound(time.begin(), time.end(), from);
  const auto end = std::upper_bound(begin, time.end(), to);
  return {static_cast<std::size_t>(begin - time.begin()), static_cast<std::size_t>(end - time.begin())};
}

}  // namespace gem
