// Extremes by average conditional exceedance rates (ACER): dependence between peaks is counted, not removed.
//
//   eps_k(level) = chance that a peak exceeds the level when the k - 1 peaks before it did not
//   P(maximum of N peaks <= level) = exp(-(N - k + 1) eps_k(level))
//   fitted tail: eps_k = q exp(-a (level - b)^c)
//
// Naess and Gaidai 2009. k = 1 takes peaks as independent; the curves of growing k join where dependence ends.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// Rates at each level, mean over runs, with the 95 % interval from their scatter over runs.
struct AcerCurve {
  std::size_t order = 1;  // k
  std::vector<double> level;
  std::vector<double> rate;  // per peak
  std::vector<double> half_width;
};

/// `runs` hold the peaks of each run in order of time; `order` is k. Needs two runs, each with more than k peaks,
/// otherwise std::invalid_argument.
AcerCurve acer(const std::vector<std::vector<double>>& runs, std::size_t order, std::span<const double> levels);

/// q exp(-a (level - b)^c), for levels above b.
struct AcerTail {
  double q = 0.0, a = 0.0, b = 0.0, c = 1.0;

  double rate(double level) const;
  /// The level that the maximum of `peaks` peaks stays below with probability p in (0, 1).
  double quantile(double p, double peaks) const;
};

/// Weighted least squares of ln(rate) over the levels from `tail_start` whose interval excludes zero; c between 0.5 and
/// 5. Empty with fewer than four such levels.
std::optional<AcerTail> fit_acer_tail(const AcerCurve& curve, double tail_start);

struct AcerQuestion {
  std::size_t order = 2;    // k
  double tail_start = 0.0;  // lowest level of the fit; take one above the mean of the peaks
  std::size_t levels = 40;  // from tail_start to the largest peak
  double p = 0.9;           // probability that the maximum stays below
  double peaks = 100.0;     // number of peaks of the exposure
};

/// Quantile of the largest peak with its interval by the bootstrap over runs; empty where the tail cannot be fitted.
std::optional<IntervalEstimate> acer_quantile(const std::vector<std::vector<double>>& runs,
                                              const AcerQuestion& question, const Resampling& resampling = {});

}  // namespace gem
