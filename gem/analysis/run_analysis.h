// Everything the analysis says about the platform of one run, as one flat list of named numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// The platform's record, evenly sampled, motion measured from rest. Forces act on the platform.
struct PlatformSeries {
  double interval = 0.0;                                       // of the samples [s]
  double natural_period = 0.0;                                 // 2 pi sqrt(M / k); 0 without mooring [s]
  std::vector<double> x, y;                                    // [m]
  std::vector<double> ice_force_x, ice_force_y;                // mean over one sample [N]
  std::vector<double> ice_force_window_x, ice_force_window_y;  // mean over the force window [N]
  std::vector<double> mooring_force_x, mooring_force_y;        // [N]
  std::vector<double> contacts;                                // not zero with contact
};

/// One number; its name ends in its unit. Empty where the record does not allow it; without interval where one run has
/// none, as for a maximum, which is a single draw.
struct Finding {
  std::string name;
  std::optional<double> value;
  std::optional<IntervalEstimate> interval;
};

/// Motion, periods three ways, orbit, contact and loads. Intervals are of 95 % and take stretches of four natural
/// periods (a twentieth of the record without mooring) as independent. Spells and gaps of contact that an end of the
/// record cuts off count with what is seen of them (contact_spells.h says how), their number is given. The same names
/// in the same order for every run. Throws std::invalid_argument for fewer than 64 samples or columns of unequal
/// length.
std::vector<Finding> analyse_platform(const PlatformSeries& series);

/// The finding of a name; without value where the list has none, as for a record too short to analyse.
Finding finding_of(const std::vector<Finding>& findings, const std::string& name);

}  // namespace gem
