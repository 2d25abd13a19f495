// Runs of a day: whether the motion still grows after the duration of the paper's runs, and the largest excursion of a
// day.
#pragma once

#include <string>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {

/// One run. The swing is the deviation of x within 600 s, root mean square over an hour. Means are over the hours of a
/// part of the day, which count as independent, with 95 % intervals (mean_of_runs).
struct DayRow {
  std::string day, condition;  // the condition of the tables: without "day_"
  double hours = 0.0;
  IntervalEstimate first, middle,
      last;  // swing of the first two hours, of the first half of the remaining hours, of their second half [m]
  IntervalEstimate mean_x;         // after the first two hours [m]
  double largest_excursion = 0.0;  // [m]
};

/// The first run of each condition "day_..." that lasts at least six hours.
std::vector<DayRow> day_study(const PaperFolder& folder);

}  // namespace gem
