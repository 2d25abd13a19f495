// Intervals by resampling: whole runs if there are several, blocks of one record if there is one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

struct Resampling {
  std::size_t count = 1000;  // number of resamples
  double confidence = 0.95;  // of the interval
  std::uint64_t seed = 1;    // the same seed gives the same interval
};

/// A statistic of the runs with the given numbers. In a resample some runs occur twice and some not at all.
using RunStatistic = std::function<double(std::span<const std::size_t> runs)>;
using ValueStatistic = std::function<double(std::span<const double> values)>;

/// Bootstrap over `runs` independent runs: the statistic of all runs and its percentile interval, widened for few runs
/// as Student's t widens a normal interval. The statistic must be finite for every resample. Throws
/// std::invalid_argument with fewer than two runs or ten resamples.
IntervalEstimate bootstrap(std::size_t runs, const RunStatistic& statistic, const Resampling& resampling = {});

/// Several statistics of one fit, so that each resample is fitted once.
using RunStatistics = std::function<std::vector<double>(std::span<const std::size_t> runs)>;
std::vector<IntervalEstimate> bootstrap_together(std::size_t runs, const RunStatistics& statistics,
                                                 const Resampling& resampling = {});

/// Bootstrap over runs that are one number each.
IntervalEstimate bootstrap_values(std::span<const double> values, const ValueStatistic& statistic,
                                  const Resampling& resampling = {});

/// From this number of runs on the interval of a mean comes from resampling. With fewer runs percentiles cannot reach
/// beyond the runs themselves: for two runs they contain the true mean in only half of all cases.
inline constexpr std::size_t kRunsForBootstrap = 10;

/// Mean of independent runs and its 95 % interval. Below kRunsForBootstrap runs Student's t, which assumes normal runs;
/// above, the bootstrap. Throws std::invalid_argument with fewer than two runs.
IntervalEstimate mean_of_runs(std::span<const double> values);

/// Mean of one correlated record by the moving-block bootstrap (Kuensch 1989). A block of `block` samples must be
/// several correlation times long. Throws std::invalid_argument with fewer than two blocks.
IntervalEstimate moving_block_mean(std::span<const double> signal, std::size_t block,
                                   const Resampling& resampling = {});

}  // namespace gem
