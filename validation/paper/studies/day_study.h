// Runs of a day: does the motion go on growing after the hours of the paper's runs, and how large is the largest of a
// day?
#pragma once

#include <string>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"
#include "validation/paper/runs/paper_run.h"

namespace gem {

/// One run. A swing is the deviation of x within 600 s, root mean square over an hour; means over the hours of a part
/// of the day, which are taken as independent, with their 95 % (mean_of_runs).
struct DayRow {
  std::string day, condition;  // the condition of the tables: without "day_"
  double hours = 0.0;
  IntervalEstimate first, middle, last;  // swing of the first two hours, of half of the others, of the other half [m]
  IntervalEstimate mean_x;               // after the first two hours [m]
  double largest_excursion = 0.0;        // [m]
};

/// The first run of each condition "day_..." that is at least six hours long.
std::vector<DayRow> day_study(const PaperFolder& folder);

}  // namespace gem
