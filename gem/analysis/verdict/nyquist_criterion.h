// The Nyquist share N of the ice force on the platform (nyquist_share.h) [-].
//
// N = 1/2 is the most that hits at random give, each of one time step. More means that the force is on in one step and
// off in the next: the contact chatters with the time step. Doubtful above 0.6 and bad above 0.75: then at least 2 N -
// 1, a fifth and a half, of the variance lies above a quarter of the step frequency beyond what hits explain. Judged
// from 200 time steps with a force on: N of white noise then has a standard deviation of 1 / (2 sqrt 200) = 0.035.
#pragma once

#include "gem/analysis/verdict/criterion.h"

namespace gem {

inline constexpr std::int64_t least_loaded_steps = 200;

inline Judgement judge_nyquist(const RunMeasures& run) {
  static const Criterion criterion = {
      "nyquist_share",
      0.6,
      0.75,
      ratio_text,
      "the force chatters: shorten numerics.time_step_s, and trust only means over many time steps",
      "the ice pushed the platform in fewer than " + std::to_string(least_loaded_steps) + " time steps"};
  const Occurred share = {run.loaded_steps < least_loaded_steps ? std::nan("") : run.nyquist_share};
  return judge(criterion, share, "Nyquist share of the ice force " + ratio_text(share.value));
}

}  // namespace gem
