// The residual that a tenth of the time steps with contacts exceed, over the driving speed [-]. The residual of a step
// is the largest velocity that a contact point still asks for when the iterations end.
//
// A floe that comes with the driving speed U and keeps the residual r gave only 1 - r/U of its impulse. A single such
// step does no harm, since the next one goes on from there; so the criterion asks what persists. Doubtful above 0.05: 5
// % is what loads are wanted to. Bad above 0.2: chosen between what healthy and senseless runs leave (user guide, "The
// verdict"): 0.09 at most with 32 iterations of "gradient", 0.23 and more with one or two.
#pragma once

#include "gem/analysis/verdict/criterion.h"

namespace gem {

inline Judgement judge_residual(const RunMeasures& run) {
  static const Criterion criterion = {"residual",
                                      0.05,
                                      0.2,
                                      percent_text,
                                      "raise numerics.iterations_maximum or shorten numerics.time_step_s",
                                      "the solver does not iterate to a tolerance"};
  const Occurred share = {run.residual_most / run.driving_speed()};
  return judge(criterion, share,
               "nine tenths of the time steps with contacts leave at most " + percent_text(share.value) +
                   " of the driving speed");
}

}  // namespace gem
