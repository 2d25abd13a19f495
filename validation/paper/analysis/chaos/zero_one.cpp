// Drives the record around a circle and tests whether it spreads like a random walk.
#include "validation/paper/analysis/chaos/zero_one.h"

#include <gsl/gsl_statistics_double.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "gem/analysis/statistics/moments.h"
#include "gem/analysis/statistics/random_streams.h"

namespace gem {
namespace {

struct Walk {
  std::vector<double> p, q;
};

Walk walk_of(std::span<const double> signal, double turn) {
  Walk walk;
  double p = 0.0;
  double q = 0.0;
  for (std::size_t i = 0; i < signal.size(); ++i) {
    const double angle = turn * static_cast<double>(i + 1);
    walk.p.push_back(p += signal[i] * std::cos(angle));
    walk.q.push_back(q += signal[i] * std::sin(angle));
  }
  return walk;
}

/// Correlation of the mean squared displacement with time. The oscillating part caused by the mean of the signal is
/// known and is removed.
double growth_correlation(std::span<const double> signal, double mean, double turn) {
  const Walk walk = walk_of(signal, turn);
  const std::size_t longest = signal.size() / 10;
  const std::size_t starts = signal.size() - longest;
  std::vector<double> time;
  std::vector<double> spread;
  for (std::size_t n = 1; n <= longest; ++n) {
    double sum = 0.0;
    for (std::size_t i = 0; i < starts; ++i) {
      const double along = walk.p[i + n] - walk.p[i];
      const double across = walk.q[i + n] - walk.q[i];
      sum += along * along + across * across;
    }
    time.push_back(static_cast<double>(n));
    const double swing = mean * mean * (1.0 - std::cos(turn * static_cast<double>(n))) / (1.0 - std::cos(turn));
    spread.push_back(sum / static_cast<double>(starts) - swing);
  }
  return gsl_stats_correlation(time.data(), 1, spread.data(), 1, longest);
}

}  // namespace

ZeroOne zero_one_test(std::span<const double> signal, std::size_t frequencies, std::uint64_t seed) {
  const Moments about = moments(signal);
  if (signal.size() < 100 || !(about.deviation > 0.0) || frequencies == 0)
    throw std::invalid_argument("the 0-1 test needs 100 samples that are not all alike");
  RandomSequence random = random_sequence(seed, AnalysisStream::zero_one);
  std::vector<double> values;
  for (std::size_t f = 0; f < frequencies; ++f)
    values.push_back(growth_correlation(signal, about.mean, random.uniform(0.2, 0.8) * std::numbers::pi));
  return {percentile(values, 0.5), percentile(values, 0.25), percentile(values, 0.75)};
}

std::vector<double> every_nth(std::span<const double> signal, std::size_t n) {
  if (n == 0) throw std::invalid_argument("every sample is the smallest choice");
  std::vector<double> kept;
  for (std::size_t i = 0; i < signal.size(); i += n) kept.push_back(signal[i]);
  return kept;
}

}  // namespace gem
