// Intervals by resampling: whole runs where there are several, blocks of one record where there is only one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

struct Resampling {
  std::size_t count = 1000;  // resamples
  double confidence = 0.95;  // of the interval
  std::uint64_t seed = 1;    // the same seed gives the same interval
};

/// A statistic of the runs whose numbers are given; a resample names some runs twice and some not at all.
using RunStatistic = std::function<double(std::span<const std::size_t> runs)>;
using ValueStatistic = std::function<double(std::span<const double> values)>;

/// Bootstrap over `runs` independent runs: the statistic of all runs and its percentile interval, widened for few runs
/// as Student's t widens a normal interval. The statistic must be finite for every resample. Needs two runs and ten
/// resamples, otherwise std::invalid_argument.
IntervalEstimate bootstrap(std::size_t runs, const RunStatistic& statistic, const Resampling& resampling = {});

/// The same for several numbers of one fit, so that each resample is fitted once.
using RunStatistics = std::function<std::vector<double>(std::span<const std::size_t> runs)>;
std::vector<IntervalEstimate> bootstrap_together(std::size_t runs, const RunStatistics& statistics,
                                                 const Resampling& resampling = {});

/// The same where each run is one number.
IntervalEstimate bootstrap_values(std::span<const double> values, const ValueStatistic& statistic,
                                  const Resampling& resampling = {});

/// From this many runs on the interval of a mean comes from resampling: percentiles of fewer cannot reach beyond the
/// runs themselves, and hold the truth of two in one half of all cases only.
inline constexpr std::size_t kRunsForBootstrap = 10;

/// Mean of independent runs with its interval of 95 %: Student's t below kRunsForBootstrap runs, which takes them as
/// normal, the bootstrap from there on. Needs two runs, otherwise std::invalid_argument.
IntervalEstimate mean_of_runs(std::span<const double> values);

/// Mean of one correlated record by the moving-block bootstrap (Kuensch 1989). A block of `block` samples must be
/// several correlation times long. Needs two blocks, otherwise std::invalid_argument.
IntervalEstimate moving_block_mean(std::span<const double> signal, std::size_t block,
                                   const Resampling& resampling = {});

}  // namespace gem
