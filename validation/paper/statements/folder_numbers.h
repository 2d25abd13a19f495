// Numbers that need many runs: trends over the conditions, scatter, totals, repeated runs, the tail.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"
#include "validation/paper/runs/paper_run.h"
#include "validation/paper/statements/catalogue.h"
#include "validation/paper/statements/judgement.h"

namespace gem {

using FolderNumbers = std::map<std::string, Measured>;

/// Largest excursion of one condition of Table 1: the mean over its seeds.
struct ExcursionPoint {
  std::string condition;
  double thickness_m = 0.0;  // mean, weighted by the shares
  bool mixed = false;
  double gap_m = 0.0;
  double current_m_per_s = 0.0;
  std::vector<double> largest_m;  // one per seed

  double mean() const;
  /// 95 % interval of the mean over the seeds; empty for one seed.
  std::optional<IntervalEstimate> mean_interval() const;
};
std::vector<ExcursionPoint> excursion_points(const PaperFolder& folder, const std::vector<TableRow>& rows);

/// The numbers that the runs of the folder allow:
///   simulated_h, real_time_factor_mean, real_time_factor_best   over the runs of both tables, one seed of each
///   excursion_exponent_thickness, _gap, _current                of ln(excursion) over the logarithms, uniform ice
///   excursion_scatter, excursion_scatter_of_seeds               of ln(excursion) about that model; between seeds
///   thicker_is_larger_share, narrower_is_larger_share           of the pairs of neighbours that differ in this alone
///   mooring_over_ice_mean_all                                   over all runs of both tables
///   repeated_run_distance_m                                     between run 1 and run 1a of the same seed
///   tail_shape                                                  of the excursion peaks of run 1, Pareto
FolderNumbers folder_numbers(const PaperFolder& folder, const Catalogue& catalogue);

}  // namespace gem
