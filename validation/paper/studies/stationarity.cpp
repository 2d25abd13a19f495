// Compares the halves of runs, seed by seed.
#include "validation/paper/studies/stationarity.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "gem/analysis/statistics/bootstrap.h"
#include "gem/analysis/statistics/moments.h"

namespace gem {
namespace {

IntervalEstimate geometric_mean(std::vector<double> ratios) {
  for (double& ratio : ratios) ratio = std::log(ratio);
  const IntervalEstimate mean = mean_of_runs(ratios);
  return {std::exp(mean.value), std::exp(mean.low), std::exp(mean.high)};
}

double root_mean_square(std::span<const double> values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// The halves of the runs of a condition. With an odd number of blocks the middle block belongs to neither half.
struct Halves {
  std::vector<double> early_x, late_x, ratio_x, ratio_y, shift;
  std::size_t longest = 0;

  void add(const RunBlocks& blocks) {
    const std::size_t half = blocks.count() / 2;
    if (half == 0) return;
    const auto early = [half](const std::vector<double>& v) { return std::span(v).first(half); };
    const auto late = [half](const std::vector<double>& v) { return std::span(v).last(half); };
    const double x0 = root_mean_square(early(blocks.deviation_x));
    const double x1 = root_mean_square(late(blocks.deviation_x));
    const double y0 = root_mean_square(early(blocks.deviation_y));
    const double y1 = root_mean_square(late(blocks.deviation_y));
    if (!(x0 > 0.0 && x1 > 0.0 && y0 > 0.0 && y1 > 0.0)) return;
    longest = std::max(longest, half);
    early_x.push_back(x0);
    late_x.push_back(x1);
    ratio_x.push_back(x1 / x0);
    ratio_y.push_back(y1 / y0);
    shift.push_back(moments(late(blocks.mean_x)).mean - moments(early(blocks.mean_x)).mean);
  }
};

}  // namespace

Growth judge_growth(const IntervalEstimate& ratio, std::size_t seeds) {
  if (seeds < kRunsForGrowth) return Growth::undecided;
  if (ratio.low > 1.0) return Growth::grows;
  if (ratio.high < 1.0) return Growth::shrinks;
  return ratio.low >= 1.0 - kSteady && ratio.high <= 1.0 + kSteady ? Growth::steady : Growth::undecided;
}

std::string growth_text(Growth growth) {
  switch (growth) {
    case Growth::grows:
      return "**grows**";
    case Growth::shrinks:
      return "**shrinks**";
    case Growth::steady:
      return "steady within a tenth";
    case Growth::undecided:
      return "undecided";
  }
  return "";
}

std::vector<StationarityRow> stationarity(const PaperFolder& folder, const std::vector<std::string>& conditions) {
  std::vector<StationarityRow> rows;
  for (const std::string& condition : conditions) {
    Halves halves;
    for (const PaperRun& run : folder.of(condition)) halves.add(run.blocks);
    if (halves.ratio_x.size() < 2) continue;
    StationarityRow row{condition,
                        halves.ratio_x.size(),
                        kBlockLength * static_cast<double>(halves.longest),
                        mean_of_runs(halves.early_x),
                        mean_of_runs(halves.late_x),
                        geometric_mean(halves.ratio_x),
                        geometric_mean(halves.ratio_y),
                        mean_of_runs(halves.shift)};
    row.growth = judge_growth(row.ratio_x, row.seeds);
    rows.push_back(row);
  }
  return rows;
}

std::vector<IntervalEstimate> over_seeds(const std::vector<PaperRun>& runs, std::vector<double> RunBlocks::*quantity) {
  std::vector<IntervalEstimate> result;
  for (std::size_t block = 0;; ++block) {
    std::vector<double> values;
    for (const PaperRun& run : runs)
      if (const std::vector<double>& all = run.blocks.*quantity; block < all.size()) values.push_back(all[block]);
    if (values.size() < 2) return result;
    result.push_back(mean_of_runs(values));
  }
}

}  // namespace gem
