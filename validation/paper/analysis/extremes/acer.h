// Extremes by average conditional exceedance rates (ACER), which account for dependence between peaks.
//
//   eps_k(level) = probability that a peak exceeds the level if the k - 1 peaks before it did not
//   P(maximum of N peaks <= level) = exp(-(N - k + 1) eps_k(level))
//   fitted tail: eps_k = q exp(-a (level - b)^c)
//
// Naess and Gaidai 2009. k = 1 treats peaks as independent. The curves of growing k coincide once dependence is
// accounted for.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// Rates at each level: the mean over runs, and the 95 % interval from their scatter over runs.
struct AcerCurve {
  std::size_t order = 1;  // k
  std::vector<double> level;
  std::vector<double> rate;  // per peak
  std::vector<double> half_width;
};

/// `runs` are the peaks of each run in order of time; `order` is k. Throws std::invalid_argument unless there are two
/// runs, each with more than k peaks.
AcerCurve acer(const std::vector<std::vector<double>>& runs, std::size_t order, std::span<const double> levels);

/// q exp(-a (level - b)^c), for levels above b.
struct AcerTail {
  double q = 0.0, a = 0.0, b = 0.0, c = 1.0;

  double rate(double level) const;
  /// The level that the maximum of `peaks` peaks does not exceed with probability p in (0, 1).
  double quantile(double p, double peaks) const;
};

/// Weighted least squares of ln(rate) over the levels from `tail_start` whose interval excludes zero, with c between
/// 0.5 and 5. Empty with fewer than four such levels.
std::optional<AcerTail> fit_acer_tail(const AcerCurve& curve, double tail_start);

struct AcerQuestion {
  std::size_t order = 2;    // k
  double tail_start = 0.0;  // lowest level of the fit; should lie above the mean of the peaks
  std::size_t levels = 40;  // from tail_start to the largest peak
  double p = 0.9;           // probability that the maximum is not above the quantile
  double peaks = 100.0;     // number of peaks in the exposure
};

/// Quantile of the largest peak and its interval by the bootstrap over runs; empty if the tail cannot be fitted.
std::optional<IntervalEstimate> acer_quantile(const std::vector<std::vector<double>>& runs,
                                              const AcerQuestion& question, const Resampling& resampling = {});

}  // namespace gem
