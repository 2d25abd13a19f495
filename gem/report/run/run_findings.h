// The numbers that describe one run: motion, period, loads, books, speed.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "gem/analysis/run_analysis.h"
#include "gem/analysis/spectra/period.h"
#include "gem/analysis/statistics/moments.h"
#include "gem/report/run/run_data.h"

namespace gem {

/// One axis of the platform's motion, measured from rest [m, s].
struct AxisMotion {
  double deviation = 0.0;
  double excursion = 0.0;  // signed
  double excursion_time = 0.0;
  std::optional<PeriodEstimate> spectral;
  Spectrum spectrum;
};

/// When a largest force acted, and its direction, counter-clockwise from +x.
struct ForceAt {
  double time_s = 0.0;
  double direction_rad = 0.0;
};

/// Three ice load channels, never mixed, and the mooring. Largest values are magnitudes in the plane.
struct PlatformLoads {
  double sample_s = 0.0;                      // one sample of the platform record [s]
  double sample_impulse_largest = 0.0;        // net ice impulse in one sample [N s]
  double event_impulse_largest = 0.0;         // normal impulse of one hit [N s]
  double ice_window_largest = 0.0;            // of the window mean [N]
  ForceAt ice_window_at;                      // at the end of that window
  ForceAt ice_sample_at;                      // of the largest sample, at its end
  double ice_mean_x = 0.0, ice_mean_y = 0.0;  // over the run [N]
  double crushing_largest = 0.0;              // closed-form peak of one hit [N]
  double crushing_median = 0.0;
  double mooring_largest = 0.0;  // [N]
  ForceAt mooring_at;
  double contact_fraction = 0.0;
  std::size_t events = 0;
  std::size_t touches = 0;   // events after at least kTouchGap without an event of the same floe
  std::size_t arrivals = 0;  // distinct floes that hit the platform
};

/// Quality of the books and speed of the run. Complementarity, cone excess and energy created are NaN if the engine
/// does not measure them.
struct RunQuality {
  double residual_momentum = 0.0, residual_angular_momentum = 0.0, residual_energy = 0.0;  // largest over the run
  double maximum_overlap = 0.0, most_overlap = 0.0;  // largest over the run, and bound on 99.9 % of the overlaps [m]
  double maximum_share = 0.0, most_share = 0.0;      // relative to the size of the smaller body
  double complementarity = 0.0;                      // [m/s]
  double cone_excess = 0.0;                          // [N s]
  double energy_created = 0.0;                       // in one time step [J]
  double speed = 0.0;                                // simulated over wall time
};

/// Results of single samples and events. Results with an interval are in the analysis.
struct RunFindings {
  AxisMotion x, y;
  double radial_excursion = 0.0;  // [m]
  double radial_time = 0.0;       // [s]
  PlatformLoads loads;
  RunQuality quality;
};

/// Shorter platform records have no spectrum and no interval of the mean.
inline constexpr std::size_t kSamplesForStatistics = 64;

/// A floe that rests against the platform has an event in every time step; only the first counts as an impact.
inline constexpr double kTouchGap = 1.0;  // [s]
std::vector<std::size_t> opening_events(const EventColumns& events);

/// Whether the record shows no contact of ice with the platform.
bool without_contact(const RunData& run, const PlatformLoads& loads);

/// An excursion below this is rounding, not motion.
inline constexpr double kLeastMotion = 1e-9;  // [m]

/// Computes everything that the records of the run allow; the rest stays zero or empty.
RunFindings run_findings(const RunData& run);

/// The result of analyse_platform() for the whole run, and of thrusters, transit and fixed bodies; empty for a record
/// too short to analyse.
std::vector<Finding> whole_run_analysis(const RunData& run);

/// Whether the finding is an offset, a period or an orbit about a rest, which a ship on its way has not.
bool is_of_swing(const Finding& finding);

/// What the platform's record from sample `first` on says: motion, loads, thrusters, transit, and fixed bodies. A ship
/// in transit has no rest to swing about, so offsets, periods and orbit are left out. Without a mooring its force is
/// left out.
std::vector<Finding> platform_findings(const RunData& run, std::size_t first);

/// Interval of evenly spaced times [s]. Throws Error(file_system) if they are not even to 1e-6.
double sample_interval(const std::vector<double>& time);

}  // namespace gem
