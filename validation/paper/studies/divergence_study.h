// How fast runs part that differ by the place of one floe: growth of their distance, onset, time of visible parting.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/paper/analysis/chaos/divergence.h"
#include "validation/paper/runs/paper_run.h"
#include "validation/paper/statements/folder_numbers.h"

namespace gem {

/// Distance of two platforms that should do the same, in position and velocity over the natural frequency [m].
struct DivergingPair {
  double moved_m = 0.0;
  std::uint64_t seed = 0;
  std::vector<double> distance;  // one per interval_s; 0 until the disturbance has reached the platform
};

struct DivergenceStudy {
  double interval_s = 1.0;
  double swing_m = 0.0;  // standard deviation of the undisturbed motion: where the distance ends
  std::vector<DivergingPair> pairs;
  std::map<double, GrowthRate> growth;  // by how far the floe was moved
  std::optional<OnsetShift> shift;      // of the time at which the distance is a tenth of the swing
};

/// How fast distances [m] grow in the mean, each from when it is more than nothing: from ten times where they begin to
/// a tenth of `swing_m`. Distances that stay at nothing are left out; empty for fewer than two others, or if they grow
/// within fewer samples than growth_rate() asks for.
std::optional<GrowthRate> growth_of(const std::vector<std::vector<double>>& distances, double interval_s,
                                    double swing_m);

/// Growth and shift of a study from its pairs.
void find_growth(DivergenceStudy& study);

/// When a distance [m] is half of `swing_m`, where the eye sees two curves; infinite if it never is [s].
double parting_time(const std::vector<double>& distance, double interval_s, double swing_m);

/// From the runs with floes.moved_floe set: those moved by nothing are the undisturbed ones of their seed.
/// A pair differs in floes.moved_by_m and in nothing else.
DivergenceStudy divergence_study(const PaperFolder& folder);

/// How far the onset shifts with the logarithm of the disturbance, over how far it would if the distance grew from the
/// first at the rate of the smallest disturbance: 1 for exponential growth of what was put in, 0 if the size of the
/// disturbance makes no difference. Both intervals at their worst; empty where either is not known.
std::optional<IntervalEstimate> shift_over_growth(const DivergenceStudy& study);

/// The study as numbers: divergence_rate_per_s (of the smallest disturbance), divergence_late_over_early (its rate in
/// the late half of the growth over that in the early half), onset_shift_over_growth, parting_s_<moved> (when
/// the distance is half the swing; infinite for a pair that never parts), parted_share_<moved>.
void add_divergence_numbers(const DivergenceStudy& study, FolderNumbers& numbers);

}  // namespace gem
