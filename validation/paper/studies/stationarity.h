// Whether the motion still grows: the second half of every run against its first, over the seeds of a condition.
#pragma once

#include <string>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {

enum class Growth { grows, shrinks, steady, undecided };

/// One condition: means over its seeds with their 95 % intervals (mean_of_runs; for ratios of the logarithms).
struct StationarityRow {
  std::string condition;
  std::size_t seeds = 0;
  double half_s = 0.0;             // length of each half, in whole blocks [s]
  IntervalEstimate early_swing_m;  // deviation of x within 600 s, root mean square over the first half
  IntervalEstimate late_swing_m;
  IntervalEstimate ratio_x;  // late over early, geometric mean over the seeds
  IntervalEstimate ratio_y;
  IntervalEstimate offset_shift_m;  // mean of x, late minus early
  Growth growth = Growth::undecided;
};

/// Grows if the interval of the ratio lies above 1, shrinks if below. Steady if it contains 1 and lies within 1 +-
/// kSteady. Fewer than kRunsForGrowth seeds decide nothing.
Growth judge_growth(const IntervalEstimate& ratio, std::size_t seeds);
inline constexpr std::size_t kRunsForGrowth = 4;
inline constexpr double kSteady = 0.1;
std::string growth_text(Growth growth);

/// Conditions with at least two runs of at least two blocks each.
std::vector<StationarityRow> stationarity(const PaperFolder& folder, const std::vector<std::string>& conditions);

/// One quantity of the blocks of a condition: for each block the mean over the seeds that have it, with its interval.
std::vector<IntervalEstimate> over_seeds(const std::vector<PaperRun>& runs, std::vector<double> RunBlocks::*quantity);

}  // namespace gem
