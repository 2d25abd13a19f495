// The analysis of the platform's record of one run: a flat list of named numbers.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gem/analysis/statistics/interval_estimate.h"

namespace gem {

/// The platform's record, evenly sampled. Motion is measured from the rest position; forces act on the platform.
struct PlatformSeries {
  double interval = 0.0;                                       // between samples [s]
  double natural_period = 0.0;                                 // of mooring or control; 0 without both [s]
  std::vector<double> x, y;                                    // [m]
  std::vector<double> ice_force_x, ice_force_y;                // mean over one sample [N]
  std::vector<double> ice_force_window_x, ice_force_window_y;  // mean over the force window [N]
  std::vector<double> mooring_force_x, mooring_force_y;        // [N]
  std::vector<double> contacts;                                // not zero: contact
  std::vector<double> drag_force_x = {}, drag_force_y = {};    // of water and wind; empty where neither acts [N]
};

/// One number; its name ends in its unit. The value is empty if the record does not allow it. The interval is empty if
/// one run has none, as for a maximum, which is a single draw.
struct Finding {
  std::string name;
  std::optional<double> value;
  std::optional<IntervalEstimate> interval;
};

/// Motion, periods by three methods, orbit, contact and loads. Intervals have 95 % confidence and treat stretches of
/// four natural periods (without mooring: a twentieth of the record) as independent. Spells and gaps of contact that
/// are cut by an end of the record count with their observed part (see contact_spells.h); their number is a finding
/// too. Every run has the same names in the same order; those of the drag only where it acts. Throws
/// std::invalid_argument for fewer than 64 samples or columns of unequal length.
std::vector<Finding> analyse_platform(const PlatformSeries& series);

/// Whether the record resolves it: it has a value, and the interval of a spectral period spans no more than a factor of
/// two.
bool is_resolved(const Finding& finding);

/// The finding with a name; without value if the list does not have it, e.g. if the record was too short to analyse.
Finding finding_of(const std::vector<Finding>& findings, const std::string& name);

}  // namespace gem
