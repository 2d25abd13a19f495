// Fits over seeds, blocks and peaks.
#include "validation/paper/studies/seed_extremes.h"

#include <algorithm>
#include <stdexcept>

#include "gem/analysis/extremes/gumbel.h"
#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/moments.h"
#include "validation/paper/analysis/extremes/acer.h"

namespace gem {
namespace {

constexpr std::size_t kFewestRuns = 5;
constexpr double kBelow = 0.9;
constexpr Resampling kResampling{200, 0.95, 1};  // the fits of ACER take long

/// Empty if all values are equal or there are too few.
std::optional<IntervalEstimate> gumbel(const std::vector<double>& maxima, double factor) {
  try {
    return gumbel_quantile(maxima, kBelow, factor, kResampling);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

std::optional<IntervalEstimate> by_acer(const std::vector<PaperRun>& runs) {
  std::vector<std::vector<double>> peaks;
  std::vector<double> all;
  for (const PaperRun& run : runs) {
    if (run.excursion_peaks.size() < 10) return std::nullopt;
    peaks.push_back(run.excursion_peaks);
    all.insert(all.end(), run.excursion_peaks.begin(), run.excursion_peaks.end());
  }
  AcerQuestion question;
  question.tail_start = percentile(all, 0.7);
  question.p = kBelow;
  question.peaks = static_cast<double>(peaks.front().size());
  try {
    const auto quantile = acer_quantile(peaks, question, kResampling);
    // With few seeds some resamples have a tail that cannot be distinguished from a constant.
    const double absurd = 10.0 * *std::max_element(all.begin(), all.end());
    return quantile && quantile->high < absurd ? quantile : std::nullopt;
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// Runs may differ in length by less than a block.
std::optional<IntervalEstimate> by_blocks(const std::vector<PaperRun>& runs) {
  std::vector<double> maxima;
  for (const PaperRun& run : runs)
    maxima.insert(maxima.end(), run.blocks.largest_excursion.begin(), run.blocks.largest_excursion.end());
  if (maxima.size() < 2 * runs.size()) return std::nullopt;
  const auto duration = runs.front().numbers.find("duration_s");
  return duration ? gumbel(maxima, duration->value / kBlockLength) : std::nullopt;
}

std::vector<double> largest_forces(const std::vector<PaperRun>& runs) {
  std::vector<double> values;
  for (const PaperRun& run : runs)
    if (const auto number = run.numbers.find("ice_peak_window_N")) values.push_back(number->value);
  return values;
}

}  // namespace

std::vector<ExtremesRow> seed_extremes(const PaperFolder& folder, const std::vector<std::string>& conditions) {
  std::vector<ExtremesRow> rows;
  for (const std::string& condition : conditions) {
    const std::vector<PaperRun>& runs = folder.of(condition);
    std::vector<double> largest;
    for (const RunNumber& number : folder.numbers(condition, "orbit_largest_m")) largest.push_back(number.value);
    if (largest.size() < kFewestRuns) continue;
    const auto p90 = gumbel(largest, 1.0);
    if (!p90) continue;
    rows.push_back({condition, largest.size(), mean_of_runs(largest), *p90, by_blocks(runs), by_acer(runs),
                    gumbel(largest_forces(runs), 1.0)});
  }
  return rows;
}

std::vector<double> largest_so_far(const RunBlocks& blocks) {
  std::vector<double> result;
  for (const double largest : blocks.largest_excursion)
    result.push_back(result.empty() ? largest : std::max(result.back(), largest));
  return result;
}

}  // namespace gem
