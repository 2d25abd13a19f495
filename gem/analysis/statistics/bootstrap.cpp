// Resampling with fixed seeds.
#include "gem/analysis/statistics/bootstrap.h"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_statistics_double.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "gem/analysis/statistics/random_streams.h"

namespace gem {
namespace {

/// The share to cut off at each end. Resampled means of n values have a deviation too small by sqrt((n - 1) / n) and
/// normal tails. The smaller share makes the interval of a mean as wide as Student's.
double tail(double confidence, std::size_t independent) {
  const auto n = static_cast<double>(independent);
  const double student = gsl_cdf_tdist_Pinv(0.5 + 0.5 * confidence, n - 1.0);
  return gsl_cdf_ugaussian_P(-std::sqrt(n / (n - 1.0)) * student);
}

void check(const Resampling& resampling, std::size_t independent, const char* what) {
  if (independent < 2) throw std::invalid_argument(what);
  if (resampling.count < 10) throw std::invalid_argument("a bootstrap needs at least ten resamples");
  if (!(resampling.confidence > 0.0 && resampling.confidence < 1.0))
    throw std::invalid_argument("the confidence must lie between 0 and 1");
}

double quantile(const std::vector<double>& sorted, double p) {
  return gsl_stats_quantile_from_sorted_data(sorted.data(), 1, sorted.size(), p);
}

}  // namespace

std::vector<IntervalEstimate> bootstrap_together(std::size_t runs, const RunStatistics& statistics,
                                                 const Resampling& resampling) {
  check(resampling, runs, "a bootstrap over runs needs two runs");
  std::vector<std::size_t> chosen(runs);
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  const std::vector<double> values = statistics(chosen);
  std::vector<std::vector<double>> resampled(values.size());
  RandomSequence random = random_sequence(resampling.seed, AnalysisStream::bootstrap);
  for (std::size_t b = 0; b < resampling.count; ++b) {
    for (std::size_t& run : chosen) run = random.below(runs);
    const std::vector<double> again = statistics(chosen);
    for (std::size_t s = 0; s < values.size(); ++s) resampled[s].push_back(again[s]);
  }
  const double cut = tail(resampling.confidence, runs);
  std::vector<IntervalEstimate> estimates;
  for (std::size_t s = 0; s < values.size(); ++s) {
    std::sort(resampled[s].begin(), resampled[s].end());
    estimates.push_back({values[s], quantile(resampled[s], cut), quantile(resampled[s], 1.0 - cut)});
  }
  return estimates;
}

IntervalEstimate bootstrap(std::size_t runs, const RunStatistic& statistic, const Resampling& resampling) {
  return bootstrap_together(
             runs, [&](std::span<const std::size_t> chosen) { return std::vector<double>{statistic(chosen)}; },
             resampling)
      .front();
}

IntervalEstimate bootstrap_values(std::span<const double> values, const ValueStatistic& statistic,
                                  const Resampling& resampling) {
  std::vector<double> resample(values.size());
  return bootstrap(
      values.size(),
      [&](std::span<const std::size_t> runs) {
        for (std::size_t i = 0; i < runs.size(); ++i) resample[i] = values[runs[i]];
        return statistic(resample);
      },
      resampling);
}

IntervalEstimate mean_of_runs(std::span<const double> values) {
  const auto mean = [](std::span<const double> chosen) { return gsl_stats_mean(chosen.data(), 1, chosen.size()); };
  if (values.size() >= kRunsForBootstrap) return bootstrap_values(values, mean);
  if (values.size() < 2) throw std::invalid_argument("an interval over runs needs two runs");
  const auto n = static_cast<double>(values.size());
  const double error = gsl_stats_sd(values.data(), 1, values.size()) / std::sqrt(n);
  const double half = gsl_cdf_tdist_Pinv(0.975, n - 1.0) * error;
  return {mean(values), mean(values) - half, mean(values) + half};
}

IntervalEstimate moving_block_mean(std::span<const double> signal, std::size_t block, const Resampling& resampling) {
  const std::size_t blocks = block == 0 ? 0 : signal.size() / block;
  check(resampling, blocks, "a moving-block bootstrap needs two blocks");
  std::vector<double> sum(signal.size() + 1, 0.0);
  std::partial_sum(signal.begin(), signal.end(), sum.begin() + 1);
  const std::size_t starts = signal.size() - block + 1;
  std::vector<double> means;
  RandomSequence random = random_sequence(resampling.seed, AnalysisStream::moving_blocks);
  for (std::size_t b = 0; b < resampling.count; ++b) {
    double total = 0.0;
    for (std::size_t k = 0; k < blocks; ++k) {
      const std::size_t begin = random.below(starts);
      total += sum[begin + block] - sum[begin];
    }
    means.push_back(total / static_cast<double>(blocks * block));
  }
  std::sort(means.begin(), means.end());
  const double value = sum.back() / static_cast<double>(signal.size());
  // Blocks favour the middle of the record, so the resampled means have another centre. Only their scatter is used.
  const double centre = gsl_stats_mean(means.data(), 1, means.size());
  const double cut = tail(resampling.confidence, blocks);
  return {value, value + quantile(means, cut) - centre, value + quantile(means, 1.0 - cut) - centre};
}

}  // namespace gem
