// Sobol indices: shares of the variance without an assumption about the form of the dependence.
//
// First-order index of an input: Var(E[y | input]) / Var(y), what it explains alone. Total index:
// E[Var(y | all others)] / Var(y), what it explains alone and together with others.
#pragma once

#include <vector>

#include "gem/analysis/sensitivity/input_runs.h"
#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

struct SobolIndex {
  IntervalEstimate first, total;
};

/// Both indices of each input from a Saltelli design, by correlations (Martinez 2011): first = corr(y_B, y_AB),
/// total = 1 - corr(y_A, y_AB). Intervals by the bootstrap over draws. Throws std::invalid_argument with fewer than
/// three draws or columns of unequal length.
std::vector<SobolIndex> sobol_indices(const SaltelliRuns& runs, const Resampling& resampling = {});

/// The fewest draws from which first_order_indices() says anything.
inline constexpr std::size_t kDrawsForFirstOrder = 40;

/// First-order index of each input from any independent draws, by the correlation of outputs that are neighbours in the
/// order of the input (Chatterjee 2021; Gamboa, Gremaud, Klein and Lagnoux 2022). Repeats of a draw count by their
/// mean, and the variance is that of single runs. Intervals: scatter of half samples, which have no run twice. Throws
/// std::invalid_argument with fewer than kDrawsForFirstOrder draws.
std::vector<IntervalEstimate> first_order_indices(const DrawnRuns& runs, const Resampling& resampling = {});

/// The share of the variance that the repeats of a draw have among themselves: the total index of the seed. By one-way
/// analysis of variance, interval by the bootstrap over draws. Throws std::invalid_argument with fewer than two repeats
/// or three draws.
IntervalEstimate repeat_share(const DrawnRuns& runs, const Resampling& resampling = {});

}  // namespace gem
