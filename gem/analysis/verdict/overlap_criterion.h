// The deepest overlap as a share of the size of the smaller body of the pair (size: root of the area) [-].
//
// Doubtful above 0.05: contact points and arms are known to about the depth, so loads are off by up to that share, and
// 5 % is what loads are wanted to. Bad above 0.25: a floe four times as long as wide is half as wide as its size.
// Deeper in than half its width, a quarter of its size, it is nearest to the other side, and contact pushes it through.
// With compliant contacts the overlap beyond the crushed ice: what the ice springs. An overlap of crushed ice is ice
// that is gone.
#pragma once

#include "gem/analysis/verdict/criterion.h"

namespace gem {

inline Judgement judge_overlap(const RunMeasures& run) {
  const Criterion criterion = {
      "overlap",
      0.05,
      0.25,
      percent_text,
      run.compliant ? "raise contact.face_stiffness_Pa, or shorten numerics.time_step_s"
                    : "shorten numerics.time_step_s or raise numerics.iterations_maximum; contact.solver = \"coupled\" "
                      "overlaps least",
      "the engine does not measure overlaps as shares"};
  const Occurred& share = run.overlap_share;
  return judge(criterion, share,
               std::string("deepest overlap ") + (run.compliant ? "beyond crushed ice " : "") +
                   percent_text(share.value) + " of the smaller body's size");
}

}  // namespace gem
