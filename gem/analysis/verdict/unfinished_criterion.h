// The share of the time steps with contacts whose iterations ended at their limit, above numerics.residual_tolerance
// [-].
//
// Doubtful above 0.001: the asked tolerance is to be met but for rare steps; one in a thousand is the bar of this
// project. Never bad: how much such a step leaves undone is the matter of residual_criterion.h.
#pragma once

#include <limits>

#include "gem/analysis/verdict/criterion.h"

namespace gem {

inline Judgement judge_unfinished(const RunMeasures& run) {
  static const Criterion criterion = {"unfinished_steps",
                                      0.001,
                                      std::numeric_limits<double>::infinity(),
                                      percent_text,
                                      "raise numerics.iterations_maximum and compare the loads",
                                      "the solver does not iterate to a tolerance"};
  const double scale = run.driving_speed();
  std::string finding = percent_text(run.unfinished_share) +
                        " of the time steps with contacts end above numerics.residual_tolerance; half of all leave " +
                        "at most " + percent_text(run.residual_median / scale) + " of the driving speed " +
                        number_text(scale, 3) + " m/s, the worst " + percent_text(run.residual.value / scale);
  if (!std::isnan(run.residual.time_s)) finding += ", at " + number_text(run.residual.time_s, 6) + " s";
  return judge(criterion, {run.unfinished_share}, finding);
}

}  // namespace gem
