// One law for all runs, and its scatter over runs.
#include "validation/paper/analysis/extremes/peaks_over_threshold.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace gem {
namespace {

constexpr std::size_t kFewestPeaks = 10;

std::optional<ThresholdModel> fit_chosen(std::span<const RunPeaks> runs, std::span<const std::size_t> chosen,
                                         double threshold) {
  std::vector<double> excesses;
  double duration = 0.0;
  for (const std::size_t run : chosen) {
    duration += runs[run].duration;
    for (const double peak : runs[run].peaks)
      if (peak > threshold) excesses.push_back(peak - threshold);
  }
  if (excesses.size() < kFewestPeaks || !(duration > 0.0)) return std::nullopt;
  return ThresholdModel{threshold, static_cast<double>(excesses.size()) / duration, fit_pareto(excesses)};
}

std::size_t count_above(std::span<const RunPeaks> runs, double threshold) {
  std::size_t count = 0;
  for (const RunPeaks& run : runs)
    count += static_cast<std::size_t>(
        std::count_if(run.peaks.begin(), run.peaks.end(), [threshold](double peak) { return peak > threshold; }));
  return count;
}

}  // namespace

double ThresholdModel::quantile(double p, double duration) const {
  // Peaks come as a Poisson process: P(none above x) = exp(-rate duration P(peak above x)).
  const double above = -std::log(p) / (rate * duration);
  return above < 1.0 ? threshold + law.excess_at(above) : threshold;
}

std::optional<ThresholdModel> fit_threshold_model(std::span<const RunPeaks> runs, double threshold) {
  std::vector<std::size_t> all(runs.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return fit_chosen(runs, all, threshold);
}

std::vector<ThresholdStability> threshold_stability(std::span<const RunPeaks> runs, std::span<const double> thresholds,
                                                    const ReturnValue& asked, const Resampling& resampling) {
  std::vector<ThresholdStability> rows;
  for (const double threshold : thresholds) {
    const std::size_t peaks = count_above(runs, threshold);
    if (peaks < 2 * kFewestPeaks) continue;
    const auto all = *fit_threshold_model(runs, threshold);
    const std::vector<IntervalEstimate> numbers = bootstrap_together(
        runs.size(),
        [&](std::span<const std::size_t> chosen) {
          // A resample with too few peaks counts as the fit to all runs.
          const ThresholdModel model = fit_chosen(runs, chosen, threshold).value_or(all);
          return std::vector<double>{model.law.shape, model.law.scale - model.law.shape * threshold,
                                     model.quantile(asked.p, asked.duration)};
        },
        resampling);
    rows.push_back({threshold, peaks, numbers[0], numbers[1], numbers[2]});
  }
  return rows;
}

}  // namespace gem
