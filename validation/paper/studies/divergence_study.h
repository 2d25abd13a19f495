// Divergence of runs in which one floe is shifted: growth of their distance, onset, time of visible parting.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "validation/paper/analysis/chaos/divergence.h"
#include "validation/paper/runs/paper_run.h"
#include "validation/paper/statements/folder_numbers.h"

namespace gem {

/// Distance between two platforms that should move alike, in position and velocity over the natural frequency [m].
struct DivergingPair {
  double moved_m = 0.0;
  std::uint64_t seed = 0;
  std::vector<double> distance;  // one per interval_s; 0 until the disturbance reaches the platform
};

struct DivergenceStudy {
  double interval_s = 1.0;
  double swing_m = 0.0;  // standard deviation of the undisturbed motion, at which the distance saturates
  std::vector<DivergingPair> pairs;
  std::map<double, GrowthRate> growth;  // by the shift of the floe
  std::optional<OnsetShift> shift;      // of the time at which the distance reaches a tenth of the swing
};

/// Mean growth rate of distances [m], each from its arrival on: from ten times the initial distance to a tenth of
/// `swing_m`. Distances of zero throughout are left out. Empty with fewer than two others, or if they grow within fewer
/// samples than growth_rate() needs.
std::optional<GrowthRate> growth_of(const std::vector<std::vector<double>>& distances, double interval_s,
                                    double swing_m);

/// Computes growth and shift of a study from its pairs.
void find_growth(DivergenceStudy& study);

/// Time at which a distance [m] reaches half of `swing_m`, where two curves look different [s]; infinite if it never
/// does.
double parting_time(const std::vector<double>& distance, double interval_s, double swing_m);

/// Made from the runs with floes.moved_floe set. A shift of zero is the undisturbed run of its seed. A pair differs
/// only in floes.moved_by_m.
DivergenceStudy divergence_study(const PaperFolder& folder);

/// The shift of the onset with the logarithm of the disturbance, over the shift that exponential growth at the rate of
/// the smallest disturbance would give. 1 for exponential growth of the disturbance, 0 if its size makes no difference.
/// The interval uses the worst ends of both; empty if one is not known.
std::optional<IntervalEstimate> shift_over_growth(const DivergenceStudy& study);

/// The study as numbers: divergence_rate_per_s (of the smallest disturbance), divergence_late_over_early (rate in the
/// late half of the growth over that in the early half), onset_shift_over_growth, parting_s_<moved> (time at which the
/// distance reaches half the swing; infinite for a pair that never parts), parted_share_<moved>.
void add_divergence_numbers(const DivergenceStudy& study, FolderNumbers& numbers);

}  // namespace gem
