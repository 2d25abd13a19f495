// The deepest overlap as a share of the size of the smaller body of the pair (size: root of the area) [-].
//
// Doubtful above 0.05: contact points and arms are known to about the depth, so loads are off by up to that share, and
// 5 % is what loads are wanted to. Bad above 0.25: a floe four times as long as wide is half as wide as its size.
// Deeper in than half its width, a quarter of its size, it is nearest to the other side, and contact pushes it through.
#pragma once

#include "gem/analysis/verdict/criterion.h"

namespace gem {

inline Judgement judge_overlap(const RunMeasures& run) {
  static const Criterion criterion = {
      "overlap",
      0.05,
      0.25,
      percent_text,
      "shorten numerics.time_step_s or raise numerics.iterations_maximum; contact.solver = \"coupled\" overlaps least",
      "the engine does not measure overlaps as shares"};
  const Occurred& share = run.overlap_share;
  return judge(criterion, share, "deepest overlap " + percent_text(share.value) + " of the smaller body's size");
}

}  // namespace gem
