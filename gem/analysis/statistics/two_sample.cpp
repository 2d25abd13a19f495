// Tests by permutation.
#include "gem/analysis/statistics/two_sample.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "gem/analysis/statistics/random_streams.h"

namespace gem {
namespace {

double mean_of(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Chance of a statistic as large as that of (a, b) when the values are dealt anew. The data themselves count as one
/// deal, so the chance is never 0. Statistics that differ by rounding alone count as equal.
template <class Statistic>
TestResult by_permutation(std::span<const double> a, std::span<const double> b, const Resampling& resampling,
                          const Statistic& statistic) {
  if (a.size() < 2 || b.size() < 2) throw std::invalid_argument("a test of two sets needs two runs in each");
  std::vector<double> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  const auto of_deal = [&] { return statistic(std::span(all).first(a.size()), std::span(all).subspan(a.size())); };
  const double observed = of_deal();
  const double limit = std::abs(observed) * (1.0 - 1e-12);
  RandomSequence random = random_sequence(resampling.seed, AnalysisStream::permutation);
  std::size_t as_large = 1;
  for (std::size_t deal = 0; deal < resampling.count; ++deal) {
    for (std::size_t i = all.size() - 1; i > 0; --i) std::swap(all[i], all[random.below(i + 1)]);
    as_large += std::abs(of_deal()) >= limit ? 1 : 0;
  }
  return {observed, static_cast<double>(as_large) / static_cast<double>(resampling.count + 1)};
}

}  // namespace

TestResult permutation_test(std::span<const double> a, std::span<const double> b, const Resampling& resampling) {
  return by_permutation(a, b, resampling,
                        [](std::span<const double> x, std::span<const double> y) { return mean_of(y) - mean_of(x); });
}

double kolmogorov_smirnov_distance(std::span<const double> a, std::span<const double> b) {
  std::vector<double> x(a.begin(), a.end());
  std::vector<double> y(b.begin(), b.end());
  std::sort(x.begin(), x.end());
  std::sort(y.begin(), y.end());
  double largest = 0.0;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < x.size() && j < y.size()) {
    const double value = std::min(x[i], y[j]);
    while (i < x.size() && x[i] == value) ++i;
    while (j < y.size() && y[j] == value) ++j;
    largest = std::max(largest, std::abs(static_cast<double>(i) / static_cast<double>(x.size()) -
                                         static_cast<double>(j) / static_cast<double>(y.size())));
  }
  return largest;
}

TestResult kolmogorov_smirnov_test(std::span<const double> a, std::span<const double> b, const Resampling& resampling) {
  return by_permutation(a, b, resampling, kolmogorov_smirnov_distance);
}

}  // namespace gem
