// How much of the scatter of a result a linear trend in each input explains.
#pragma once

#include <vector>

#include "gem/analysis/sensitivity/input_runs.h"
#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// One input in a linear regression on all inputs. `coefficient` is standardised: deviations of the output for one
/// deviation of the input. Its square is the share of the variance, if inputs are independent. The interval of a share
/// begins at 0 if that of the coefficient holds 0.
struct TrendShare {
  IntervalEstimate coefficient;
  IntervalEstimate share;
};

struct TrendShares {
  std::vector<TrendShare> inputs;
  double explained = 0.0;  // by all trends together: R squared, adjusted for their number; may be below 0
};

/// The fewest draws for trends. With fewer a resample, in which a third of the draws is missing, may hardly tell inputs
/// apart, and intervals say nothing.
inline std::size_t draws_for_trends(std::size_t inputs) { return 3 * inputs + 5; }

/// Least squares with intervals by the bootstrap over draws. With ranked() runs: shares by monotone trends. Zeros if
/// all outputs are equal. Throws std::invalid_argument without inputs or with fewer draws than draws_for_trends().
TrendShares trend_shares(const DrawnRuns& runs, const Resampling& resampling = {});

}  // namespace gem
