// The largest speed of a floe over the driving speed U [-], as seen in the floe frames. U is the largest of the
// current, the speeds at the start and the platform's free swing.
//
// Contacts are fully inelastic, so a body that is hit leaves no faster than it was hit. But two heavy bodies can
// squeeze a light one out from between them. Let their faces stand at the angle a to the way out, and close with the
// speed w, each with w / 2. The light body moves out with v so that it does not enter them:
//
//     v sin a = (w / 2) cos a        v = w / (2 tan a)
//
// Friction mu holds it if tan a <= mu, and w <= 2 U. So v < U / mu. With the platform on one side mu is the mean of the
// two coefficients.
// Bad above 1 / mu, but not below 3 and not above 10: high friction does not stop a floe that rolls, and no field of
// convex floes was seen to come near 10 without friction (1.7). Doubtful above 2: twice what any drive does; healthy
// runs had 1.7 at most (user guide, "The verdict").
#pragma once

#include <algorithm>

#include "gem/analysis/verdict/criterion.h"

namespace gem {

/// 1 / mu within its limits [-]. `friction`: the mean coefficient of the two contacts of a squeezed floe.
inline double largest_speed_ratio(double friction) { return std::clamp(1.0 / std::max(friction, 0.1), 3.0, 10.0); }

inline Judgement judge_speed(const RunMeasures& run) {
  const Criterion criterion = {
      "floe_speed",
      2.0,
      largest_speed_ratio(run.squeeze_friction),
      ratio_text,
      "shorten numerics.time_step_s; with contact.solver = \"independent\" try \"coupled\" or a smaller "
      "contact.elastic_stiffness_N_per_m",
      "there are no floes"};
  const double scale = run.driving_speed();
  const Occurred ratio = {run.floe_speed.value / scale, run.floe_speed.time_s};
  return judge(criterion, ratio,
               "fastest floe " + number_text(run.floe_speed.value, 3) + " m/s, " + ratio_text(ratio.value) +
                   " times the driving speed");
}

}  // namespace gem
