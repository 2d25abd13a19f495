// Compliant contacts: the load through corners with less than half the stiffness of their ice, over all load [-].
//
// A substep cannot resolve a corner that is stiffer than the limit (compliant_contact.h): it gets less stiffness, so
// its ice springs more and its loads come later and are lower. Down to half of it
// is let pass: four times the stiffness changes the largest force of 0.2 s of a crowd by a sixth, and no mean load
// (gem/manual/how_sure.md). Doubtful above 0.05: 5 % is what loads are wanted to. Bad above 0.5: then most of the load
// is that of other ice than the case has. A crowd of 1500 floes and a jam of 4008 had 0.6 to 2 % with the substeps of
// the rule, 19 % with half of them, 76 to 82 % with a quarter.
#pragma once

#include "gem/analysis/verdict/criterion.h"

namespace gem {

inline Judgement judge_softened(const RunMeasures& run) {
  static const Criterion criterion = {
      "softened_share",           0.05, 0.5, percent_text, "raise numerics.substeps, or shorten numerics.time_step_s",
      "the run has no floe frame"};
  return judge(criterion, {run.softened_share},
               percent_text(run.softened_share) +
                   " of the load went through corners with less than half the stiffness of their ice");
}

}  // namespace gem
