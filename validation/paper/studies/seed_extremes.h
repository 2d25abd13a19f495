// The largest excursion and ice force of a run over its seeds, and their prediction from blocks and peaks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {

/// One condition, with its duration as the exposure. p90: not exceeded by nine runs of ten.
struct ExtremesRow {
  std::string condition;
  std::size_t seeds = 0;
  IntervalEstimate mean_m;  // largest excursion, bootstrap over the seeds
  IntervalEstimate p90_m;   // Gumbel law fitted to the maximum of each run
  std::optional<IntervalEstimate>
      by_block_m;  // Gumbel law fitted to the maxima of 600 s blocks, which count as independent
  std::optional<IntervalEstimate>
      by_acer_m;  // from all peaks, one per natural period (ACER, k = 2), if its tail can be fitted
  std::optional<IntervalEstimate> force_p90_N;  // of the window mean of the ice force, as p90_m
};

/// Conditions with at least five runs whose largest excursions differ.
std::vector<ExtremesRow> seed_extremes(const PaperFolder& folder, const std::vector<std::string>& conditions);

/// The largest excursion up to the end of each block of a run.
std::vector<double> largest_so_far(const RunBlocks& blocks);

}  // namespace gem
